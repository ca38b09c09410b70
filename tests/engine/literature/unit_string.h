// The string of the literature's cases: length, density and tension 1, so that waves travel at 1 and a period
// is 2. Scenes for the engine, and how far its samples are from a reference.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include "jawari/jawari.h"

namespace jawari::literature {

/// One probe's displacements [m], row n at t = n/output rate.
using Samples = std::vector<double>;
/// A displacement along the string [m].
using Profile = std::function<double(double x)>;

/// A triangle of `height` with its corner at `position`.
inline Profile triangle(double position, double height) {
    return [=](double x) { return height * std::min(x / position, (1 - x) / (1 - position)); };
}

/// Places between two ends that an obstacle occupies, and its height there.
struct Obstacle {
    Profile height;
    double from = 0;
    double to = 1;
    Side side = Side::Below;
};

struct UnitString {
    std::size_t intervals = 0;      ///< of the grid that carries modes and contacts: intervals - 1 modes
    double steps_per_interval = 1;  ///< contact steps while a wave travels an interval
    double output_rate_hz = 0;      ///< must divide the contact rate
    ImpactLaw law = ImpactLaw::Signorini;
    double restitution = 0;
    Profile shape;     ///< at t = 0; the modes pass through it at the grid's nodes
    double speed = 0;  ///< of the whole string at t = 0, upwards [m/s]
    std::vector<Obstacle> obstacles;
    std::vector<double> probes;  ///< positions
};

/// Modal coordinates of the sine polynomial through a profile's values at the nodes.
inline std::vector<double> through_nodes(const Profile& profile, std::size_t intervals) {
    std::vector<double> q(intervals - 1);
    for (std::size_t j = 1; j < intervals; ++j) {
        const double x = static_cast<double>(j) / static_cast<double>(intervals);
        const double value = profile(x) / static_cast<double>(intervals);
        for (std::size_t k = 1; k < intervals; ++k) q[k - 1] += value * mode_shape(k, x, 1);
    }
    return q;
}

inline std::vector<ContactDescription> contacts_at_nodes(const UnitString& u) {
    std::vector<ContactDescription> contacts;
    const double rounding = 1e-9;
    for (const Obstacle& obstacle : u.obstacles) {
        for (std::size_t j = 1; j < u.intervals; ++j) {
            const double x = static_cast<double>(j) / static_cast<double>(u.intervals);
            if (x < obstacle.from - rounding || x > obstacle.to + rounding) continue;
            contacts.push_back({x, obstacle.height(x), u.restitution, obstacle.side});
        }
    }
    return contacts;
}

inline SceneDescription scene_of(const UnitString& u) {
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 1;
    PhysicalModes modes;
    modes.count = u.intervals - 1;
    modes.tension_N = 1;
    string.modes = modes;
    ModalState start;
    start.displacement = through_nodes(u.shape, u.intervals);
    if (u.speed != 0) start.velocity = through_nodes([&](double) { return u.speed; }, u.intervals);
    string.initial.shape = start;
    string.contacts = contacts_at_nodes(u);
    for (const double x : u.probes) string.probes.push_back({Quantity::Displacement, x, 0});
    string.probes.push_back({Quantity::Energy, 0, 0});
    SceneDescription scene;
    scene.output_rate_hz = u.output_rate_hz;
    const double rate = u.steps_per_interval * static_cast<double>(u.intervals);
    scene.contact_rate_hz = std::max(1.0, std::round(rate / u.output_rate_hz)) * u.output_rate_hz;
    scene.law = u.law;
    scene.strings.push_back(string);
    return scene;
}

/// What the engine makes of a scene.
struct EngineRun {
    std::vector<Samples> probes;
    Counters counters;  ///< of the first string
};

inline EngineRun run(const SceneDescription& scene, std::size_t rows) {
    const auto compiled = compile(scene);
    if (!compiled) throw std::runtime_error(compiled.failure().line());
    const SceneModel& model = compiled.value();
    SceneState state = make_state(model);
    EngineRun result;
    result.probes.assign(model.probe_count, Samples(rows));
    std::vector<double*> outputs;
    for (Samples& probe : result.probes) outputs.push_back(probe.data());
    render(model, state, outputs, rows);
    result.counters = state.strings[0].counters;
    return result;
}

/// H(end)/H(0) of a run; the energy probe is the last.
inline double energy_kept(const EngineRun& r) {
    return r.probes.back().back() / r.probes.back().front();
}

/// Relative L2 error over all rows of as many probes as the reference has.
inline double error_of(const std::vector<Samples>& samples, const std::vector<Samples>& reference) {
    double difference = 0;
    double size = 0;
    for (std::size_t p = 0; p < reference.size(); ++p) {
        for (std::size_t n = 0; n < reference[p].size(); ++n) {
            const double d = samples.at(p).at(n) - reference[p][n];
            difference += d * d;
            size += reference[p][n] * reference[p][n];
        }
    }
    return std::sqrt(difference / size);
}

}  // namespace jawari::literature
