// Prints the speed tables of docs/benchmarks.md: headline scenes, ablation of each skip, scaling. All figures
// of a table are ratios or CPU seconds of one run on one core.
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "measure.h"
#include "scenes.h"

namespace jawari::benchmarks {
namespace {

SceneModel compiled(const SceneDescription& scene) {
    auto model = compile(scene);
    if (!model) throw std::runtime_error(model.failure().line());
    return std::move(model.value());
}

void print_headline(const char* name, const SceneDescription& scene, double sound_s, double uniform_s,
                    double skip_s = 0) {
    const SceneModel model = compiled(scene);
    const Measurement skipping = measure(model, sound_s, skip_all, skip_s);
    const double factor = sound_s / skipping.cpu_s;
    std::string uniform = "";
    if (uniform_s > 0) {
        const Measurement all = measure(model, uniform_s, skip_nothing, 0, 1);
        const Measurement same = measure(model, uniform_s);
        char text[40];
        std::snprintf(text, sizeof text, "%.0f", all.cpu_s / same.cpu_s);
        uniform = text;
    }
    const auto& counters = skipping.counters;
    const auto frames =
        static_cast<double>(counters.flown_frames + counters.near_frames + counters.asleep_frames);
    std::printf("| %s | %.4g | %.1f | %s | %.2f | %llu |\n", name, sound_s, factor, uniform.c_str(),
                100 * static_cast<double>(counters.near_frames) / frames,
                static_cast<unsigned long long>(counters.impulses));
    std::fflush(stdout);
}

void print_headlines() {
    std::puts(
        "| scene | sound (s) | times real time | times uniform stepping | near frames (%) | impulses |");
    std::puts("|---|---|---|---|---|---|");
    const auto signorini = ImpactLaw::Signorini;
    print_headline("`lab/bass`, `signorini`, 2.016 MHz", builtin("lab/bass", 48000, 2016000, signorini, 0),
                   0.1, 0.1);
    print_headline("the same", builtin("lab/bass", 48000, 2016000, signorini, 0), 3, 0);
    print_headline("`lab/bass`, `newton`, e = 0.9, 15.68 kHz",
                   builtin("lab/bass", 15680, 15680, ImpactLaw::Newton, 0.9), 0.4, 0.4);
    print_headline("`lab/fretless`, `signorini`, 528 kHz",
                   builtin("lab/fretless", 48000, 528000, signorini, 0), 0.1, 0.02);
    print_headline("six-string guitar, modes to 100 kHz, 1.008 MHz", guitar(6, 48000, 1008000, 1e5), 1, 0.05);
    print_headline("the same, 90 s later", guitar(6, 48000, 1008000, 1e5), 1, 0, 90);
}

void print_ablation(const char* name, const SceneDescription& scene, double sound_s) {
    const SceneModel model = compiled(scene);
    const double everything = measure(model, sound_s).cpu_s;
    std::printf("| %s |", name);
    for (const Skipping& skipping :
         {Skipping{false, true, true, true, true}, Skipping{true, false, true, true, true},
          Skipping{true, true, false, true, true}, Skipping{true, true, true, false, true},
          Skipping{true, true, true, true, false}, skip_nothing}) {
        std::printf(" %.2f |", measure(model, sound_s, skipping, 0, 2).cpu_s / everything);
        std::fflush(stdout);
    }
    std::puts("");
}

void print_ablations() {
    std::puts("| scene | no flight | no certificate | no near | no lazy | no sleep | nothing skipped |");
    std::puts("|---|---|---|---|---|---|---|");
    print_ablation("`lab/bass`, 0.1 s", builtin("lab/bass", 48000, 2016000, ImpactLaw::Signorini, 0), 0.1);
    print_ablation("`lab/bass`, 1 s", builtin("lab/bass", 48000, 2016000, ImpactLaw::Signorini, 0), 1);
    print_ablation("`lab/one-contact`, 0.1 s",
                   builtin("lab/one-contact", 48000, 2016000, ImpactLaw::Signorini, 0), 0.1);
    print_ablation("guitar, 0.2 s", guitar(6, 48000, 1008000, 1e5), 0.2);
}

/// CPU seconds per second of sound, relative to the first row.
void print_scaling(const char* what, const std::vector<std::pair<std::string, SceneDescription>>& scenes,
                   double sound_s) {
    std::printf("| %s | CPU time relative to the first |\n|---|---|\n", what);
    double first = 0;
    for (const auto& [label, scene] : scenes) {
        const double cpu_s = measure(compiled(scene), sound_s).cpu_s;
        if (first == 0) first = cpu_s;
        std::printf("| %s | %.2f |\n", label.c_str(), cpu_s / first);
        std::fflush(stdout);
    }
    std::puts("");
}

/// Any number of modes: by a formula, which the table of the published bass is not.
SceneDescription bass_with(std::size_t modes, double contact_rate_hz) {
    SceneDescription scene = builtin("smooth/bass", 48000, contact_rate_hz, ImpactLaw::Signorini, 0);
    std::get<PhysicalModes>(scene.strings[0].modes).count = modes;
    return scene;
}

SceneDescription neck_with(std::size_t points) {
    SceneDescription scene = builtin("lab/bass", 48000, 528000, ImpactLaw::Signorini, 0);
    StringDescription& string = scene.strings[0];
    const std::vector<ProfilePoint> profile{{0, -2e-4}, {0.1, -9e-4}, {0.6, -2.7e-3}, {0.601, -1e-2}};
    string.contacts = sampled_neck(string.length_m, points, profile, 0);
    return scene;
}

void print_scalings() {
    print_scaling("modes of `smooth/bass`, 0.1 s",
                  {{"216", bass_with(216, 2016000)},
                   {"431", bass_with(431, 2016000)},
                   {"862", bass_with(862, 2016000)},
                   {"1724", bass_with(1724, 2016000)}},
                  0.1);
    print_scaling("contact rate of `smooth/bass`, 0.1 s",
                  {{"0.528 MHz", bass_with(862, 528000)},
                   {"1.008 MHz", bass_with(862, 1008000)},
                   {"2.016 MHz", bass_with(862, 2016000)},
                   {"4.032 MHz", bass_with(862, 4032000)},
                   {"8.064 MHz", bass_with(862, 8064000)}},
                  0.1);
    print_scaling(
        "points of a neck under 862 modes, 0.1 s",
        {{"64", neck_with(64)}, {"256", neck_with(256)}, {"862", neck_with(862)}, {"4096", neck_with(4096)}},
        0.1);
    print_scaling("strings of the guitar, 0.5 s",
                  {{"1", guitar(1, 48000, 1008000, 1e5)},
                   {"2", guitar(2, 48000, 1008000, 1e5)},
                   {"6", guitar(6, 48000, 1008000, 1e5)},
                   {"12", guitar(12, 48000, 1008000, 1e5)}},
                  0.5);
}

}  // namespace
}  // namespace jawari::benchmarks

int main() {
    try {
        jawari::benchmarks::print_headlines();
        std::puts("");
        jawari::benchmarks::print_ablations();
        std::puts("");
        jawari::benchmarks::print_scalings();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "speed_tables: %s\n", error.what());
        return 1;
    }
    return 0;
}
