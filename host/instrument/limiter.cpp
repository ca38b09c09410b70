#include "instrument/limiter.h"

#include <algorithm>
#include <cmath>

namespace jawari::host {

namespace {

constexpr double audible_reduction = 0.999;  // 0.009 dB

double needed_gain(const Limiter& limiter, double left, double right) {
    const double magnitude = std::max(std::abs(left), std::abs(right));
    return magnitude > limiter.ceiling ? limiter.ceiling / magnitude : 1.0;
}

/// Mean of the curve; rounding must not lift it above its largest term.
double mean(const Limiter& limiter) {
    double sum = 0;
    double largest = 0;
    for (const double value : limiter.curve) {
        sum += value;
        largest = std::max(largest, value);
    }
    return std::min(largest, sum / static_cast<double>(limiter.curve.size()));
}

}  // namespace

Limiter make_limiter(double ceiling, double rate_hz) {
    Limiter limiter;
    limiter.ceiling = ceiling;
    limiter.look_ahead = static_cast<std::size_t>(std::ceil(limiter_look_ahead_s * rate_hz));
    limiter.recovery = std::exp(-1 / (limiter_recovery_s * rate_hz));
    const std::size_t length = limiter.look_ahead + 1;
    limiter.left.assign(length, 0.0);
    limiter.right.assign(length, 0.0);
    limiter.needed.assign(length, 1.0);
    limiter.curve.assign(length, 1.0);
    return limiter;
}

void limit(Limiter& limiter, double& left, double& right) JAWARI_REALTIME {
    const std::size_t length = limiter.curve.size();
    limiter.left[limiter.at] = left;
    limiter.right[limiter.at] = right;
    limiter.needed[limiter.at] = needed_gain(limiter, left, right);
    double gain = 1;
    if (limiter.acting > 0 || limiter.needed[limiter.at] < 1) {
        const double least = *std::min_element(limiter.needed.begin(), limiter.needed.end());
        double recovering = 1 - (1 - limiter.held) * limiter.recovery;
        if (recovering > 1 - 1e-6) recovering = 1;
        limiter.held = std::min(least, recovering);
        limiter.curve[limiter.at] = limiter.held;
        if (limiter.held < 1) limiter.acting = length;
        gain = mean(limiter);
        if (limiter.held == 1) limiter.acting -= 1;
    }
    limiter.at = (limiter.at + 1) % length;  // now the oldest: look_ahead frames before the one just taken
    left = std::clamp(limiter.left[limiter.at] * gain, -limiter.ceiling, limiter.ceiling);
    right = std::clamp(limiter.right[limiter.at] * gain, -limiter.ceiling, limiter.ceiling);
    limiter.frames += 1;
    if (gain < audible_reduction) limiter.reduced += 1;
    limiter.least_gain = std::min(limiter.least_gain, gain);
}

}  // namespace jawari::host
