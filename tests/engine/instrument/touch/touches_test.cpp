// Touches and exciters: energy balances, closed forms, and what hands leave of a sound.
#include "instrument/touch/touches.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "instrument/touch/exciters.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "string/frame/frame.h"
#include "string/state/excitation.h"
#include "support/scenes.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

StringModel lossless_string(std::size_t modes, double contact_rate_hz = 192000, bool lossless = true) {
    SceneDescription scene;
    scene.contact_rate_hz = contact_rate_hz;
    StringDescription string;
    string.name = "lossless";
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes physical;
    physical.count = modes;
    physical.tension_N = 70;
    physical.inharmonicity = 1e-4;
    if (!lossless) physical.damping = DecayTimePoints{{{{100, 8}, {5000, 1}}}};
    string.modes = physical;
    scene.strings.push_back(string);
    return test::compiled_string(scene);
}

StringModel fretted_string() {
    SceneDescription scene;
    scene.contact_rate_hz = 336000;
    StringDescription string;
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes physical;
    physical.count = 100;
    physical.tension_N = 70;
    physical.inharmonicity = 1e-4;
    physical.damping = DecayTimePoints{{{{100, 8}, {5000, 1}}}};
    string.modes = physical;
    for (int i = 1; i <= 12; ++i) {
        ContactDescription fret;
        fret.position_m = 0.65 * (1 - std::exp2(-i / 12.0));
        fret.height_m = -0.0004 - 0.0001 * i;
        string.contacts.push_back(fret);
    }
    scene.strings.push_back(string);
    return test::compiled_string(scene);
}

void stir(const StringModel& model, StringState& state, std::mt19937& random) {
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        state.velocity[k] = normal(random) / static_cast<double>(k + 1);
        state.displacement[k] = normal(random) / model.tuning.omega[k];
    }
    notice_change(model, state);
}

double spring_energy(const StringModel& model, const StringState& state, const TouchState& touches) {
    double sum = 0;
    for (const Touch& touch : touches.touches) {
        if (!touch.active) continue;
        double w = 0;
        for (std::size_t k = 0; k < model.shape->mode_count; ++k)
            w += touch.row[k] * (state.displacement[k] - model.shape->step_s / 2 * state.velocity[k]);
        sum += touch.stiffness_N_per_m / 2 * (w - touch.rest_m) * (w - touch.rest_m);
    }
    return sum;
}

void play_frame(const StringModel& model, StringState& state, TouchState& touches, PlayerWork& work) {
    const std::uint64_t impulses = state.counters.impulses;
    apply_touches(model, state, touches);
    advance_frame(model, state);
    meter_touches(model, state, touches, state.counters.impulses != impulses, work);
}

/// A damping hand that sweeps, a finger that lets go, and more touches than one sweep takes.
void lay_some(const StringModel& model, const StringState& state, TouchState& touches, int trial) {
    const int count = trial % 3 == 2 ? static_cast<int>(touch_slots) : 1 + trial % 3;
    for (int i = 0; i < count; ++i) {
        lay_touch(model, state, touches, static_cast<TouchSlot>(i),
                  {.x_m = 0.05 + 0.07 * i,
                   .sweep_m = i < 2 ? 0.02 : 0.0,
                   .damping_kg_per_s = 0.3,
                   .stiffness_N_per_m = i == 3 ? 200.0 : 0.0,
                   .frames = i == 1 ? 40U : 0U,
                   .ease_frames = 20,
                   .noise_N = i == 0 ? 0.02 : 0.0,
                   .noise_frames = 100});
    }
    if (trial % 2 == 0) return;
    HammerDescription hammer;
    hammer.mass_kg = 0.003;
    hammer.stiffness = 1e8;
    hammer.exponent = trial % 4 == 1 ? 1.5 : 2.3;
    hammer.loss_s_per_m = 0.1;
    begin_hammer(model, state, touches.exciter, 0.08, 0.003, hammer, 3, 1);
    touches.outdated = true;
}

