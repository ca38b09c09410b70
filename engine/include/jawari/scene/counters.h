// What rendering a string has counted.
#pragma once

#include <cstdint>

#include "jawari/realtime.h"

namespace jawari {

/// Counts of one string since its reset(), and the worst residual and penetration seen. Sums over several
/// strings are formed with +=.
struct Counters {
    std::uint64_t steps = 0;             ///< contact steps simulated
    std::uint64_t candidates = 0;        ///< evaluated contacts that were candidates of their step's law
    std::uint64_t impulses = 0;          ///< impulses > 0
    std::uint64_t solves = 0;            ///< complementarity problems with a violated candidate
    std::uint64_t truncated_solves = 0;  ///< solves that hit the bound on operations; made passive by scaling
    std::uint64_t flown_frames = 0;      ///< output frames crossed by free flight
    std::uint64_t near_frames = 0;       ///< output frames stepped finely for the contacts that might close
    std::uint64_t asleep_frames = 0;     ///< output frames of a string at rest, which cost nothing
    std::uint64_t nonfinite_resets =
        0;  ///< times the string was put to rest because its state was not finite
    /// Largest residual max_c |min(y_c - tau_c, A_cc lambda_c)| of the finished solves [m].
    double worst_residual_m = 0;
    /// Largest penetration -gap at the end of a step [m].
    double worst_penetration_m = 0;
};

/// Adds the counts of `more`; keeps the larger residual and penetration. Threads: any; realtime-safe.
Counters& operator+=(Counters& sum, const Counters& more) JAWARI_REALTIME;

}  // namespace jawari
