#include "instrument/limiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace jawari::host {
namespace {

constexpr double rate_hz = 48000;
constexpr double pi = 3.14159265358979323846;

struct Limited {
    std::vector<double> left, right;
    Limiter limiter;
};

/// Fed frame by frame and flushed, without the delay.
Limited limited(const std::vector<double>& left, const std::vector<double>& right, double ceiling) {
    Limited result{{}, {}, make_limiter(ceiling, rate_hz)};
    for (std::size_t n = 0; n < left.size() + result.limiter.look_ahead; ++n) {
        double l = n < left.size() ? left[n] : 0;
        double r = n < right.size() ? right[n] : 0;
        limit(result.limiter, l, r);
        if (n < result.limiter.look_ahead) continue;
        result.left.push_back(l);
        result.right.push_back(r);
    }
    return result;
}

double largest(const std::vector<double>& samples) {
    double peak = 0;
    for (const double sample : samples) peak = std::max(peak, std::abs(sample));
    return peak;
}

/// Largest second difference: a click is a jump of the slope.
double roughness(const std::vector<double>& samples) {
    double worst = 0;
    for (std::size_t n = 2; n < samples.size(); ++n)
        worst = std::max(worst, std::abs(samples[n] - 2 * samples[n - 1] + samples[n - 2]));
    return worst;
}

std::vector<double> tone(double level, std::size_t count) {
    std::vector<double> samples(count);
    for (std::size_t n = 0; n < count; ++n)
        samples[n] = level * std::sin(2 * pi * 200 * static_cast<double>(n) / rate_hz);
    return samples;
}

TEST(Limiter, BelowTheCeilingEveryBitIsKept) {
    const auto sound = tone(0.5, 20000);
    const auto result = limited(sound, sound, 0.5);
    EXPECT_EQ(result.left, sound);
    EXPECT_EQ(result.right, sound);
    EXPECT_EQ(result.limiter.reduced, 0U);
    EXPECT_EQ(result.limiter.least_gain, 1.0);
}

TEST(Limiter, NothingLeavesAboveTheCeiling) {
    std::mt19937_64 random(7);
    std::vector<double> left, right;
    for (int n = 0; n < 50000; ++n) {
        const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
        left.push_back((2 * uniform() - 1) * std::exp(6 * uniform() - 4));
        right.push_back(n % 5000 == 0 ? 1000 * uniform() : 0.1 * uniform());
    }
    const auto result = limited(left, right, 0.8);
    EXPECT_LE(largest(result.left), 0.8);
    EXPECT_LE(largest(result.right), 0.8);
    EXPECT_GT(largest(result.right), 0.4);
    EXPECT_GT(result.limiter.reduced, 0U);
}

TEST(Limiter, ASuddenLoudPassageIsLimitedWithoutAClick) {
    // 200 Hz at a quarter of the ceiling, then at 3 times the ceiling, joined at a zero crossing with the
    // slope rising over a period, so that the sound itself has no click.
    std::vector<double> sound;
    for (std::size_t n = 0; n < 48000; ++n) {
        const double time = static_cast<double>(n) / rate_hz;
        const double rise = std::clamp((time - 0.3) * 200, 0.0, 1.0);
        const double level = 0.25 + 2.75 * (0.5 - 0.5 * std::cos(pi * rise));
        sound.push_back((time < 0.7 ? level : 0.25) * std::sin(2 * pi * 200 * time));
    }
    const auto result = limited(sound, sound, 1.0);
    EXPECT_LE(largest(result.left), 1.0);
    EXPECT_LT(roughness(result.left), roughness(sound));
    EXPECT_NEAR(result.limiter.least_gain, 1 / 3.0, 0.02);
    // Recovered: the last tenth of a second is 3 time constants or more after the loud passage.
    for (std::size_t n = 46000; n < 48000; ++n)
        ASSERT_NEAR(result.left[n], sound[n], 0.06 * std::abs(sound[n]) + 1e-12);
}

TEST(Limiter, BothSidesShareTheGain) {
    const auto loud = tone(2, 10000);
    const auto soft = tone(0.1, 10000);
    const auto result = limited(loud, soft, 1.0);
    for (std::size_t n = 0; n < loud.size(); ++n) ASSERT_NEAR(result.right[n] * 20, result.left[n], 1e-12);
}

TEST(Limiter, ItComesToRestAtAGainOfOne) {
    std::vector<double> sound = tone(3, 4800);
    sound.resize(200000, 0.0);
    const auto tail = tone(0.9, 4800);
    sound.insert(sound.end(), tail.begin(), tail.end());
    const auto result = limited(sound, sound, 1.0);
    for (std::size_t n = 0; n < tail.size(); ++n) ASSERT_EQ(result.left[200000 + n], tail[n]);
    EXPECT_EQ(result.limiter.acting, 0U);
}

}  // namespace
}  // namespace jawari::host