/// The same frames sweep by sweep, whatever is known of the next one.
TEST(Touches, FlightsUnderThemAreFramesUnderThem) {
    std::mt19937 random(12);
    for (int trial = 0; trial < 12; ++trial) {
        const StringModel model = lossless_string(120, 192000, false);
        StringState state = make_string_state(model);
        TouchState touches = make_touch_state(model.shape->stride);
        stir(model, state, random);
        lay_some(model, state, touches, trial);
        const AlignedVector<double> read(model.shape->stride, 0.7);
        std::vector<StringState> flown(2, state);
        std::vector<TouchState> touched(2, touches);
        std::vector<PlayerWork> flown_work(2);
        std::vector<TouchedRun> runs(2);
        PlayerWork work;
        ASSERT_TRUE(flies_always(model, state));
        const double scale = energy(model, state) + 0.02;
        for (int frame = 0; frame < 400; ++frame) {
            play_frame(model, state, touches, work);
            double sum = 0;
            for (const double q : state.displacement) sum += 0.7 * q;
            std::array<double, 2> readings{};
            for (std::size_t i = 0; i < 2; ++i) {
                runs[i].read_row = read.data();
                runs[i].goes_on = i == 0 && frame % 32 != 31;  // the second knows nothing of what comes
                readings[i] = fly_touched(model, flown[i], touched[i], runs[i], flown_work[i]);
            }
            ASSERT_NEAR(readings[0], sum, 1e-12) << trial << " " << frame;
            ASSERT_EQ(readings[0], readings[1]) << trial << " " << frame;
        }
        EXPECT_NEAR(flown_work[0].touches_J, work.touches_J, 1e-9 * scale) << trial;
        EXPECT_NEAR(flown_work[0].exciters_J, work.exciters_J, 1e-9 * scale) << trial;
        EXPECT_NEAR(flown_work[0].noises_J, work.noises_J, 1e-9 * scale) << trial;
        EXPECT_NE(work.noises_J, 0) << trial;
        EXPECT_NEAR(energy(model, flown[0]), energy(model, state), 1e-9 * scale) << trial;
    }
}

/// On strings without losses of their own nothing but the touches' measured work changes H, and what dashpots
/// take never comes back.
TEST(Touches, AreTheOnlyChangeOfEnergyAndNeverAddAny) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    const StringModel model = lossless_string(120);
    for (int trial = 0; trial < 40; ++trial) {
        StringState state = make_string_state(model);
        TouchState touches = make_touch_state(model.shape->stride);
        stir(model, state, random);
        const std::size_t count = 1 + static_cast<std::size_t>(trial) % touch_slots;
        for (std::size_t i = 0; i < count; ++i) {
            lay_touch(model, state, touches, static_cast<TouchSlot>(i),
                      {.x_m = 0.65 * (0.02 + 0.96 * uniform(random)),
                       .width_m = 0.02 * uniform(random),
                       .damping_kg_per_s = std::pow(10.0, 8 * uniform(random) - 4),
                       .stiffness_N_per_m = trial % 2 == 0 ? 0.0 : std::pow(10.0, 7 * uniform(random))});
        }
        const double start = energy(model, state) + spring_energy(model, state, touches);
        const double start_H = energy(model, state);
        PlayerWork work;
        double before = start;
        for (int frame = 0; frame < 300; ++frame) {
            play_frame(model, state, touches, work);
            const double now = energy(model, state) + spring_energy(model, state, touches);
            ASSERT_LE(now, before + 1e-11 * start) << "trial " << trial << " frame " << frame;
            before = now;
        }
        EXPECT_NEAR(energy(model, state), start_H + work.touches_J, 1e-10 * start) << "trial " << trial;
        EXPECT_LT(before, start);
    }
}

TEST(Touches, ASpringAloneKeepsTheSumOfEnergies) {
    std::mt19937 random(9);
    const StringModel model = lossless_string(80);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    stir(model, state, random);
    lay_touch(model, state, touches, TouchSlot::Left, {.x_m = 0.2, .stiffness_N_per_m = 2000});
    const double start = energy(model, state) + spring_energy(model, state, touches);
    PlayerWork work;
    for (int frame = 0; frame < 2000; ++frame) play_frame(model, state, touches, work);
    EXPECT_NEAR(energy(model, state) + spring_energy(model, state, touches), start, 1e-9 * start);
}

