// Scenes shared by the engine's tests: random ones within physical bounds, and a bass string by a formula.
#pragma once

#include <cmath>
#include <random>
#include <stdexcept>

#include "jawari/jawari.h"
#include "string/state/excitation.h"

namespace jawari::test {

/// Sanitizer and unoptimised builds look for memory faults, not for numbers: a share of the scenes is enough
/// there.
#if defined(JAWARI_SANITIZED) || !defined(__OPTIMIZE__)
inline constexpr std::size_t share_of_scenes = 25;
#else
inline constexpr std::size_t share_of_scenes = 1;
#endif

struct RandomScene {
    std::mt19937_64 random;

    explicit RandomScene(std::uint64_t seed) : random(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    std::size_t count(std::size_t low, std::size_t high) {
        return std::uniform_int_distribution<std::size_t>(low, high)(random);
    }

    /// One string with frets below it, sometimes a contact from above, plucked so that it strikes.
    StringDescription string() {
        StringDescription s;
        s.length_m = uniform(0.3, 1.5);
        s.linear_density_kg_per_m = logarithmic(3e-4, 2e-2);
        PhysicalModes modes;
        modes.count = count(1, 90);
        modes.tension_N = uniform(30, 300);
        modes.inharmonicity = logarithmic(1e-6, 1e-3);
        modes.inharmonicity_law =
            count(0, 1) == 0 ? InharmonicityLaw::SquareRoot : InharmonicityLaw::FirstOrder;
        if (count(0, 4) == 0) {
            modes.damping = NoLoss{};
        } else if (count(0, 1) == 0) {
            modes.damping = DecayTimePoints{{{{100, uniform(0.5, 10)}, {5000, uniform(0.01, 0.5)}}}};
        } else {
            modes.damping = ValetteLoss{0.001, 1.8e-5, 1.2, logarithmic(1e-3, 1e-1), logarithmic(1e-5, 1e-2)};
        }
        s.modes = modes;
        const double height = uniform(5e-4, 5e-3);
        s.initial.shape = Pluck{s.length_m * uniform(0.05, 0.95), height};
        const std::size_t contacts = count(1, 30);
        for (std::size_t i = 0; i < contacts; ++i) {
            // Every third contact sits close to its neighbour, nearer than the wave travels in an output
            // frame.
            const bool close = i > 0 && count(0, 2) == 0;
            const double x = close ? s.contacts.back().position_m + s.length_m * uniform(0, 2e-3)
                                   : s.length_m * uniform(0.02, 0.95);
            s.contacts.push_back({x, -height * uniform(0, 1), uniform(0, 1), Side::Below});
        }
        if (count(0, 3) == 0)
            s.contacts.push_back({s.length_m * uniform(0.1, 0.9), 2 * height, 0.3, Side::Above});
        s.probes.push_back({Quantity::Displacement, 0.9 * s.length_m, 0});
        return s;
    }

    SceneDescription scene(ImpactLaw law, double low_rate, double high_rate) {
        SceneDescription scene;
        scene.output_rate_hz = 48000;
        scene.contact_rate_hz = 48000 * std::max(1.0, std::round(logarithmic(low_rate, high_rate) / 48000));
        scene.law = law;
        scene.strings.push_back(string());
        return scene;
    }
};

/// The string of smooth/bass, like the published bass (Issanchou et al. 2018) but by a formula, with frets at
/// equal temperament.
inline StringDescription bass_string(std::size_t modes, double loss_angle = 0.01) {
    StringDescription s;
    s.name = "bass";
    s.length_m = 0.863;
    s.linear_density_kg_per_m = 0.0067;
    PhysicalModes physical;
    physical.count = modes;
    physical.tension_N = 191.6;
    physical.inharmonicity = 3.5e-5;
    physical.inharmonicity_law = InharmonicityLaw::FirstOrder;
    physical.damping = ValetteLoss{0.00114, 1.8e-5, 1.2, loss_angle, 3.3e-5};
    s.modes = physical;
    s.initial.shape = Pluck{0.637, 0.003573};
    for (std::size_t fret = 1; fret <= 20; ++fret) {
        const double x = equal_temperament_position(s.length_m, fret);
        s.contacts.push_back({x, -0.00233 * std::min(1.0, 0.27 + x / 0.4), 0, Side::Below});
    }
    s.probes.push_back({Quantity::Displacement, 0.7767, 0});
    return s;
}

inline StringModel compiled_string(const SceneDescription& scene) {
    auto model = compile(scene);
    if (!model) throw std::runtime_error(model.failure().line());
    return model.value().strings.front();
}

/// phi_k(x) of all modes, padded.
inline AlignedVector<double> shape_row(const StringModel& model, double x) {
    AlignedVector<double> row(model.shape->stride, 0.0);
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        row[k] = mode_shape(k + 1, x, model.shape->length_m);
    return row;
}

/// A force of force_N that grows by rate_N a step at x, instead of what acted before.
inline void press(const StringModel& model, StringState& state, double x, double force_N, double rate_N = 0) {
    const AlignedVector<double> row = shape_row(model, x);
    clear_excitation(state);
    add_force(state, row.data(), model.shape->stride, force_N, rate_N);
}

}  // namespace jawari::test
