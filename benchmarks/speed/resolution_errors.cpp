// Prints what the contact rate and the number of modes cost in accuracy: the tables from which resolution.cpp
// takes its law. Error: relative L2 distance of all probes over the first 0.1 s from the same scene at 64.5
// MHz with all modes.
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jawari/jawari.h"
#include "scenes.h"

namespace jawari::benchmarks {
namespace {

constexpr double output_rate_hz = 48000;
constexpr double sound_s = 0.1;
constexpr double reference_rate_hz = 1344 * output_rate_hz;

std::vector<double> rendered(const SceneDescription& scene) {
    auto model = compile(scene);
    if (!model) throw std::runtime_error(model.failure().line());
    SceneState state = make_state(model.value());
    const auto frames = static_cast<std::size_t>(sound_s * output_rate_hz);
    std::vector<double> samples(model.value().probe_count * frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.value().probe_count; ++p)
        outputs.push_back(samples.data() + p * frames);
    render(model.value(), state, outputs, frames);
    return samples;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return std::sqrt(difference / size);
}

/// The modes of every string up to `limit_hz`.
SceneDescription limited(SceneDescription scene, double limit_hz) {
    for (auto& string : scene.strings) {
        const Modes all = modes_of(string);
        std::size_t count = 0;
        while (count < all.omega.size() && all.omega[count] <= 2 * 3.14159265358979 * limit_hz) ++count;
        keep_modes(string, count);
    }
    return scene;
}

SceneDescription at_rate(SceneDescription scene, double contact_rate_hz) {
    scene.contact_rate_hz = contact_rate_hz;
    return scene;
}

void print_errors(const std::string& name, const SceneDescription& scene) {
    const auto reference = rendered(at_rate(scene, reference_rate_hz));
    const auto half = rendered(at_rate(scene, reference_rate_hz / 2));
    std::printf("\n%s; the reference at half its rate: %.2g %%\n\n", name.c_str(),
                100 * distance(half, reference));
    std::puts("| contact rate (MHz) | error (%) |\n|---|---|");
    for (const int steps : {2, 4, 5, 8, 11, 16, 21, 42, 84, 168}) {
        const double rate_hz = steps * output_rate_hz;
        std::printf("| %.3g | %.2g |\n", rate_hz / 1e6,
                    100 * distance(rendered(at_rate(scene, rate_hz)), reference));
        std::fflush(stdout);
    }
    std::puts("\n| modes up to (kHz) | error (%) |\n|---|---|");
    for (const double limit_hz : {8e3, 12e3, 16e3, 20e3, 30e3, 42e3, 60e3}) {
        const auto fewer = rendered(at_rate(limited(scene, limit_hz), reference_rate_hz / 8));
        std::printf("| %.3g | %.2g |\n", limit_hz / 1e3, 100 * distance(fewer, reference));
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace jawari::benchmarks

int main() {
    using namespace jawari;
    using namespace jawari::benchmarks;
    try {
        print_errors("`lab/bass`", builtin("lab/bass", 48000, 48000, ImpactLaw::Signorini, 0));
        print_errors("guitar, six strings", guitar(6, 48000, 48000, 8.4e4));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "resolution_errors: %s\n", error.what());
        return 1;
    }
    return 0;
}