/// A weak dashpot: sigma_k = c phi_k(x)^2/(2 mu) in first order, mode by mode.
TEST(Touches, AWeakDashpotDampsAsPerturbationTheorySays) {
    const StringModel model = lossless_string(20);
    const double c = 0.004;
    const double x = 0.21;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{5}, std::size_t{11}}) {
        StringState state = make_string_state(model);
        TouchState touches = make_touch_state(model.shape->stride);
        state.displacement[k - 1] = 1e-4;
        notice_change(model, state);
        lay_touch(model, state, touches, TouchSlot::Release, {.x_m = x, .damping_kg_per_s = c});
        const double start = energy(model, state);
        PlayerWork work;
        for (int frame = 0; frame < 24000; ++frame) play_frame(model, state, touches, work);
        const double shape = mode_shape(k, x, model.shape->length_m);
        const double sigma = c * shape * shape / (2 * model.shape->linear_density_kg_per_m);
        EXPECT_NEAR(std::log(start / energy(model, state)) / 2 / 0.5, sigma, 0.01 * sigma) << "mode " << k;
    }
}

TEST(Touches, ComeAndLeaveGraduallyAndAreCountedDown) {
    const StringModel model = lossless_string(20);
    StringState state = make_string_state(model);
    TouchState touches = make_touch_state(model.shape->stride);
    state.displacement[0] = 1e-4;
    notice_change(model, state);
    lay_touch(model, state, touches, TouchSlot::Left,
              {.x_m = 0.2, .damping_kg_per_s = 1, .frames = 50, .ease_frames = 10});
    PlayerWork work;
    std::vector<double> shares;
    for (int frame = 0; frame < 80; ++frame) {
        play_frame(model, state, touches, work);
        shares.push_back(touch_at(touches, TouchSlot::Left).active ? touch_at(touches, TouchSlot::Left).share
                                                                   : 0);
    }
    EXPECT_NEAR(shares[4], 0.5, 1e-12);
    EXPECT_EQ(shares[20], 1);
    EXPECT_NEAR(shares[54], 0.5, 1e-12);
    EXPECT_EQ(shares[70], 0);
    EXPECT_FALSE(state.excitation.active);
}

// ---------------------------------------------------------------------------------------------- noise

/// The noise's own work and that of the dashpot are all that changes the energy, and the dashpot's stays a
/// loss.
TEST(Noise, ItsWorkIsMeteredApartFromWhatTheTouchTakes) {
    std::mt19937 random(12);
    const StringModel model = lossless_string(120);
    for (const double damping : {0.0, 0.3, 50.0}) {
        StringState state = make_string_state(model);
        TouchState touches = make_touch_state(model.shape->stride);
        stir(model, state, random);
        lay_touch(model, state, touches, TouchSlot::Release,
                  {.x_m = 0.2, .damping_kg_per_s = damping, .noise_N = 2, .noise_frames = 200});
        lay_touch(model, state, touches, TouchSlot::Palm, {.x_m = 0.6, .damping_kg_per_s = 0.1});
        const double start = energy(model, state);
        PlayerWork work;
        double taken = 0;
        for (int frame = 0; frame < 300; ++frame) {
            play_frame(model, state, touches, work);
            ASSERT_LE(work.touches_J, taken + 1e-12 * start) << frame;
            taken = work.touches_J;
            if (frame == 199) {
                EXPECT_EQ(touch_at(touches, TouchSlot::Release).noise.level_N, 0);
            }
        }
        EXPECT_NE(work.noises_J, 0);
        EXPECT_NEAR(energy(model, state), start + work.touches_J + work.noises_J, 1e-10 * start) << damping;
    }
}

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

// ---------------------------------------------------------------------------------------------- exciters

const HammerDescription felt{.mass_kg = 0.004, .stiffness = 4e8, .exponent = 2.5, .full_speed_m_per_s = 3};

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

/// A string over frets, plucked by about what just reaches them, and damped by two hands.
struct DampedPluck {
    std::vector<double> displacement;  ///< of the first modes, frame by frame
    std::uint64_t impulses = 0;
    std::size_t clear_frames = 0;
};

