// Time steps with contact and excitation, against closed forms of a one-mode string, statics, and a plain
// reference that solves each scheme's defining equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "jawari/jawari.h"
#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

/// Length 2, so that phi = sin: the displacement at the middle is the first mode's coordinate. Mass mu = 1.
SceneDescription one_mode(double frequency_hz, double decay_per_s, double rate_hz, double displacement) {
    StringDescription string;
    string.length_m = 2;
    string.linear_density_kg_per_m = 1;
    string.modes = ModeTable{{frequency_hz}, {decay_per_s}};
    string.initial.shape = ModalState{{displacement}, {}};
    SceneDescription scene;
    scene.output_rate_hz = scene.contact_rate_hz = rate_hz;
    scene.strings.push_back(string);
    return scene;
}

struct LawAndRestitution {
    ImpactLaw law;
    double restitution;
    double effective;  ///< what the law converges to
};

std::string name_of(const LawAndRestitution& parameter) {
    return std::string(name_of(parameter.law)) + "_e_" + test::name_of_number(parameter.restitution);
}

class OneImpact : public testing::TestWithParam<LawAndRestitution> {};

TEST_P(OneImpact, ReboundsAsTheOscillatorThatLosesAllButItsRestitution) {
    // q = cos(omega t) meets the obstacle at -1/2 when omega t = 2 pi/3, with velocity -omega sqrt(3)/2, and
    // leaves with e times that. It rises from there as  -cos(omega s)/2 + e sqrt(3)/2 sin(omega s).
    const double frequency = 100;
    const double omega = 2 * pi * frequency;
    double previous = 0;
    for (const double rate : {1e6, 4e6}) {
        SceneDescription scene = one_mode(frequency, 0, rate, 1.0);
        scene.law = GetParam().law;
        scene.strings[0].contacts.push_back({1.0, -0.5, GetParam().restitution, Side::Below});
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const auto steps = static_cast<std::size_t>(std::llround(0.55 / frequency * rate));
        for (std::size_t n = 0; n < steps; ++n) step(model, state);
        const double s = static_cast<double>(steps) / rate - 2 * pi / 3 / omega;
        const double e = GetParam().effective;
        const double rebound = -0.5 * std::cos(omega * s) + e * std::sqrt(3.0) / 2 * std::sin(omega * s);
        const double expected =
            std::max(-0.5, rebound);  // without restitution it rests until the spring lifts it
        const double error = std::abs(state.displacement[0] - expected);
        EXPECT_LE(error, 4 * omega / rate);  // first order: within four steps' worth of motion
        EXPECT_GT(state.counters.impulses, 0U);
        previous = error;
    }
    EXPECT_LE(previous, 4 * omega / 4e6);
}

INSTANTIATE_TEST_SUITE_P(Laws, OneImpact,
                         testing::Values(LawAndRestitution{ImpactLaw::Newton, 0, 0},
                                         LawAndRestitution{ImpactLaw::Newton, 0.5, 0.5},
                                         LawAndRestitution{ImpactLaw::Newton, 1, 1},
                                         LawAndRestitution{ImpactLaw::Passive, 0, 0},
                                         LawAndRestitution{ImpactLaw::Passive, 0.5, 0.5},
                                         LawAndRestitution{ImpactLaw::Passive, 1, 1},
                                         LawAndRestitution{ImpactLaw::Signorini, 0, 0},
                                         LawAndRestitution{ImpactLaw::Signorini, 0.9, 0},
                                         LawAndRestitution{ImpactLaw::PaoliSchatzman, 0, 0},
                                         LawAndRestitution{ImpactLaw::PaoliSchatzman, 0.5, 0.5}),
                         test::named);

