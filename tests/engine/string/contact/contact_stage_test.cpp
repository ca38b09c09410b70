// The contact stage: resting forces, gaps, moving obstacles and the work they do.
#include "string/contact/contact_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/scenes.h"

namespace jawari {
namespace {

SceneDescription damped_bass(ImpactLaw law, double rate_hz, std::size_t modes = 80) {
    SceneDescription scene;
    scene.output_rate_hz = scene.contact_rate_hz = rate_hz;
    scene.law = law;
    StringDescription string = test::bass_string(modes);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{50, 0.05}, {5000, 0.05}}}};
    string.contacts.clear();
    string.initial.shape = AtRest{};
    scene.strings.push_back(string);
    return scene;
}

/// How far 1 N at x moves the string at x, by its modes' stiffness mu omega^2.
double static_compliance(const StringModel& model, double x) {
    long double sum = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const long double shape =
            std::sqrt(2.0L / model.shape->length_m) *
            std::sin(static_cast<long double>(k + 1) * 3.14159265358979323846L * x / model.shape->length_m);
        sum += shape * shape /
               (model.shape->linear_density_kg_per_m * static_cast<long double>(model.tuning.omega[k]) *
                model.tuning.omega[k]);
    }
    return static_cast<double>(sum);
}

double gap_of(const StringModel& model, const StringState& state, std::size_t c) {
    long double gap = -static_cast<long double>(state.contact.height[c]);
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        gap += static_cast<long double>(model.shape->contact_rows[c * model.shape->stride + k]) *
               state.displacement[k];
    }
    return static_cast<double>(gap);
}

TEST(Contact, RestingForceIsTheStaticOneAtAnyRate) {
    for (const double rate : {8000.0, 48000.0, 500000.0}) {
        SceneDescription scene = damped_bass(ImpactLaw::Signorini, rate);
        scene.strings[0].contacts.push_back({0.31, 1.5e-3, 0, Side::Below});
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const double expected = 1.5e-3 / static_compliance(model, 0.31);
        for (int n = 0; n < 500; ++n) {
            step(model, state);
            ASSERT_NEAR(state.contact.impulse[0] * rate, expected, 1e-6 * expected)
                << rate << " Hz, step " << n;
        }
    }
}

TEST(Contact, AStringThatRestsDoesNotSink) {
    // Each frame sums the gaps afresh, and each sum is unlucky by turns: that must not gather.
    const double height = 0.01;
    for (const ImpactLaw law : {ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        for (const double rate : {96000.0, 768000.0}) {
            SceneDescription scene = damped_bass(law, rate, 5);
            scene.output_rate_hz = 96000;
            std::get<PhysicalModes>(scene.strings[0].modes).damping = NoLoss{};
            scene.strings[0].contacts.push_back({0.7, height, 0.7, Side::Below});
            const SceneModel model = compile(scene).value();
            SceneState state = make_state(model);
            std::vector<double> unheard(50000);
            const std::vector<double*> outputs(model.probe_count, unheard.data());
            render(model, state, outputs, unheard.size());
            EXPECT_GT(state.strings[0].counters.impulses, 1000U);
            EXPECT_LE(state.strings[0].counters.worst_penetration_m, 64 * 2.2e-16 * height)
                << static_cast<int>(law) << " at " << rate << " Hz";
        }
    }
}

TEST(Contact, GapsFollowTheStringOverThousandsOfSteps) {
    // The gaps that steps carry along against S q - b summed afresh.
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Signorini}) {
        test::RandomScene random(21);
        const StringModel model = test::compiled_string(random.scene(law, 96000, 97000));
        StringState state = make_string_state(model);
        double largest = 0;
        for (int n = 0; n < 5000; ++n) step(model, state);
        for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
            largest = std::max(largest, std::abs(gap_of(model, state, c)));
            EXPECT_NEAR(state.contact.gap[c], gap_of(model, state, c), 1e-13);
        }
        EXPECT_GT(largest, 1e-5);
        place_gaps(model, state);
        for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
            EXPECT_NEAR(state.contact.gap[c], gap_of(model, state, c), 1e-17);
        }
    }
}

TEST(Contact, CountsWhatHappened) {
    test::RandomScene random(22);
    const StringModel model = test::compiled_string(random.scene(ImpactLaw::Newton, 48000, 48001));
    StringState state = make_string_state(model);
    std::uint64_t impulses = 0;
    double total = 0;
    for (int n = 0; n < 1000; ++n) {
        step(model, state);
        for (const double impulse : state.contact.impulse) {
            impulses += impulse > 0 ? 1 : 0;
            total += impulse;
        }
    }
    EXPECT_EQ(state.counters.steps, 1000U);
    EXPECT_EQ(state.counters.impulses, impulses);
    EXPECT_GE(state.counters.candidates, impulses);
    EXPECT_GT(state.counters.solves, 0U);
    EXPECT_EQ(state.counters.truncated_solves, 0U);
    double summed = 0;
    for (const double impulse : state.contact.frame_impulse) summed += impulse;
    EXPECT_NEAR(summed, total, 1e-12 * total);
}

struct Lift {
    StringModel model;
    StringState state;
    double worst_jump = 0;  ///< of the gap from step to step
};

