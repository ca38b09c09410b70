// Retuning: coefficients against the compiler's own formulas in extended precision, and energy against the
// parametric work computed from true velocities.
#include "instrument/voice/bend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "instrument/voice/voice.h"
#include "jawari/detail/step_coefficients.h"
#include "jawari/instrument/compile.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "string/frame/short_frame.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

InstrumentModel one_string(bool lossless) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    bass.frets.count = 1;
    bass.frets.height_m = {-0.01};
    if (lossless) bass.strings[0].damping = NoLoss{};
    return compile_instrument(bass, 48000).value();
}

Voice ringing_voice(const InstrumentModel& model) {
    Voice voice = make_voice(model.strings[0].sizes);
    start_voice(model, model.strings[0], voice, 0, 0, 0);
    for (std::size_t k = 0; k < 40; ++k) {
        voice.string.displacement[k] = 1e-6 / static_cast<double>(k + 1);
        voice.string.velocity[k] = 2e-4 * std::cos(static_cast<double>(3 * k));
    }
    notice_change(model.strings[0].stopped[0].string, voice.string);
    return voice;
}

/// f_k^2 at tension tau T is that of the pinned stiff string: a k^2 tau + b k^4.
double bent_omega(const StoppedStringModel& stopped, std::size_t k, double semitones) {
    const double B = stopped.inharmonicity;
    const double n = static_cast<double>(k + 1);
    const double f0 = stopped.string.tuning.omega[0] / std::sqrt(1 + B);  // without stiffness
    const double first = std::exp2(semitones / 12) * stopped.string.tuning.omega[0];
    const double tension = (first * first / (f0 * f0)) - B;
    return f0 * n * std::sqrt(tension + B * n * n);
}

/// The reach of a contact at the bent tension, from its definition, against the factor that retuning gives.
TEST(Bend, TheReachOfEnergyGrowsByNoMoreThanItsFactor) {
    const InstrumentModel model = one_string(false);
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    const auto reach_of = [](const StringModel& string, std::size_t c) {
        double ends = 0, detours = 0;
        for (std::size_t k = 0; k < string.shape->mode_count; ++k) {
            const double share = string.shape->contact_rows[c * string.shape->stride + k];
            const double per_energy =
                string.tuning.certificate.stiffness[k] / string.tuning.potential[k] * share * share;
            ends += per_energy * string.tuning.certificate.extent[k] * string.tuning.certificate.extent[k];
            detours += per_energy * string.tuning.certificate.detour[k] * string.tuning.certificate.detour[k];
        }
        return std::sqrt(ends) + std::sqrt(detours);
    };
    for (const double semitones : {-24.0, -3.0, -0.1, 0.5, 7.0, 24.0}) {
        Voice voice = ringing_voice(model);
        PlayerWork work;
        set_bend(stopped, voice, semitones, work);
        const StringModel& bent = voice.bend.model;
        ASSERT_EQ(bent.shape->certificate.reach.size(), bent.shape->contact_count);
        const double now = reach_of(bent, 0);
        const double claimed = bent.shape->certificate.reach[0] * bent.tuning.certificate.reach_growth;
        EXPECT_LE(now, claimed * (1 + 1e-9)) << semitones;
        if (semitones < 0) {
            EXPECT_GE(now, 0.9 * claimed) << semitones;
        }
    }
}