TEST(Step, NewtonReturnsTheShareOfTheApproachThatItPromises) {
    for (const double e : {0.0, 0.25, 0.9, 1.0}) {
        SceneDescription scene = one_mode(110, 0, 48000, 1e-3);
        scene.law = ImpactLaw::Newton;
        scene.strings[0].contacts.push_back({1.0, -0.4e-3, e, Side::Below});
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        double before = 0;
        while (state.counters.impulses == 0 && state.counters.steps < 1000) {
            before = state.velocity[0];
            step(model, state);
        }
        ASSERT_EQ(state.counters.impulses, 1U);
        EXPECT_LT(before, 0);
        EXPECT_NEAR(state.velocity[0], -e * before, 1e-12 * std::abs(before));
    }
}

/// One mode and one obstacle, straight from the schemes' equations:
///   exact: q+ = A q - e q_before + h^2 w lambda/h;   theta: v+ - v + h (2 sigma v_t + omega^2 q_t) = lambda,
///   q+ = q + h v_t.
struct Reference {
    double omega, sigma, h, theta, restitution, height;
    double q, v;

    void theta_step() {
        const double gap = q - height;
        const double divisor = 1 + 2 * theta * sigma * h + theta * theta * omega * omega * h * h;
        const double right =
            v - h * (1 - theta) * (2 * sigma + omega * omega * theta * h) * v - h * omega * omega * q;
        double next = right / divisor;
        if (gap + h * v / 2 <= 0) next = std::max(next, -restitution * v);
        q += h * (theta * next + (1 - theta) * v);
        v = next;
    }
};

class ThetaScheme : public testing::TestWithParam<double> {};

TEST_P(ThetaScheme, BouncesAsItsEquationsSay) {
    std::uint64_t impulses = 0;
    for (const double e : {0.0, 0.5, 1.0}) {
        SceneDescription scene = one_mode(123, 3, 24000, 1e-3);
        scene.scheme = Scheme::Theta;
        scene.theta = GetParam();
        scene.law = ImpactLaw::Newton;
        scene.strings[0].contacts.push_back({1.0, -0.3e-3, e, Side::Below});
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        Reference reference{2 * pi * 123, 3, 1 / 24000.0, GetParam(), e, -0.3e-3, 1e-3, 0};
        for (int n = 0; n < 4000; ++n) {
            step(model, state);
            reference.theta_step();
            ASSERT_NEAR(state.displacement[0], reference.q, 1e-12) << "step " << n << ", e = " << e;
        }
        impulses += state.counters.impulses;
    }
    EXPECT_GT(impulses, 10U);
}

TEST_P(ThetaScheme, EnergyBalanceCloses) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::Newton, 8000, 4e6);
        scene.scheme = Scheme::Theta;
        scene.theta = GetParam();
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model, Metering::Step);
        for (int n = 0; n < 1500; ++n) step(model, state);
        EXPECT_LE(state.energy.worst_imbalance, 1e-13 * state.energy.initial) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Thetas, ThetaScheme, testing::Values(0.5, 0.75, 1.0), test::named);

TEST(Step, ThetaOneHalfWithoutLossesKeepsEnergy) {
    // Free, and against frets with e = 1: v+ = -v at the contacts' midpoint velocity zero does no work.
    for (const bool frets : {false, true}) {
        test::RandomScene random(3);
        SceneDescription scene = random.scene(ImpactLaw::Newton, 48000, 192000);
        scene.scheme = Scheme::Theta;
        scene.theta = 0.5;
        std::get<PhysicalModes>(scene.strings[0].modes).damping = NoLoss{};
        for (auto& contact : scene.strings[0].contacts) contact.restitution = 1;
        if (!frets) scene.strings[0].contacts.clear();
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const double initial = energy(model, state);
        for (int n = 0; n < 5000; ++n) {
            step(model, state);
            ASSERT_NEAR(energy(model, state), initial, 1e-11 * initial) << n;
        }
        EXPECT_EQ(state.counters.impulses > 0, frets);
    }
}