/// Raises an obstacle from 1 mm below the rest line to 2 mm above it, then waits.
Lift lift(Scheme scheme, ImpactLaw law, double seconds, Side side = Side::Below) {
    SceneDescription scene = damped_bass(law, 96000);
    scene.scheme = scheme;
    scene.theta = 0.75;
    const double sign = side == Side::Below ? 1 : -1;
    scene.strings[0].contacts.push_back({0.31, -1e-3 * sign, 0, side});
    Lift result{test::compiled_string(scene), {}, 0};
    result.state = make_string_state(result.model, Metering::Step);
    const auto steps = static_cast<std::size_t>(seconds * 96000);
    const double gap = result.state.contact.gap[0];
    move_contact(result.model, result.state, 0, 2e-3 * sign, steps);
    EXPECT_EQ(result.state.contact.gap[0], gap);
    for (std::size_t n = 0; n < steps + 48000; ++n) {
        const double before = result.state.contact.gap[0];
        step(result.model, result.state);
        result.worst_jump = std::max(result.worst_jump, std::abs(result.state.contact.gap[0] - before));
        // After a sixth of the way it is still 0.5 mm below the string.
        EXPECT_EQ(n < steps / 6 ? result.state.counters.impulses : 0, 0U);
    }
    return result;
}

class MovingObstacle : public testing::TestWithParam<Side> {};

TEST_P(MovingObstacle, LiftsTheStringWithTheWorkOfStatics) {
    const Lift lifted = lift(Scheme::Exact, ImpactLaw::Signorini, 0.6, GetParam());
    const double sign = GetParam() == Side::Below ? 1 : -1;
    EXPECT_EQ(lifted.state.contact.height[0], 2e-3);
    EXPECT_NEAR(sign * lifted.model.shape->contact_height[0], -1e-3 * sign, 1e-18);
    const double work = 2e-3 * 2e-3 / (2 * static_compliance(lifted.model, 0.31));
    EXPECT_NEAR(energy(lifted.model, lifted.state), work, 1e-9 * work);
    EXPECT_NEAR(lifted.state.energy.player_work, work, 0.1 * work);
    EXPECT_GT(lifted.state.energy.player_work, work);  // the rest became heat
    const EnergyMeter& meter = lifted.state.energy;
    EXPECT_NEAR(energy(lifted.model, lifted.state),
                meter.initial + meter.player_work + meter.contact_work - meter.dissipated, 1e-11 * work);
    EXPECT_LE(meter.worst_imbalance, 1e-13 * work);
    EXPECT_LE(meter.worst_rise, 1e-13 * work);
    EXPECT_LE(meter.contact_work, 1e-15);
    EXPECT_LE(lifted.state.counters.worst_penetration_m, 1e-15);
    // 3 mm in 57600 steps, and the string's answer: the gap never leaps.
    EXPECT_LE(lifted.worst_jump, 2e-7);
}

INSTANTIATE_TEST_SUITE_P(Sides, MovingObstacle, testing::Values(Side::Below, Side::Above),
                         [](const auto& side) { return side.param == Side::Below ? "Below" : "Above"; });

TEST(Contact, WorkOfAFastObstacleIsMetered) {
    for (const double seconds : {1e-5, 1e-3, 0.02}) {
        for (const ImpactLaw law : {ImpactLaw::Passive, ImpactLaw::Signorini}) {
            const Lift lifted = lift(Scheme::Exact, law, seconds);
            const double scale = lifted.state.energy.highest;
            // An obstacle that leaps past the string within a step does nothing to it under laws that forbid
            // more.
            EXPECT_GE(scale, law == ImpactLaw::Signorini ? 1e-6 : 0);
            EXPECT_LE(lifted.state.energy.worst_imbalance, 1e-13 * scale) << seconds;
            EXPECT_LE(lifted.state.energy.worst_rise, 1e-13 * scale) << seconds;
        }
        const Lift lifted = lift(Scheme::Theta, ImpactLaw::Newton, seconds);
        EXPECT_LE(lifted.state.energy.worst_imbalance, 1e-13 * lifted.state.energy.highest) << seconds;
    }
}

TEST(Contact, ANewMovementReplacesTheOldOneWhereItIs) {
    SceneDescription scene = damped_bass(ImpactLaw::Signorini, 48000);
    scene.strings[0].contacts.push_back({0.31, -3e-3, 0, Side::Below});
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    move_contact(model, state, 0, -1e-3, 100);
    for (int n = 0; n < 50; ++n) step(model, state);
    EXPECT_NEAR(state.contact.height[0], -2e-3, 1e-15);
    move_contact(model, state, 0, -2.5e-3, 10);
    for (int n = 0; n < 5; ++n) step(model, state);
    EXPECT_NEAR(state.contact.height[0], -2.25e-3, 1e-15);
    for (int n = 0; n < 20; ++n) step(model, state);
    EXPECT_EQ(state.contact.height[0], -2.5e-3);
    EXPECT_EQ(state.contact.moving_count, 0U);
    move_contact(model, state, 0, -1e-3, 0);  // at least one step
    step(model, state);
    EXPECT_EQ(state.contact.height[0], -1e-3);
}

}  // namespace
}  // namespace jawari
