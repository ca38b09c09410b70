// A plucked string over a fretted neck, described and rendered through the public headers only.
#include <array>
#include <cstdio>
#include <vector>

#include "jawari/jawari.h"

namespace {

constexpr double duration_s = 0.1;

// A bass string of 0.863 m with 20 frets. The first fret is 0.8 mm below the string, the last 1.7 mm.
jawari::StringDescription bass_string() {
    jawari::StringDescription string;
    string.name = "E";
    string.length_m = 0.863;
    string.linear_density_kg_per_m = 0.0178;

    jawari::PhysicalModes modes;
    modes.count = 400;
    modes.tension_N = 90;
    modes.inharmonicity = 3e-5;
    modes.damping = jawari::DecayTimePoints{{{{50, 8.0}, {5000, 1.0}}}};
    string.modes = modes;

    std::vector<double> fret_heights_m;
    for (int fret = 0; fret < 20; ++fret) fret_heights_m.push_back(-0.8e-3 - fret * 0.9e-3 / 19);
    string.contacts = jawari::equal_temperament_frets(string.length_m, fret_heights_m, 0);

    string.initial.shape = jawari::Pluck{.position_m = 0.7, .height_m = 4e-3};
    string.probes.push_back({.quantity = jawari::Quantity::Displacement, .position_m = 0.8});
    string.probes.push_back({.quantity = jawari::Quantity::ContactForce, .contact = 19});
    return string;
}

void print_result(const jawari::StringModel& model, const jawari::StringState& state,
                  const std::vector<double>& force_N) {
    double strongest_N = 0;
    for (const double force : force_N) strongest_N = force > strongest_N ? force : strongest_N;

    std::printf("modes %zu, contacts %zu\n", model.shape->mode_count, model.shape->contact_count);
    std::printf("steps %llu\n", static_cast<unsigned long long>(state.counters.steps));
    std::printf("impulses %llu\n", static_cast<unsigned long long>(state.counters.impulses));
    std::printf("worst_penetration_m %.3e\n", state.counters.worst_penetration_m);
    std::printf("strongest_force_on_fret_20_N %.4f\n", strongest_N);
    std::printf("energy_at_start_J %.9e\n", state.energy.initial);
    std::printf("energy_at_end_J %.9e\n", jawari::energy(model, state));
    std::printf("dissipated_J %.9e\n", state.energy.dissipated);
    std::printf("contact_work_J %.9e\n", state.energy.contact_work);
    std::printf("worst_imbalance_ratio %.3e\n", state.energy.worst_imbalance / state.energy.initial);
}

// What is not allowed is refused with a reason, before any sound is made.
void show_failure(jawari::SceneDescription scene) {
    scene.strings.front().contacts.front().position_m = 2;
    const auto refused = jawari::compile(scene);
    std::printf("refused %s\n", refused.ok() ? "NOTHING" : refused.failure().line().c_str());
}

}  // namespace

int main() {
    jawari::SceneDescription scene;
    scene.output_rate_hz = 48000;
    scene.contact_rate_hz = 960000;
    scene.strings.push_back(bass_string());

    const auto compiled = jawari::compile(scene);
    if (!compiled) {
        std::fprintf(stderr, "%s\n", compiled.failure().line().c_str());
        return 1;
    }
    const jawari::SceneModel& model = compiled.value();

    // From here on nothing allocates inside the engine: this loop could run on an audio thread.
    jawari::SceneState state = jawari::make_state(model, jawari::Metering::Step);
    constexpr std::size_t block = 64;
    const auto frames = static_cast<std::size_t>(duration_s * model.output_rate_hz);
    std::vector<double> displacement_m(frames);
    std::vector<double> force_N(frames);
    for (std::size_t frame = 0; frame < frames; frame += block) {
        const std::size_t count = frames - frame < block ? frames - frame : block;
        const std::array<double*, 2> outputs{&displacement_m[frame], &force_N[frame]};
        jawari::render(model, state, outputs, count);
    }

    print_result(model.strings.front(), state.strings.front(), force_N);
    show_failure(scene);
    return 0;
}
