// Exciters: energy balances and closed forms of fingers, hammers, tangents, and of the noise of touches.
#include "instrument/touch/exciters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "instrument/touch/touches.h"
#include "jawari/scene/energy.h"
#include "support/touched_string.h"

namespace jawari {
namespace {

using std::numbers::pi, test::lossless_string, test::play_frame, test::stir;

const HammerDescription felt{.mass_kg = 0.004, .stiffness = 4e8, .exponent = 2.5, .full_speed_m_per_s = 3};

/// Straight lines between samples at 24 kHz have the spectrum sinc^4(f/24 kHz).
TEST(Noise, HasTheRmsAndTheSpectrumThatItsLinesHave) {
    constexpr double rate_hz = 192000;
    constexpr std::size_t length = 960, parts = 800;
    double square = 0;
    for (std::size_t n = 0; n < length * parts; ++n) {
        const double x = noise_at(77, static_cast<double>(n) / rate_hz);
        square += x * x / (length * parts);
    }
    EXPECT_NEAR(square, 1, 0.02);
    const auto power = [&](double hz) {
        double sum = 0;
        for (std::size_t part = 0; part < parts; ++part) {
            double re = 0, im = 0;
            for (std::size_t n = 0; n < length; ++n) {
                const double x = noise_at(77, static_cast<double>(part * length + n) / rate_hz);
                re += x * std::cos(2 * pi * hz * static_cast<double>(n) / rate_hz);
                im += x * std::sin(2 * pi * hz * static_cast<double>(n) / rate_hz);
            }
            sum += re * re + im * im;
        }
        return sum;
    };
    const double low = power(600);
    for (const double hz : {4000.0, 8000.0, 12000.0}) {
        const double y = pi * hz / 24000;
        const double expected = 40 * std::log10(std::sin(y) / y);
        EXPECT_NEAR(10 * std::log10(power(hz) / low), expected, 0.6) << hz;  // 800 windows: 0.15 dB
    }
}

TEST(Noise, NoTwoAreAlike) {
    double like = 0;
    for (std::size_t n = 0; n < 20000; ++n) {
        const double time_s = static_cast<double>(n) / 24000;
        like += noise_at(1, time_s) * noise_at(2, time_s) / 20000;
    }
    EXPECT_LT(std::abs(like), 0.03);
    const StringModel model = lossless_string(20);
    TouchState touches = make_touch_state(model.shape->stride);
    const std::uint64_t first = next_noise(model, touches);
    EXPECT_NE(next_noise(model, touches), first);
}

/// With roughness r the force is that of a smooth finger times 1 + r N, whatever the output rate.
TEST(Noise, OfAFingerIsAShareOfItsForce) {
    ExciterState smooth, rough;
    for (ExciterState* exciter : {&smooth, &rough}) {
        exciter->phase = ExciterPhase::Finger;
        exciter->peak = 3;
        exciter->rise_frames = 200;
        exciter->release_frames = 20;
    }
    rough.roughness = 0.25;
    rough.seed = 5;
    StringAtExciter at;
    at.frame_s = 1 / 48000.0;
    for (int n = 0; n < 220; ++n) {
        const double plain = exciter_force(at, smooth);
        EXPECT_NEAR(exciter_force(at, rough), plain * (1 + 0.25 * noise_at(5, (n + 0.5) / 48000)), 1e-11)
            << n;
    }
    EXPECT_EQ(rough.phase, ExciterPhase::None);
}

double felt_energy(const StringModel& model, const StringState& state, const ExciterState& hammer) {
    double w = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        w += hammer.row[k] * (state.displacement[k] - model.shape->step_s / 2 * state.velocity[k]);
    const double xi = std::max(0.0, hammer.position_m - w);
    return hammer.stiffness * std::pow(xi, hammer.exponent + 1) / (hammer.exponent + 1);
}

TEST(Hammer, StringHammerAndFeltShareTheirEnergy) {
    const StringModel model = lossless_string(150);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    begin_hammer(model, state, touches.exciter, 0.08, 0.01, felt, 3, 1);
    const ExciterState& hammer = touches.exciter;
    const double start = felt.mass_kg * 9 / 2;
    PlayerWork work;
    int frames = 0;
    for (; hammer.phase == ExciterPhase::Hammer; ++frames) {
        play_frame(model, state, touches, work);
        const double sum = energy(model, state) + felt_energy(model, state, hammer) +
                           felt.mass_kg * hammer.speed_m_per_s * hammer.speed_m_per_s / 2;
        ASSERT_NEAR(sum, start, 1e-9 * start) << "frame " << frames;
    }
    EXPECT_GT(frames, 20);
    EXPECT_LT(frames, 2000);
    EXPECT_LT(hammer.speed_m_per_s, 0);  // thrown back
    EXPECT_GT(energy(model, state), 0.1 * start);
    EXPECT_NEAR(work.exciters_J, energy(model, state), 1e-9 * start);
}

TEST(Hammer, ALossyFeltLosesAndNeverPulls) {
    const StringModel model = lossless_string(150);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    HammerDescription lossy = felt;
    lossy.loss_s_per_m = 0.3;
    begin_hammer(model, state, touches.exciter, 0.08, 0, lossy, 3, 1);
    const ExciterState& hammer = touches.exciter;
    const double start = felt.mass_kg * 9 / 2;
    double before = start;
    PlayerWork work;
    while (hammer.phase == ExciterPhase::Hammer) {
        play_frame(model, state, touches, work);
        const double sum = energy(model, state) + felt_energy(model, state, hammer) +
                           felt.mass_kg * hammer.speed_m_per_s * hammer.speed_m_per_s / 2;
        ASSERT_LE(sum, before + 1e-12 * start);
        ASSERT_GE(hammer.point.force_N, 0);
        before = sum;
    }
    EXPECT_LT(before, 0.99 * start);
}

/// On a string too heavy to move, a linear felt is a spring: contact lasts pi sqrt(m/K), the greatest force
/// is V sqrt(m K).
TEST(Hammer, OnAnImmobileStringIsAMassOnASpring) {
    SceneDescription scene;
    scene.contact_rate_hz = 192000;
    StringDescription string;
    string.name = "beam";
    string.length_m = 1;
    string.linear_density_kg_per_m = 1e5;
    string.modes = ModeTable{{1000}, {0}};
    scene.strings.push_back(string);
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    const HammerDescription spring{.mass_kg = 0.01, .stiffness = 1e4, .exponent = 1, .full_speed_m_per_s = 2};
    begin_hammer(model, state, touches.exciter, 0.5, 0, spring, 2, 1);
    PlayerWork work;
    double frames = 0;
    double largest = 0;
    while (touches.exciter.phase == ExciterPhase::Hammer) {
        play_frame(model, state, touches, work);
        frames += touches.exciter.point.force_N > 0 ? 1 : 0;
        largest = std::max(largest, touches.exciter.point.force_N);
    }
    EXPECT_NEAR(frames / 48000, pi * std::sqrt(0.01 / 1e4), 2.0 / 48000);
    EXPECT_NEAR(largest, 2 * std::sqrt(0.01 * 1e4), 1e-3 * 20);
    EXPECT_NEAR(touches.exciter.speed_m_per_s, -2, 1e-3);
}

/// xi+ of the law by 200 halvings in long double.
long double compression_by_halving(const ExciterState& hammer, const StringAtExciter& at) {
    const auto V = [&](long double xi) {
        return xi <= 0 ? 0.0L
                       : hammer.stiffness * std::pow(xi, hammer.exponent + 1.0L) / (hammer.exponent + 1.0L);
    };
    const long double T = at.frame_s,
                      before = static_cast<long double>(hammer.position_m) - at.displacement_m;
    const long double slope =
        before > 0 ? hammer.loss_s_per_m * hammer.stiffness * std::pow(before, hammer.exponent + 0.0L) / T
                   : 0.0L;
    const long double give = T * T / (2 * hammer.mass_kg) + at.give_m_per_N;
    const long double free = before + T * hammer.speed_m_per_s - at.rise_m;
    const auto force = [&](long double xi) {
        const long double change = xi - before;
        const long double elastic = change == 0 ? 0.0L : (V(xi) - V(before)) / change;
        return std::max(0.0L, elastic + slope * change);
    };
    long double low = std::min(0.0L, std::min(free, before)) - std::sqrt(give * V(before));
    long double high = free;
    for (int i = 0; i < 200; ++i) {
        const long double middle = (low + high) / 2;
        (middle - free + give * force(middle) > 0 ? high : low) = middle;
    }
    return low;
}

TEST(Hammer, TheCompressionIsThatOfHalvings) {
    std::mt19937_64 random(3);
    const auto log_uniform = [&](double low, double high) {
        return low * std::pow(high / low, static_cast<double>(random() >> 11) * 0x1p-53);
    };
    for (int trial = 0; trial < 2000; ++trial) {
        ExciterState hammer;
        hammer.phase = ExciterPhase::Hammer;
        hammer.mass_kg = log_uniform(1e-4, 0.1);
        hammer.exponent = log_uniform(1, 5);
        const double scale_m = log_uniform(1e-6, 1e-2);
        hammer.stiffness =
            log_uniform(1e-3, 1e6) / std::pow(scale_m, hammer.exponent);  // N at that compression
        hammer.loss_s_per_m = trial % 3 == 0 ? 0.0 : log_uniform(1e-3, 10);
        hammer.position_m = (trial % 2 == 0 ? 1 : -1) * log_uniform(0.01, 1) * scale_m;
        hammer.speed_m_per_s = (trial % 5 < 3 ? 1 : -1) * log_uniform(0.01, 10);
        StringAtExciter at;
        at.frame_s = 1.0 / 48000;
        at.rise_m = (trial % 7 < 4 ? 1 : -1) * log_uniform(1e-3, 1) * scale_m;
        at.give_m_per_N = log_uniform(1e-8, 1e-3);
        const long double expected = compression_by_halving(hammer, at);
        const double size = std::abs(hammer.position_m) + std::abs(at.frame_s * hammer.speed_m_per_s) +
                            std::abs(at.rise_m) + std::abs(static_cast<double>(expected));
        // Rounding of the compression times what the felt makes of it.
        const double give = at.frame_s * at.frame_s / (2 * hammer.mass_kg) + at.give_m_per_N;
        const double stiffness = hammer.stiffness * std::pow(size, hammer.exponent - 1) *
                                 (hammer.exponent + hammer.loss_s_per_m * size / at.frame_s);
        const double force = exciter_force(at, hammer);
        const double after = hammer.position_m - (at.rise_m + at.give_m_per_N * force);
        ASSERT_NEAR(after, static_cast<double>(expected), (1e-13 + 1e-15 * give * stiffness) * size) << trial;
    }
}

/// Duhamel's integral with the end's acceleration: q_k = -g_k int b''(s) sin(omega (t - s))/omega ds.
TEST(Tangent, MovesTheStringAsItsEndDemands) {
    const StringModel model = lossless_string(40);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    const std::uint64_t rise = 96;
    const double height = 0.002;
    begin_tangent(model, touches.exciter, height, rise);
    touches.outdated = true;
    PlayerWork work;
    const int frames = 300;
    for (int frame = 0; frame < frames; ++frame) play_frame(model, state, touches, work);
    const double T = static_cast<double>(rise) / 48000;
    const double end = frames / 48000.0;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{10}}) {
        const double omega = model.tuning.omega[k - 1];
        double integral = 0;
        const int steps = 200000;
        for (int i = 0; i < steps; ++i) {
            const double s = (i + 0.5) * T / steps;
            const double b2 = height * 2 * pi / (T * T) * std::sin(2 * pi * s / T);
            integral += b2 * std::sin(omega * (end - s)) / omega * T / steps;
        }
        const double g = std::sqrt(2 * model.shape->length_m) / (static_cast<double>(k) * pi);
        EXPECT_NEAR(state.displacement[k - 1], -g * integral, 2e-3 * g * height) << "mode " << k;
    }
    EXPECT_NEAR(work.exciters_J, energy(model, state), 1e-9 * energy(model, state));
}

TEST(Finger, ItsForceIsHalfACosineOnTheMean) {
    double sum = 0;
    for (std::uint64_t n = 0; n < 60; ++n) sum += finger_shape(n, 40, 20);
    EXPECT_NEAR(sum, 30, 1e-12);  // half of rise and release
    EXPECT_NEAR(finger_shape(20, 40, 20), 0.5 + 0.5 * std::sin(pi / 80), 1e-3);
    EXPECT_EQ(finger_shape(60, 40, 20), 0);
    EXPECT_NEAR(finger_shape(39, 40, 20), 1, 1e-3);
}

}  // namespace
}  // namespace jawari