TEST(Bend, EveryCoefficientIsThatOfTheStringAtItsTension) {
    const InstrumentModel model = one_string(false);
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    for (const double semitones : {0.01, 2.0, -3.0, 12.0}) {
        Voice voice = ringing_voice(model);
        PlayerWork work;
        set_bend(stopped, voice, semitones, work);
        const StringModel& bent = voice.bend.model;
        const double h = bent.shape->step_s;
        for (std::size_t k = 0; k < bent.shape->mode_count; ++k) {
            const double omega = bent_omega(stopped, k, semitones);
            const double sigma = bent.shape->sigma[k];
            ASSERT_NEAR(bent.tuning.omega[k] / omega, 1, 1e-12);
            const FlightFactors f = flight_factors(omega, sigma, h, bent.shape->steps_per_frame);
            const ExactFactors e = exact_factors(omega, sigma, h);
            // The mobility stays that of the compiled tension: forces answer as with another modal mass.
            const double mass =
                exact_step(omega, sigma, h).mobility / model.strings[0].stopped[0].string.shape->mobility[k];
            ASSERT_NEAR(bent.tuning.flight.qq[k], f.qq, 1e-12);
            ASSERT_NEAR(bent.tuning.flight.vv[k], f.vv, 1e-12);
            ASSERT_NEAR(bent.tuning.flight.qv[k] / h, f.qv / h, 1e-10);
            ASSERT_NEAR(bent.tuning.flight.vq[k] * h, f.vq * h, 1e-12);
            ASSERT_NEAR(bent.tuning.restoring[k] * h, -e.d, 1e-13);
            ASSERT_NEAR(bent.tuning.flight.q_held[k] / (f.q_held / mass), 1, 1e-8) << k;
            ASSERT_NEAR(bent.tuning.flight.v_held[k] - f.v_held / mass, 0,
                        1e-8 * std::abs(f.q_held / mass) / h)
                << k;
            ASSERT_NEAR(bent.tuning.flight.q_ramp[k] / (f.q_ramp / mass), 1, 1e-6) << k;
            ASSERT_NEAR(voice.bend.backward_u[k], exact_backward_velocity(omega, sigma, h, 0, 1), 1e-12);
            ASSERT_NEAR(voice.bend.backward_q[k], exact_backward_velocity(omega, sigma, h, 1, 0),
                        1e-10 * omega);
        }
    }
}

double true_velocity(const StoppedStringModel& stopped, const Voice& voice, std::size_t k) {
    const bool bent = voice.bend.active;
    const double a = bent ? voice.bend.backward_q[k] : stopped.backward_q[k];
    const double c = bent ? voice.bend.backward_u[k] : stopped.backward_u[k];
    return (voice.string.velocity[k] - a * voice.string.displacement[k]) / c;
}

/// 1/2 mu sum (u^2 + omega^2 q^2) of the continuous motion.
double true_energy(const StoppedStringModel& stopped, const Voice& voice, double semitones) {
    double sum = 0;
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k) {
        const double u = true_velocity(stopped, voice, k);
        const double omega = bent_omega(stopped, k, semitones);
        const double q = voice.string.displacement[k];
        sum += stopped.string.shape->linear_density_kg_per_m / 2 * (u * u + omega * omega * q * q);
    }
    return sum;
}

double parametric_work(const StoppedStringModel& stopped, const Voice& voice, double from, double to) {
    double sum = 0;
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k) {
        const double q = voice.string.displacement[k];
        const double a = bent_omega(stopped, k, from);
        const double b = bent_omega(stopped, k, to);
        sum += stopped.string.shape->linear_density_kg_per_m / 2 * (b * b - a * a) * q * q;
    }
    return sum;
}

/// A slow bend up and down of a string without losses: between retunings the true energy stays, at each it
/// changes by the parametric work, and the meter agrees.
TEST(Bend, EnergyChangesByTheParametricWorkAlone) {
    const InstrumentModel model = one_string(true);
    const InstrumentStringModel& string = model.strings[0];
    const StoppedStringModel& stopped = string.stopped[0];
    Voice voice = ringing_voice(model);
    PlayerWork work;
    const double start = true_energy(stopped, voice, 0);
    double expected = start;
    double semitones = 0;
    double highest = 0;
    for (int tick = 1; tick <= 200; ++tick) {
        const double next = 2 * std::sin(pi * tick / 200);
        expected += parametric_work(stopped, voice, semitones, tick == 200 ? 0 : next);
        semitones = tick == 200 ? 0 : next;
        set_bend(stopped, voice, semitones, work);
        for (int frame = 0; frame < 32; ++frame) advance_frame(voice_model(string, voice), voice.string);
        ASSERT_NEAR(true_energy(stopped, voice, semitones), expected, 1e-9 * start) << "tick " << tick;
        highest = std::max(highest, expected);
    }
    EXPECT_FALSE(voice.bend.active);
    EXPECT_GT(highest, 1.1 * start);  // a bend up adds energy: 2 semitones are 12 % in omega
    EXPECT_NEAR(work.bends_J, expected - start, 0.02 * (highest - start));
}