/// A flexible string (B = 0), tension 100 N, length 0.8 m, strongly and equally damped.
SceneDescription flexible_string(std::size_t modes, double rate_hz) {
    StringDescription string;
    string.length_m = 0.8;
    string.linear_density_kg_per_m = 0.005;
    ModeTable table;
    const double f0 = std::sqrt(100 / 0.005) / 1.6;
    for (std::size_t k = 1; k <= modes; ++k) {
        table.frequency_hz.push_back(f0 * static_cast<double>(k));
        table.decay_per_s.push_back(200);
    }
    string.modes = table;
    SceneDescription scene;
    scene.output_rate_hz = scene.contact_rate_hz = rate_hz;
    scene.strings.push_back(string);
    return scene;
}

double displacement_at(const StringModel& model, const StringState& state, double x) {
    double u = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        u += std::sqrt(2 / model.shape->length_m) *
             std::sin(static_cast<double>(k + 1) * pi * x / model.shape->length_m) * state.displacement[k];
    }
    return u;
}

TEST(Step, ConstantForceEndsInTheTriangleOfStatics) {
    // u(x) = F x (L - x_F)/(T L) left of the force, and the modes left out are worth at most 2 F L/(pi^2 T
    // N).
    const std::size_t modes = 400;
    const double L = 0.8, T = 100, F = 0.5, at = 0.3;
    for (const Scheme scheme : {Scheme::Exact, Scheme::Theta}) {
        SceneDescription scene = flexible_string(modes, 48000);
        scene.scheme = scheme;
        scene.law = ImpactLaw::Newton;
        scene.theta = 0.75;
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        test::press(model, state, at, F);
        for (int n = 0; n < 12000; ++n) step(model, state);  // 50 time constants
        const double left_out = 2 * F * L / (pi * pi * T * static_cast<double>(modes));
        for (const double x : {0.1, 0.2, 0.3, 0.5, 0.7}) {
            const double expected = x < at ? F * x * (L - at) / (T * L) : F * at * (L - x) / (T * L);
            EXPECT_NEAR(displacement_at(model, state, x), expected, left_out) << x;
        }
        EXPECT_LE(std::abs(state.velocity[0]), 1e-12);
    }
}

TEST(Step, ExcitationWorkIsMetered) {
    // A force that grows and falls: H at the end is its work less the losses.
    for (const Scheme scheme : {Scheme::Exact, Scheme::Theta}) {
        SceneDescription scene = flexible_string(60, 96000);
        scene.scheme = scheme;
        scene.law = ImpactLaw::Newton;
        scene.theta = 0.6;
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model, Metering::Step);
        test::press(model, state, 0.2, 0, 1e-3);
        for (int n = 0; n < 500; ++n) step(model, state);
        EXPECT_EQ(state.excitation.elapsed, 500U);
        test::press(model, state, 0.2, 0.5, -1e-3);
        for (int n = 0; n < 400; ++n) step(model, state);
        const double now = energy(model, state);
        EXPECT_GT(now, 1e-7);
        EXPECT_GT(state.energy.dissipated, 0);
        EXPECT_EQ(state.energy.contact_work, 0);
        EXPECT_NEAR(now, state.energy.player_work - state.energy.dissipated, 1e-12 * now);
        EXPECT_LE(state.energy.worst_imbalance, 1e-13 * now);
    }
}

TEST(Step, SlowForceDoesTheWorkOfStatics) {
    // Raised over 0.5 s: W = F^2 x (L - x)/(2 T L), of the modes kept.
    SceneDescription scene = flexible_string(50, 48000);
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model, Metering::Step);
    const int steps = 24000;
    test::press(model, state, 0.3, 0, 0.5 / steps);
    for (int n = 0; n < steps; ++n) step(model, state);
    double compliance = 0;
    for (std::size_t k = 1; k <= 50; ++k) {
        const double shape = std::sin(static_cast<double>(k) * pi * 0.3 / 0.8);
        compliance += 2 / 0.8 * shape * shape / (100 * std::pow(static_cast<double>(k) * pi / 0.8, 2));
    }
    EXPECT_NEAR(energy(model, state), 0.5 * 0.5 * compliance / 2, 1e-2 * 0.5 * 0.5 * compliance / 2);
    EXPECT_NEAR(state.energy.player_work, 0.5 * 0.5 * compliance / 2, 2e-2 * 0.5 * 0.5 * compliance / 2);
}

