// Touches: energy balances, closed forms, and what hands leave of a sound.
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
#include "support/touched_string.h"

namespace jawari {
namespace {

using std::numbers::pi, test::lossless_string, test::play_frame, test::stir;

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
