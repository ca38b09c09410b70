// A string without obstacles, and its frames under touches, for tests of touches and exciters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "instrument/touch/touches.h"
#include "string/frame/frame.h"
#include "support/scenes.h"

namespace jawari::test {

inline StringModel lossless_string(std::size_t modes, double contact_rate_hz = 192000, bool lossless = true) {
    SceneDescription scene;
    scene.contact_rate_hz = contact_rate_hz;
    StringDescription string;
    string.name = "lossless";
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes physical;
    physical.count = modes;
    physical.tension_N = 70;
    physical.inharmonicity = 1e-4;
    if (!lossless) physical.damping = DecayTimePoints{{{{100, 8}, {5000, 1}}}};
    string.modes = physical;
    scene.strings.push_back(string);
    return compiled_string(scene);
}

inline void stir(const StringModel& model, StringState& state, std::mt19937& random) {
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        state.velocity[k] = normal(random) / static_cast<double>(k + 1);
        state.displacement[k] = normal(random) / model.tuning.omega[k];
    }
    notice_change(model, state);
}

inline void play_frame(const StringModel& model, StringState& state, TouchState& touches, PlayerWork& work) {
    const std::uint64_t impulses = state.counters.impulses;
    apply_touches(model, state, touches);
    advance_frame(model, state);
    meter_touches(model, state, touches, state.counters.impulses != impulses, work);
}

}  // namespace jawari::test
