// Runs one scene with one method; prints what it cost as one JSON object on standard output, and writes the
// displacement probes, rows x probes in float64, to --out.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "engine_methods.h"
#include "finite_difference.h"
#include "formats/scene/read_scene.h"
#include "modal_rivals.h"
#include "trajectory.h"

namespace jawari::benchmarks {
namespace {

struct Options {
    std::string scene = "lab/bass", method = "exact", law = "signorini", start = "exact", out;
    double restitution = -1, contact_rate_hz = 2007040, theta = 0.5, duration_s = 0;
    double relative_stiffness = 1, exponent = 1;
    std::size_t modes = 0;  // 0: all that the scene has
    Repetition repetition;
};

SceneDescription described(const Options& options, double& duration_s) {
    auto loaded = host::load_scene(options.scene);
    if (!loaded) throw std::runtime_error(loaded.error().message);
    host::Scene scene = loaded.value();
    SceneDescription description = scene.description;
    duration_s = options.duration_s > 0 ? options.duration_s : scene.duration_s;
    description.contact_rate_hz = options.contact_rate_hz;
    for (const ImpactLaw law :
         {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        if (options.law == name_of(law)) description.law = law;
    }
    if (options.method == "theta") {
        description.scheme = Scheme::Theta;
        description.theta = options.theta;
        description.law = ImpactLaw::Newton;
    }
    for (StringDescription& string : description.strings) {
        string.initial.start = options.start == "exact" ? Start::Exact : Start::Backward;
        if (options.modes > 0) keep_modes(string, options.modes);
        if (options.restitution < 0) continue;
        for (ContactDescription& contact : string.contacts) contact.restitution = options.restitution;
    }
    return description;
}

Trajectory run(const Options& options) {
    double duration_s = 0;
    const SceneDescription scene = described(options, duration_s);
    const auto& repetition = options.repetition;
    if (options.method == "exact") return run_engine(scene, duration_s, skip_all, repetition);
    if (options.method == "uniform" || options.method == "theta") {
        return run_engine(scene, duration_s, skip_nothing, repetition);
    }
    const rivals::ModalContactOptions modal{options.relative_stiffness, options.exponent, 1};
    if (options.method == "penalty") return rivals::run_penalty(scene, duration_s, modal, repetition);
    if (options.method == "ieq-modal")
        return rivals::run_quadratised_modal(scene, duration_s, modal, repetition);
    const auto auxiliary =
        options.method == "sav" ? rivals::Auxiliary::Shared : rivals::Auxiliary::PerContact;
    return rivals::run_quadratised(scene, duration_s,
                                   {options.relative_stiffness, options.exponent, auxiliary}, repetition);
}

void write_samples(const Trajectory& trajectory, const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(trajectory.samples.data()),
               static_cast<std::streamsize>(trajectory.samples.size() * sizeof(double)));
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace
}  // namespace jawari::benchmarks

int main(int argc, char** argv) {
    jawari::benchmarks::Options options;
    CLI::App app("One run of a work-precision diagram");
    app.add_option("--scene", options.scene, "file or built-in name");
    app.add_option("--method", options.method)
        ->check(CLI::IsMember({"exact", "uniform", "theta", "penalty", "ieq-modal", "ieq", "sav"}));
    app.add_option("--law", options.law)
        ->check(CLI::IsMember({"newton", "passive", "signorini", "paoli-schatzman"}));
    app.add_option("--restitution", options.restitution, "of every contact; default: the scene's")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--start", options.start)->check(CLI::IsMember({"exact", "backward"}));
    app.add_option("--contact-rate", options.contact_rate_hz, "Hz")->check(CLI::PositiveNumber);
    app.add_option("--modes", options.modes, "of each string at most; default: the scene's");
    app.add_option("--theta", options.theta)->check(CLI::Range(0.5, 1.0));
    app.add_option("--stiffness", options.relative_stiffness,
                   "penalty and quadratised rivals: relative stiffness")
        ->check(CLI::PositiveNumber);
    app.add_option("--exponent", options.exponent, "penalty and quadratised rivals")
        ->check(CLI::Range(1.0, 3.0));
    app.add_option("--duration", options.duration_s, "s; default: the scene's")->check(CLI::PositiveNumber);
    app.add_option("--repeat", options.repetition.most, "runs at most")->check(CLI::Range(1, 100));
    app.add_option("--enough", options.repetition.enough_s, "no further run after so many CPU seconds");
    app.add_option("--out", options.out, "samples, float64");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto trajectory = jawari::benchmarks::run(options);
        if (!options.out.empty()) jawari::benchmarks::write_samples(trajectory, options.out);
        std::printf(
            "{\"rows\": %zu, \"probes\": %zu, \"unknowns\": %zu, \"compile_s\": %.9g, \"render_s\": %.9g}\n",
            trajectory.rows, trajectory.probes, trajectory.unknowns, trajectory.compile_s,
            trajectory.render_s);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "trajectory: %s\n", error.what());
        return 1;
    }
    return 0;
}
