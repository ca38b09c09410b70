// A string that lies on a parabolic bridge at its end, at rest: the scene file wrap_2400 from its formula.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "literature/unit_string.h"

namespace jawari::literature {

/// The scene file gives the bridge as chords of 1/10 mm of the parabola 0.4 x - 4 x^2, up to x = 0.1.
inline double bridge_of_chords(double x) {
    if (x > 0.1) return -10;
    const double chord = 1e-4;
    const double from_its_start = x - chord * std::floor(x / chord);
    return 0.4 * x - 4 * x * x - 4 * from_its_start * (chord - from_its_start);
}

/// The string lies on it up to x = a, where its tangent meets the far
/// end, a = 1 - sqrt(0.9), and is straight from there: u'' = -8 up to a, so q_k is 8 sqrt(2) (1 - cos(k pi
/// a)) over (k pi)^3. Touching points have gaps of up to 1e-8: the chords, and the modes that are missing.
inline SceneDescription bridge_at_rest(std::size_t points) {
    UnitString u;
    u.intervals = points + 1;
    u.output_rate_hz = 1000;
    u.shape = [](double) { return 0; };
    u.obstacles = {{bridge_of_chords, 0, 1, Side::Below}};
    u.probes = {0.02, 0.5, 0.9};
    SceneDescription scene = scene_of(u);
    scene.contact_rate_hz = 64000;
    const double a = 1 - std::sqrt(0.9);
    ModalState lying;
    for (std::size_t k = 1; k <= points; ++k) {
        const double wave = std::numbers::pi * static_cast<double>(k);
        lying.displacement.push_back(8 * std::numbers::sqrt2 * (1 - std::cos(wave * a)) /
                                     (wave * wave * wave));
    }
    scene.strings[0].initial.shape = lying;
    return scene;
}

/// The furthest that a probe of displacement moves from where it was.
inline double furthest_from_rest(const EngineRun& r) {
    double furthest = 0;
    for (std::size_t p = 0; p + 1 < r.probes.size(); ++p) {
        for (const double u : r.probes[p]) furthest = std::max(furthest, std::abs(u - r.probes[p][0]));
    }
    return furthest;
}

}  // namespace jawari::literature
