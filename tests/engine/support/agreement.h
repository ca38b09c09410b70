// How closely skipping agrees with uniform stepping, beside how closely uniform runs agree with one another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/scenes.h"

namespace jawari::test {

struct Rendered {
    std::vector<double> samples;
    Counters counters;
};

inline Rendered run(const SceneModel& model, const Skipping& skipping, std::size_t frames,
                    std::uint64_t perturbation_seed = 0) {
    SceneState state = make_state(model, Metering::Off, skipping);
    if (perturbation_seed != 0) {  // by half a rounding error up or down
        RandomScene random(perturbation_seed);
        for (double& q : state.strings[0].displacement)
            q *= random.count(0, 1) == 0 ? 1 - 1.2e-16 : 1 + 2.3e-16;
        notice_change(model.strings[0], state.strings[0]);
    }
    Rendered result;
    std::vector<std::vector<double>> signals(model.probe_count, std::vector<double>(frames));
    std::vector<double*> outputs;
    for (auto& signal : signals) outputs.push_back(signal.data());
    render(model, state, outputs, frames);
    for (const auto& signal : signals)
        result.samples.insert(result.samples.end(), signal.begin(), signal.end());
    result.counters = state.strings[0].counters;
    return result;
}

inline double largest(const std::vector<double>& samples) {
    double peak = 0;
    for (const double x : samples) peak = std::max(peak, std::abs(x));
    return peak;
}

inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst / std::max(largest(b), 1e-300);
}

/// One scene with and without skipping.
struct Agreement {
    double difference = 0;  ///< largest, relative to the signals' peak
    double sensitivity =
        0;  ///< the same between uniform runs whose initial state differs by half a rounding error
    std::uint64_t impulses = 0;
    std::uint64_t impulses_skipped = 0;
    std::uint64_t impulse_spread = 0;  ///< between the uniform runs
    bool same_steps = false;

    /// Some laws are chaotic for e > 0.
    [[nodiscard]] double allowed() const { return std::max(1e-11, 100 * sensitivity); }
    /// Uniform runs differ among themselves by impulses at the edge of rounding (a resting contact that just
    /// lifts).
    [[nodiscard]] bool counts_agree() const {
        const auto [fewer, more] = std::minmax(impulses, impulses_skipped);
        return sensitivity >= 1e-9 || more - fewer <= 2 * impulse_spread;
    }
};

inline Agreement agreement(const SceneModel& model, const Skipping& skipping, std::size_t frames,
                           int perturbations = 3) {
    const Rendered uniform = run(model, skip_nothing, frames);
    const Rendered skipped = run(model, skipping, frames);
    Agreement result;
    result.difference = distance(skipped.samples, uniform.samples);
    result.impulses = uniform.counters.impulses;
    result.impulses_skipped = skipped.counters.impulses;
    result.same_steps = skipped.counters.steps == uniform.counters.steps;
    for (int seed = 1; seed <= perturbations; ++seed) {
        const Rendered perturbed = run(model, skip_nothing, frames, static_cast<std::uint64_t>(seed));
        result.sensitivity = std::max(result.sensitivity, distance(perturbed.samples, uniform.samples));
        const auto [fewer, more] = std::minmax(perturbed.counters.impulses, uniform.counters.impulses);
        result.impulse_spread = std::max(result.impulse_spread, more - fewer);
    }
    return result;
}

}  // namespace jawari::test
