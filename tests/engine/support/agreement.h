// Whether skipping agrees with uniform stepping. Calm scenes are compared run by run. In chaotic ones, which
// make any rounding error grow until two runs have nothing in common, a pair of runs says nothing: there,
// runs with skipping from many states next to one another are compared with as many uniform ones that are
// perturbed as rounding does it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/scenes.h"
#include "support/two_samples.h"

namespace jawari::test {

struct Rendered {
    std::vector<std::vector<double>> signals;  ///< of each probe
    Counters counters;
};

/// render() for all probes.
inline Rendered render_all(const SceneModel& model, SceneState& state, std::size_t frames) {
    Rendered result;
    result.signals.assign(model.probe_count, std::vector<double>(frames));
    std::vector<double*> outputs;
    for (auto& signal : result.signals) outputs.push_back(signal.data());
    render(model, state, outputs, frames);
    result.counters = state.strings[0].counters;
    return result;
}

inline Rendered run(const SceneModel& model, const Skipping& skipping, std::size_t frames) {
    SceneState state = make_state(model, Metering::Off, skipping);
    return render_all(model, state, frames);
}

/// Changes displacement and velocity of each mode by up to a share of them.
inline void perturb(const SceneModel& model, SceneState& state, RandomScene& random, double share) {
    for (double& q : state.strings[0].displacement) q *= 1 + random.uniform(-share, share);
    for (double& v : state.strings[0].velocity) v *= 1 + random.uniform(-share, share);
    notice_change(model.strings[0], state.strings[0]);
}

/// Of the initial state. What rounding differs by between skipping and uniform stepping, 1e-15 to 2e-14 of
/// the signals' peak in calm scenes, is lost in it.
inline constexpr double initial_perturbation = 1e-13;
/// Of every frame of uniform stepping: more than rounding adds to a frame with skipping. Where obstacles
/// press, rounding makes a difference not by what it did at first, but by what it goes on doing.
inline constexpr double frame_perturbation = 1e-14;

inline Rendered perturbed_skipping(const SceneModel& model, const Skipping& skipping, std::size_t frames,
                                   std::uint64_t seed) {
    SceneState state = make_state(model, Metering::Off, skipping);
    RandomScene random(seed);
    perturb(model, state, random, initial_perturbation);
    return render_all(model, state, frames);
}

inline Rendered perturbed_stepping(const SceneModel& model, std::size_t frames, std::uint64_t seed) {
    SceneState state = make_state(model, Metering::Off, skip_nothing);
    RandomScene random(seed);
    perturb(model, state, random, initial_perturbation);
    Rendered result;
    result.signals.resize(model.probe_count);
    for (std::size_t n = 0; n < frames; ++n) {
        const Rendered frame = render_all(model, state, 1);
        for (std::size_t p = 0; p < model.probe_count; ++p) result.signals[p].push_back(frame.signals[p][0]);
        perturb(model, state, random, frame_perturbation);
    }
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

/// How far one run is from another: in the first 1/32 of the time, when chaos has not grown yet, in the first
/// 1/16, and so on to all of it; and in its number of impulses.
inline constexpr std::size_t far_ways = 7;
inline std::array<double, far_ways> far(const Rendered& a, const Rendered& b) {
    double peak = 1e-300;
    for (const auto& signal : b.signals) peak = std::max(peak, largest(signal));
    std::array<double, far_ways> result{};
    for (std::size_t probe = 0; probe < a.signals.size(); ++probe) {
        const std::size_t frames = a.signals[probe].size();
        for (std::size_t n = 0; n < frames; ++n) {
            const double difference = std::abs(a.signals[probe][n] - b.signals[probe][n]) / peak;
            for (std::size_t way = 0; way + 1 < far_ways; ++way) {
                if (n << (far_ways - 2 - way) < frames) result[way] = std::max(result[way], difference);
            }
        }
    }
    const auto [fewer, more] = std::minmax(a.counters.impulses, b.counters.impulses);
    result.back() = static_cast<double>(more - fewer);
    return result;
}

/// One scene with and without skipping.
struct Agreement {
    double difference = 0;  ///< largest from the same state, relative to the signals' peak
    double spread = 0;      ///< largest between uniform runs from perturbed states; 0 if none was needed
    std::uint64_t impulses = 0;
    std::uint64_t impulses_skipped = 0;
    bool same_steps = false;
    bool same_distribution = true;  ///< runs with skipping are not farther from `uniform` than uniform ones

    [[nodiscard]] bool agrees() const { return same_steps && same_distribution; }
};

/// Whether `count` runs with skipping tend to be more than twice as far from `uniform` as as many without, in
/// one of the ways. If skipping changes no more than rounding does, this answers yes with less than `chance`
/// for each way.
inline bool skipping_is_farther(const SceneModel& model, const Skipping& skipping, std::size_t frames,
                                const Rendered& uniform, std::size_t count, double chance, double& spread) {
    std::array<std::vector<double>, far_ways> skipped, stepped;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t seed = 1000 * count + 2 * k;
        const auto with = far(perturbed_skipping(model, skipping, frames, seed), uniform);
        const auto without = far(perturbed_stepping(model, frames, seed + 1), uniform);
        for (std::size_t way = 0; way < far_ways; ++way) {
            skipped[way].push_back(with[way] / 2);
            stepped[way].push_back(without[way]);
        }
        spread = std::max(spread, without[far_ways - 2]);
    }
    for (std::size_t way = 0; way < far_ways; ++way) {
        if (is_larger(skipped[way], stepped[way], chance)) return true;
    }
    return false;
}

/// Most scenes are calm and take one run each way. If that does not settle it, five runs each way; if those
/// with skipping are all farther away, which equal distributions show in one case of 252, another 32 each way
/// decide. They call a sound scene wrong with a chance of less than 1e-9 for each of the seven ways: for all
/// scenes of all tests together, on every processor and with every compiler that they are ever run with, less
/// than one in ten thousand.
inline Agreement agreement(const SceneModel& model, const Skipping& skipping, std::size_t frames) {
    const Rendered uniform = run(model, skip_nothing, frames);
    const Rendered skipped = run(model, skipping, frames);
    Agreement result;
    const auto apart = far(skipped, uniform);
    result.difference = apart[far_ways - 2];
    result.impulses = uniform.counters.impulses;
    result.impulses_skipped = skipped.counters.impulses;
    result.same_steps = skipped.counters.steps == uniform.counters.steps;
    if (result.difference > 1e-11 || result.impulses != result.impulses_skipped) {
        const auto farther = [&](std::size_t count, double chance) {
            return skipping_is_farther(model, skipping, frames, uniform, count, chance, result.spread);
        };
        result.same_distribution = !(farther(5, 0.01) && farther(32, 1e-9));
    }
    return result;
}

}  // namespace jawari::test