TEST(Bend, ShapeAndTrueVelocityStayWhatTheyAre) {
    const InstrumentModel model = one_string(false);
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    Voice voice = ringing_voice(model);
    const AlignedVector<double> q = voice.string.displacement;
    const AlignedVector<double> v = voice.string.velocity;
    std::vector<double> u;
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k)
        u.push_back(true_velocity(stopped, voice, k));
    PlayerWork work;
    for (const double semitones : {1.0, -2.0, 0.5}) {
        set_bend(stopped, voice, semitones, work);
        EXPECT_EQ(voice.string.displacement, q);
        for (std::size_t k = 0; k < u.size(); ++k)
            ASSERT_NEAR(true_velocity(stopped, voice, k), u[k], 1e-14) << k;
    }
    set_bend(stopped, voice, 0, work);
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k)
        ASSERT_NEAR(voice.string.velocity[k], v[k], 1e-14);
    EXPECT_NEAR(work.bends_J, 0, 1e-12 * energy(stopped.string, voice.string));
}

/// A string over frets that is plucked hard while it is bent to and fro.
struct BentPluck {
    std::vector<double> displacement;  ///< of the first modes, frame by frame
    Counters counters;
};

BentPluck bent_pluck(const InstrumentModel& model, const Skipping& skipping, double speed) {
    const InstrumentStringModel& string = model.strings[0];
    const StoppedStringModel& stopped = string.stopped[0];
    Voice voice = make_voice(string.sizes);
    start_voice(model, string, voice, 0, 0, 0);
    voice.string.skipping = skipping;
    for (std::size_t k = 0; k < 30; ++k)
        voice.string.velocity[k] =
            speed * std::sin(0.6 * static_cast<double>(k + 1)) / static_cast<double>(k + 1);
    notice_change(stopped.string, voice.string);
    BentPluck played;
    PlayerWork work;
    for (int frame = 0; frame < 3000; ++frame) {
        if (frame % 16 == 0) set_bend(stopped, voice, 1.5 + std::sin(frame / 300.0), work);
        advance_frame(voice_model(string, voice), voice.string);
        for (std::size_t k = 0; k < 8; ++k) played.displacement.push_back(voice.string.displacement[k]);
    }
    played.counters = voice.string.counters;
    return played;
}

/// Bent plucks at several speeds agree with uniform stepping, and both strike and fly.
void expect_skipping_changes_nothing(const InstrumentModel& model, std::initializer_list<double> speeds) {
    const double omega = model.strings[0].stopped[0].string.tuning.omega[0];
    std::uint64_t impulses = 0, flown = 0;
    for (const double speed : speeds) {
        const BentPluck skipped = bent_pluck(model, skip_all, speed);
        const BentPluck uniform = bent_pluck(model, skip_nothing, speed);
        EXPECT_EQ(skipped.counters.impulses, uniform.counters.impulses) << speed;
        for (std::size_t i = 0; i < uniform.displacement.size(); ++i)
            ASSERT_NEAR(skipped.displacement[i], uniform.displacement[i], 1e-10 * speed / omega)
                << speed << " frame " << i / 8;
        impulses += uniform.counters.impulses;
        flown += skipped.counters.flown_frames;
    }
    EXPECT_GT(impulses, 1000U);
    EXPECT_GT(flown, 1000U);
}

/// Frets below and a board of points close above: what strikes one side is pushed to the other within a
/// frame.
InstrumentModel string_between_obstacles() {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    for (double& height_m : bass.frets.height_m) height_m = -0.0002;
    ObstacleDescription above;
    above.name = "board";
    above.origin = Origin::Nut;
    above.side = Side::Above;
    above.profile = CornerProfile{{{0.02, 0.0002}, {0.5, 0.0002}}};
    above.points = 24;
    bass.obstacles = {above};
    bass.quality.contact_rate_min_hz = 480000;  // frames are not short
    return compile_instrument(bass, 48000).value();
}

