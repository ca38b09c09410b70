// Scenes of one string for the tests of the laboratory.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "jawari/scene/compile.h"
#include "jawari/scene/render.h"

namespace jawari::laboratory {

inline constexpr double pi = std::numbers::pi;

inline SceneDescription scene_of(StringDescription string, double output_rate_hz, double contact_rate_hz) {
    SceneDescription scene;
    scene.output_rate_hz = output_rate_hz;
    scene.contact_rate_hz = contact_rate_hz;
    scene.strings.push_back(std::move(string));
    return scene;
}

/// Length, density and tension 1: waves travel at 1. Modes as those of a string of points.
inline StringDescription unit_string(std::size_t modes) {
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 1;
    PhysicalModes physical;
    physical.count = modes;
    physical.tension_N = 1;
    string.modes = physical;
    return string;
}

/// One mode of mass m whose shape is 1 at its only point: a mass on a spring, or free with frequency 0.
inline StringDescription mass(double mass_kg, double frequency_hz, double height_m, double velocity_m_per_s) {
    StringDescription body;
    body.modes = ModeTable{{frequency_hz}, {0.0}};
    body.shapes = ShapeTable{{mass_kg}, {{1.0}}};
    body.initial.shape = ModalState{{height_m}, {velocity_m_per_s}};
    return body;
}

struct Signals {
    std::vector<std::vector<double>> probes;
    StringState last;
};

inline Signals simulate(const SceneDescription& scene, std::size_t rows, Metering metering = Metering::Off,
                        Skipping skipping = skip_all) {
    const auto model = compile(scene);
    EXPECT_TRUE(model) << (model ? "" : model.failure().place + ": " + model.failure().value);
    Signals signals;
    if (!model) return signals;
    SceneState state = make_state(model.value(), metering, skipping);
    signals.probes.assign(model.value().probe_count, std::vector<double>(rows));
    std::vector<double*> outputs;
    for (auto& probe : signals.probes) outputs.push_back(probe.data());
    render(model.value(), state, outputs, rows);
    signals.last = state.strings.front();
    return signals;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t n = 0; n < a.size(); ++n) worst = std::max(worst, std::abs(a[n] - b[n]));
    return worst;
}

}  // namespace jawari::laboratory