TEST(Step, ContactsFromAboveMirrorContactsFromBelow) {
    for (const ImpactLaw law :
         {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        test::RandomScene random(11);
        SceneDescription below = random.scene(law, 48000, 48001);
        SceneDescription above = below;
        std::get<Pluck>(above.strings[0].initial.shape).height_m *= -1;
        for (auto& contact : above.strings[0].contacts) {
            contact.height_m *= -1;
            contact.side = contact.side == Side::Below ? Side::Above : Side::Below;
        }
        const StringModel model_below = test::compiled_string(below);
        const StringModel model_above = test::compiled_string(above);
        StringState state_below = make_string_state(model_below);
        StringState state_above = make_string_state(model_above);
        for (int n = 0; n < 2000; ++n) {
            step(model_below, state_below);
            step(model_above, state_above);
            for (std::size_t k = 0; k < model_below.shape->mode_count; ++k) {
                ASSERT_EQ(state_below.displacement[k], -state_above.displacement[k]) << n;
            }
            for (std::size_t c = 0; c < model_below.shape->contact_count; ++c) {
                ASSERT_EQ(state_below.contact.impulse[c], state_above.contact.impulse[c]);
            }
        }
        EXPECT_GT(state_below.counters.impulses, 10U);
    }
}

/// How far the deepest contact lies inside its obstacle [m], from the modes themselves.
double true_depth(const StringModel& model, const StringState& state) {
    long double deepest = 0;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        long double gap = -static_cast<long double>(state.contact.height[c]);
        for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
            gap += static_cast<long double>(model.shape->contact_rows[c * model.shape->stride + k]) *
                   state.displacement[k];
        }
        deepest = std::max(deepest, -gap);
    }
    return static_cast<double>(deepest);
}

/// Frames evaluate a few contacts only; steps after them must evaluate all, and frames after steps must not
/// trust bounds from before them.
TEST(Step, MixesWithFramesInAnyOrder) {
    // Newton's law lets a contact in by what it moves in half a step, Signorini's by rounding.
    for (const auto& [law, allowed_m] :
         {std::pair{ImpactLaw::Newton, 1e-6}, std::pair{ImpactLaw::Signorini, 1e-15}}) {
        SceneDescription scene;
        scene.output_rate_hz = 15680;
        scene.contact_rate_hz = 128 * 15680;
        scene.law = law;
        scene.strings.push_back(test::bass_string(300));
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        std::size_t fewest = model.shape->contact_count;
        std::uint64_t struck = 0;
        for (int turn = 0; turn < 12; ++turn) {
            for (int n = 0; n < 47; ++n) advance_frame(model, state);
            ASSERT_LE(true_depth(model, state), allowed_m) << "frames of turn " << turn;
            fewest = std::min(fewest, state.contact.near.size());
            const std::uint64_t before = state.counters.impulses;
            for (int n = 0; n < 60; ++n) {
                for (std::size_t i = 0; i < model.shape->steps_per_frame; ++i) step(model, state);
                ASSERT_LE(true_depth(model, state), allowed_m) << "steps of turn " << turn << ", frame " << n;
            }
            struck += state.counters.impulses - before;
        }
        EXPECT_LE(fewest, 1U) << "no frame has skipped contacts";
        EXPECT_GT(struck, 100U) << "no steps have struck";
    }
}

/// A motion that is being taken away meets no obstacle in steps either.
TEST(Step, LeavesTheObstaclesWithTheString) {
    SceneDescription scene;
    scene.law = ImpactLaw::Signorini;
    scene.contact_rate_hz = 48000;
    scene.strings.push_back(test::bass_string(40));
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    leave_obstacles(state);
    double deepest = 0;
    for (int n = 0; n < 4000; ++n) {
        step(model, state);
        deepest = std::max(deepest, true_depth(model, state));
    }
    EXPECT_EQ(state.counters.impulses, 0U);
    EXPECT_GT(deepest, 1e-4);
}

}  // namespace
}  // namespace jawari