TEST(Bend, NearContactsAloneAreStruckAsAmongAll) {
    const InstrumentModel model = string_between_obstacles();
    const StringModel& open = model.strings[0].stopped[0].string;
    ASSERT_GT(open.shape->contact_count, 10U);
    ASSERT_FALSE(has_short_frames(open));
    ASSERT_EQ(open.shape->certificate.push_speed.size(),
              open.shape->contact_count * open.shape->contact_count);
    expect_skipping_changes_nothing(model, {0.2, 0.5, 1.0, 2.0});
}

/// Frames of four steps over a few frets, whose responses are found anew at each tension.
TEST(Bend, ShortFramesAgreeWithUniformStepping) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    bass.quality.contact_rate_min_hz = 192000;
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    const StringModel& open = model.strings[0].stopped[0].string;
    ASSERT_TRUE(has_short_frames(open));
    ASSERT_GT(open.shape->steps_per_frame, 2U);
    expect_skipping_changes_nothing(model, {1.0, 2.0, 4.0, 8.0});
}

TEST(Bend, LeavesTheUsersChoiceOfSkippingAlone) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    for (const bool near : {false, true}) {
        Voice voice = make_voice(model.strings[0].sizes);
        voice.string.skipping.near = near;
        start_voice(model, model.strings[0], voice, 0, 0, 0);
        PlayerWork work;
        for (const double semitones : {2.0, -1.0, 0.0}) {
            set_bend(model.strings[0].stopped[0], voice, semitones, work);
            EXPECT_EQ(voice.string.skipping.near, near) << semitones;
        }
    }
}

/// A bent string is the compiled one but for its tension, and has no table that holds at another.
TEST(Bend, SharesTheShapeAndOwnsTheTuning) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    Voice voice = make_voice(model.strings[0].sizes);
    start_voice(model, model.strings[0], voice, 0, 0, 0);
    PlayerWork work;
    set_bend(stopped, voice, 1e-9, work);
    StringModel& bent = voice.bend.model;
    EXPECT_EQ(bent.shape, stopped.string.shape);
    EXPECT_TRUE(bent.tuning.response.empty());
    EXPECT_TRUE(bent.tuning.step_response.empty());
    EXPECT_TRUE(bent.tuning.certificate.push_path.empty());
    StringTuning compiled = stopped.string.tuning;
    const auto expected = mode_arrays(compiled);
    const auto retuned = mode_arrays(bent.tuning);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const AlignedVector<double>& values = *expected[i];
        const double largest = *std::max_element(
            values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
        for (std::size_t k = 0; k < bent.shape->mode_count; ++k)
            ASSERT_NEAR((*retuned[i])[k], values[k], 1e-6 * std::abs(largest))
                << "array " << i << ", mode " << k;
    }
}

/// What impulses do to the bounds of other contacts at the bent tension, from its definition.
TEST(Bend, PushesGrowByNoMoreThanTheirFactor) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    for (const double semitones : {-12.0, -0.5, 1.0, 12.0}) {
        Voice voice = make_voice(model.strings[0].sizes);
        start_voice(model, model.strings[0], voice, 0, 0, 0);
        PlayerWork work;
        set_bend(stopped, voice, semitones, work);
        const StringModel& bent = voice.bend.model;
        const std::size_t groups = bent.shape->certificate.group_begin.size() - 1;
        ASSERT_EQ(groups, bent.shape->contact_count);  // frets: a group each
        for (std::size_t g = 0; g < groups; ++g) {
            for (std::size_t c = 0; c < bent.shape->contact_count; ++c) {
                double push = 0;
                for (std::size_t k = 0; k < bent.shape->mode_count; ++k)
                    push += std::abs(bent.shape->contact_rows[g * bent.shape->stride + k] *
                                     bent.tuning.certificate.kick[k] *
                                     bent.shape->contact_rows[c * bent.shape->stride + k]);
                EXPECT_LE(push, bent.shape->certificate.push_speed[c * groups + g] *
                                    bent.tuning.certificate.push_growth * (1 + 1e-12));
            }
        }
    }
}

}  // namespace
}  // namespace jawari
