// A limiter with look-ahead: plain state, a function of samples in order, nothing allocated after the start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/realtime.h"

namespace jawari::host {

/// Gain of a sample = mean over the last `look_ahead` + 1 frames of a curve that falls at once to the least
/// gain that any of them needs and rises again exponentially. Each term is at most the gain that the delayed
/// sample needs, so no sample leaves above the ceiling; and the gain moves in straight lines, without clicks.
/// Both sides share it. While nothing exceeds the ceiling the gain is exactly 1.
struct Limiter {
    double ceiling = 1;          ///< largest magnitude that leaves
    std::size_t look_ahead = 0;  ///< frames of delay
    double recovery = 0;         ///< share of the gain's distance to 1 that is left after a frame

    std::vector<double> left, right;  ///< delayed samples; rings of look_ahead + 1
    std::vector<double> needed;       ///< gain that each of them needs
    std::vector<double> curve;        ///< before the mean
    std::size_t at = 0;
    std::uint64_t frames = 0;   ///< taken
    std::uint64_t reduced = 0;  ///< frames that left more than 0.01 dB softer
    double least_gain = 1;      ///< so far
    double held = 1;            ///< last value of the curve
    std::size_t acting = 0;     ///< frames for which the mean is still to be taken; 0: gain 1
};

inline constexpr double limiter_look_ahead_s = 0.002;
inline constexpr double limiter_recovery_s = 0.08;  ///< to 1/e

/// ceiling: above 0.
Limiter make_limiter(double ceiling, double rate_hz);

/// Takes a frame and replaces it by the one of `look_ahead` frames before, limited; zeros at the start.
void limit(Limiter& limiter, double& left, double& right) JAWARI_REALTIME;

}  // namespace jawari::host
