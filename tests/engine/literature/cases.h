// The cases of docs/engine/accuracy.md: each gives the engine's error at a resolution. Tests bound them,
// literature_accuracy prints them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "literature/bar_on_stop.h"
#include "literature/lattice.h"
#include "literature/middle_obstacle.h"
#include "literature/oscillator.h"
#include "literature/unit_string.h"

namespace jawari::literature {

inline Profile flat(double height) {
    return [=](double) { return height; };
}

/// Cabannes: a point obstacle under the middle, at height -depth; three periods of the free string.
inline UnitString cabannes(double depth, std::size_t intervals) {
    UnitString u;
    u.intervals = intervals;
    u.output_rate_hz = 20;
    u.shape = triangle(0.5, 1);
    u.obstacles = {{flat(-depth), 0.5, 0.5, Side::Below}};
    u.probes = {0.1, 0.25, 0.45, 0.9};
    return u;
}

/// Error of a run against a displacement in closed form.
template <typename Displacement>
double error_against(const UnitString& u, std::size_t rows, const Displacement& exact) {
    std::vector<Samples> reference(u.probes.size(), Samples(rows));
    for (std::size_t p = 0; p < u.probes.size(); ++p) {
        for (std::size_t n = 0; n < rows; ++n)
            reference[p][n] = exact(u.probes[p], static_cast<double>(n) / u.output_rate_hz);
    }
    return error_of(run(scene_of(u), rows).probes, reference);
}

inline double cabannes_error(double depth, const UnitString& u) {
    const MiddleObstacle exact(depth, 7);
    return error_against(u, 121, [&](double x, double t) { return exact.at(x, t); });
}

/// A string plucked in the middle lands on a plane at -depth, two periods.
inline UnitString landing(double depth, std::size_t intervals) {
    UnitString u;
    u.intervals = intervals;
    u.output_rate_hz = 20;
    u.shape = triangle(0.5, 1);
    u.obstacles = {{flat(-depth), 0, 1, Side::Below}};
    u.probes = {0.1, 0.25, 0.5, 0.9};
    return u;
}

/// With e = 0 the part that lands, 1 - depth of the string, loses its motion: 2 (1 - depth) of the energy 2.
inline double landing_energy_error(double depth, const UnitString& u) {
    return std::abs(energy_kept(run(scene_of(u), 81)) - depth);
}

/// With e = 1 that part is thrown back all at once, and the motion runs backward: period 1 + depth (H.
/// Cabannes, as above; L. Amerio and G. Prouse, Rend. Mat. 8, 1975).
inline double landing_elastic_error(double depth, const UnitString& u) {
    return error_against(u, 81, [&](double x, double t) {
        const double period = 1 + depth;
        const double phase = std::fmod(t, period);
        const double fallen = 1 - 2 * std::min(phase, period - phase);
        const double triangle_there = 2 * std::min(x, 1 - x);
        return fallen >= 0 ? std::min(triangle_there, fallen) : std::max(-triangle_there, fallen);
    });
}

/// The scene files plane_255 and plane_999: 100 kHz, many steps to an interval. Half the string lands at t =
/// 3/4.
inline SceneDescription plane_scene(std::size_t points, ImpactLaw law) {
    SceneDescription scene = scene_of(landing(0.5, points + 1));
    scene.strings[0].initial.shape = Pluck{0.5, 1};
    scene.output_rate_hz = 500;
    scene.contact_rate_hz = 100000;
    scene.law = law;
    return scene;
}
inline constexpr std::size_t rows_past_landing = 378;

/// Error against a lattice of `lattice_intervals`, a multiple of the intervals of `u`.
inline double lattice_error(const UnitString& u, std::size_t rows, std::size_t lattice_intervals) {
    const std::vector<Samples> reference = lattice_samples(u, rows, lattice_intervals / u.intervals);
    return error_of(run(scene_of(u), rows).probes, reference);
}

/// Thrown upwards at 1, between a point above 0.7 and a point below 0.4.
inline UnitString rattling(std::size_t intervals) {
    UnitString u;
    u.intervals = intervals;
    u.output_rate_hz = 20;
    u.shape = flat(0);
    u.speed = 1;
    u.obstacles = {{flat(0.2), 0.7, 0.7, Side::Above}, {flat(-0.25), 0.4, 0.4, Side::Below}};
    u.probes = {0.1, 0.25, 0.55, 0.9};
    return u;
}

/// Burridge, Kappraff and Morshedi, "The sitar string, a vibrating string with a one-sided inelastic
/// constraint", SIAM J. Appl. Math. 42, 1982: the string wraps around a parabolic bridge at its end,
/// inelastically. Plucked at 0.7, lying on the bridge as far as the tangent from there.
inline UnitString sitar(std::size_t intervals) {
    UnitString u;
    u.intervals = intervals;
    u.output_rate_hz = 20;
    const Profile bridge = [](double x) { return 0.4 * x - 4 * x * x; };
    const double corner = 0.7;
    const double height = -0.05;
    const double leaves = corner - std::sqrt(corner * corner - (0.4 * corner - height) / 4);
    u.shape = [=](double x) {
        if (x <= leaves) return bridge(x);
        if (x >= corner) return height * (1 - x) / (1 - corner);
        return bridge(leaves) + (height - bridge(leaves)) * (x - leaves) / (corner - leaves);
    };
    u.obstacles = {{bridge, 0, 0.1, Side::Below}};
    u.probes = {0.1, 0.25, 0.5, 0.9};
    return u;
}

/// Plucked at 0.3 by 1/2, over the arch -1/4 - 0.8 (x - 0.4)^2 along the whole string.
inline UnitString arch(std::size_t intervals) {
    UnitString u;
    u.intervals = intervals;
    u.output_rate_hz = 20;
    u.shape = triangle(0.3, 0.5);
    u.obstacles = {{[](double x) { return -0.25 - 0.8 * (x - 0.4) * (x - 0.4); }, 0, 1, Side::Below}};
    u.probes = {0.1, 0.5, 0.9};
    return u;
}

/// A string falls at 1/10 on a wedge of which the front of contact spreads at `front_speed`. The landed part
/// moves with the front no more, but leans on the wedge: each unit of length loses V^2/2 (1 -
/// 1/front_speed^2). Energy lost over the energy that has to be, until t = 1/10, when nothing has come from
/// the ends yet.
inline double front_loss(double front_speed, std::size_t intervals, double steps_per_interval) {
    UnitString u;
    u.intervals = intervals;
    u.steps_per_interval = steps_per_interval;
    u.output_rate_hz = 100;
    u.shape = flat(0);
    u.speed = -0.1;
    const double slope = 0.1 / front_speed;
    u.obstacles = {{[=](double x) { return -slope * std::abs(x - 0.5); }, 0.05, 0.95, Side::Below}};
    u.probes = {0.5};
    const std::size_t rows = front_speed > 3.5 ? 6 : 11;
    const double duration = static_cast<double>(rows - 1) / 100;
    const Samples energy = run(scene_of(u), rows).probes.back();
    return (energy.front() - energy.back()) / (front_speed * duration * 0.01);
}

inline double oscillator_error(ImpactLaw law, double restitution, double contact_rate_hz, double duration_s) {
    const auto rows = static_cast<std::size_t>(duration_s * 50) + 1;
    const OscillatorOnStop exact(2 * std::numbers::pi, 1, 0.3, restitution, duration_s);
    std::vector<Samples> reference(1, Samples(rows));
    for (std::size_t n = 0; n < rows; ++n) reference[0][n] = exact.at(static_cast<double>(n) / 50);
    return error_of(run(oscillator_scene(law, restitution, contact_rate_hz), rows).probes, reference);
}

/// Three periods of a bar that swings on its stop.
inline double clamped_halves_error(ImpactLaw law, std::size_t modes, double steps_per_period) {
    const ClampedHalves exact;
    SceneDescription scene;
    scene.strings.push_back(bar(modes));
    StringDescription& string = scene.strings[0];
    string.initial.shape = ModalState{exact.modal(modes), {}};
    string.contacts = {{0.5, exact.rise, 0, Side::Below}};
    string.probes = {{Quantity::Displacement, 0.25, 0}, {Quantity::Displacement, 0.4, 0}};
    scene.output_rate_hz = 20 / exact.period_s();
    scene.contact_rate_hz = scene.output_rate_hz * std::round(steps_per_period / 20);
    scene.law = law;
    const std::size_t rows = 61;
    std::vector<Samples> reference(2, Samples(rows));
    for (std::size_t n = 0; n < rows; ++n) {
        const double t = static_cast<double>(n) / scene.output_rate_hz;
        reference[0][n] = exact.at(0.25, t);
        reference[1][n] = exact.at(0.4, t);
    }
    return error_of(run(scene, rows).probes, reference);
}

/// A bar of five modes, dropped on a stop below its middle, 0.4 s.
inline double bouncing_bar_error(ImpactLaw law, double restitution, double contact_rate_hz) {
    const std::vector<double> start{0.5, 0, 0.05, 0, 0.01};
    BouncingBar exact(start, 0.5, -0.2, restitution);
    SceneDescription scene;
    scene.strings.push_back(bar(start.size()));
    StringDescription& string = scene.strings[0];
    string.initial.shape = ModalState{start, {}};
    string.contacts = {{0.5, -0.2, restitution, Side::Below}};
    string.probes = {{Quantity::Displacement, 0.3, 0}};
    scene.output_rate_hz = 200;
    scene.contact_rate_hz = contact_rate_hz;
    scene.law = law;
    const std::size_t rows = 81;
    std::vector<Samples> reference(1, Samples(rows));
    for (std::size_t n = 0; n < rows; ++n) reference[0][n] = exact.at(0.3, static_cast<double>(n) / 200);
    return error_of(run(scene, rows).probes, reference);
}

}  // namespace jawari::literature