DampedPluck damped_pluck(const StringModel& model, const Skipping& skipping, double height_m) {
    StringState state = make_string_state(model, Metering::Off, skipping);
    TouchState touches = make_touch_state(model.shape->stride);
    PlayerWork work;
    for (std::size_t k = 0; k < 40; ++k) {
        const double n = static_cast<double>(k + 1);
        state.displacement[k] = height_m * std::sin(n * 0.7) / (n * n);
    }
    notice_change(model, state);
    DampedPluck played;
    for (std::size_t n = 0; n < 1500; ++n) {
        const double slow = n < 700 ? 0.02 : 0.4;
        if (n % 700 == 100) {
            lay_touch(model, state, touches, TouchSlot::Release,
                      {.x_m = 0.5, .sweep_m = 0.04, .damping_kg_per_s = slow, .ease_frames = 100});
            lay_touch(model, state, touches, TouchSlot::ReleaseSecond,
                      {.x_m = 0.35, .sweep_m = 0.04, .damping_kg_per_s = slow, .ease_frames = 100});
        }
        if (n == 600 || n == 1400) lift_all_touches(touches);
        if (n == 1300)
            begin_finger(model, touches.exciter, 0.5, 0.01, n == 1300 ? height_m * 500 : 0.0, 40, 10);
        play_frame(model, state, touches, work);
        played.clear_frames += state.certificate.clear.valid ? 1U : 0U;
        for (std::size_t k = 0; k < 8; ++k) played.displacement.push_back(state.displacement[k]);
    }
    played.impulses = state.counters.impulses;
    return played;
}

/// With hands on it a string needs no look at its frets once its energy is too small to reach them; before,
/// and when a finger plucks it again, it does.
TEST(Touches, SkippingChangesNothingUnderHands) {
    const StringModel model = fretted_string();
    std::size_t clear = 0, unclear = 0;
    std::uint64_t impulses = 0;
    for (const double height_m : {0.0003, 0.0006, 0.001, 0.002, 0.004}) {
        const DampedPluck skipped = damped_pluck(model, skip_all, height_m);
        const DampedPluck uniform = damped_pluck(model, skip_nothing, height_m);
        EXPECT_EQ(skipped.impulses, uniform.impulses) << height_m;
        for (std::size_t i = 0; i < uniform.displacement.size(); ++i)
            ASSERT_NEAR(skipped.displacement[i], uniform.displacement[i], 1e-10 * height_m)
                << height_m << " frame " << i / 8;
        clear += skipped.clear_frames;
        unclear += 1500 - skipped.clear_frames;
        impulses += uniform.impulses;
    }
    EXPECT_GT(clear, 1500U);
    EXPECT_GT(unclear, 1500U);
    EXPECT_GT(impulses, 50U);
}

TEST(Finger, ItsForceIsHalfACosineOnTheMean) {
    double sum = 0;
    for (std::uint64_t n = 0; n < 60; ++n) sum += finger_shape(n, 40, 20);
    EXPECT_NEAR(sum, 30, 1e-12);  // half of rise and release
    EXPECT_NEAR(finger_shape(20, 40, 20), 0.5 + 0.5 * std::sin(pi / 80), 1e-3);
    EXPECT_EQ(finger_shape(60, 40, 20), 0);
    EXPECT_NEAR(finger_shape(39, 40, 20), 1, 1e-3);
}

TEST(PointRow, IsTheMeanOfTheShapeOverTheWidth) {
    const StringModel model = lossless_string(200);
    AlignedVector<double> row(model.shape->stride, 7.0);
    for (const double width : {0.0, 0.03}) {
        write_point_row(model, model.shape->stride, 0.123, width, row.data());
        for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{60}, std::size_t{200}}) {
            double mean = 0;
            for (int i = 0; i < 2000; ++i)
                mean += mode_shape(k, 0.123 + width * ((i + 0.5) / 2000 - 0.5), model.shape->length_m) / 2000;
            EXPECT_NEAR(row[k - 1], mean, 1e-5) << k;
        }
    }
    EXPECT_EQ(row[model.shape->stride - 1],
              model.shape->mode_count == model.shape->stride ? row[model.shape->stride - 1] : 0);
}

}  // namespace
}  // namespace jawari
