// States: complete from the start, the same again after a reset, at rest when told.
#include "jawari/detail/string_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "string/frame/frame.h"
#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

SceneModel random_model(std::uint64_t seed, ImpactLaw law) {
    test::RandomScene random(seed);
    SceneDescription scene = random.scene(law, 400000, 2e6);
    scene.strings.push_back(random.string());
    auto model = compile(scene);
    EXPECT_TRUE(model.ok());
    return model.value();
}

std::vector<double> rendered(const SceneModel& model, SceneState& state, std::size_t frames) {
    std::vector<double> samples(model.probe_count * frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * frames);
    render(model, state, outputs, frames);
    return samples;
}

class StateOfLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(StateOfLaw, ResetPlaysTheSameBitsAgain) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const SceneModel model = random_model(seed, GetParam());
        SceneState state = make_state(model);
        const auto first = rendered(model, state, 300);
        const Counters counters = state.strings[0].counters;
        // Leave nothing as it was: movement, excitation, half a frame's worth of anything.
        for (std::size_t s = 0; s < 2; ++s) {
            StringState& string = state.strings[s];
            move_contact(model.strings[s], string, 0, 1e-3, 1000);
            test::press(model.strings[s], string, 0.2, 0.3, 1e-5);
            rendered(model, state, 7);
            reset(model.strings[s], string);
            EXPECT_FALSE(string.excitation.active);
            EXPECT_EQ(string.counters.steps, 0U);
        }
        reset(model, state);
        EXPECT_EQ(state.frame, 0U);
        const auto second = rendered(model, state, 300);
        EXPECT_EQ(first, second) << "seed " << seed;
        EXPECT_EQ(state.strings[0].counters.impulses, counters.impulses);
        EXPECT_EQ(state.strings[0].counters.steps, counters.steps);
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, StateOfLaw,
                         testing::Values(ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::PaoliSchatzman),
                         test::named);

TEST(State, StartsAtTheModelsInitialStateWithNothingCounted) {
    const SceneModel model = random_model(9, ImpactLaw::Signorini);
    const SceneState state = make_state(model, Metering::Step);
    ASSERT_EQ(state.strings.size(), 2U);
    EXPECT_EQ(state.frame, 0U);
    for (std::size_t s = 0; s < 2; ++s) {
        const StringState& string = state.strings[s];
        EXPECT_EQ(string.displacement, model.strings[s].shape->initial_displacement);
        EXPECT_EQ(string.velocity, model.strings[s].shape->initial_velocity);
        EXPECT_EQ(string.energy.initial, energy(model.strings[s], string));
        EXPECT_EQ(string.energy.highest, string.energy.initial);
        EXPECT_EQ(string.energy.dissipated, 0);
        EXPECT_EQ(string.counters.steps, 0U);
        for (std::size_t c = 0; c < model.strings[s].shape->contact_count; ++c) {
            long double gap = -model.strings[s].shape->contact_height[c];
            long double before = gap;
            for (std::size_t k = 0; k < model.strings[s].shape->stride; ++k) {
                const long double phi =
                    model.strings[s].shape->contact_rows[c * model.strings[s].shape->stride + k];
                gap += phi * string.displacement[k];
                before +=
                    phi * (string.displacement[k] -
                           static_cast<long double>(model.strings[s].shape->step_s) * string.velocity[k]);
            }
            EXPECT_NEAR(string.contact.gap[c], static_cast<double>(gap), 1e-16);
            EXPECT_NEAR(string.contact.gap_before[c], static_cast<double>(before), 1e-16);
        }
    }
}

TEST(State, PutToRestRestsAgainstTheObstaclesAndStays) {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(100));
    scene.strings[0].contacts.push_back({0.25, 1e-3, 0, Side::Below});  // above the rest line
    scene.strings[0].probes = {{Quantity::Displacement, 0.25, 0}, {Quantity::Velocity, 0.5, 0}};
    const SceneModel model = compile(scene).value();
    SceneState state = make_state(model);
    StringState& string = state.strings[0];
    rendered(model, state, 200);
    const auto steps = string.counters.steps;
    test::press(model.strings[0], string, 0.2, 1);
    move_contact(model.strings[0], string, 3, 2e-3, 50);
    put_to_rest(model.strings[0], string);
    EXPECT_FALSE(string.excitation.active);
    EXPECT_EQ(string.counters.steps, steps);  // counters stay
    EXPECT_EQ(string.displacement, model.strings[0].shape->rest_displacement);
    const auto samples = rendered(model, state, 500);
    for (std::size_t n = 0; n < 500; ++n) {
        ASSERT_NEAR(samples[n], 1e-3, 1e-13) << n;
        ASSERT_NEAR(samples[500 + n], 0, 1e-8) << n;
    }
}

/// As if there had never been any: against the same string without contacts.
TEST_P(StateOfLaw, AStringThatLeavesItsObstaclesFliesFreely) {
    for (const Skipping& skipping : {skip_all, skip_nothing}) {
        test::RandomScene random(3);
        SceneDescription scene = random.scene(GetParam(), 48000, 1e6);
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model, Metering::Off, skipping);
        for (int n = 0; n < 50; ++n) advance_frame(model, state);
        leave_obstacles(state);
        const std::uint64_t impulses = state.counters.impulses;
        scene.strings[0].contacts = {};
        const StringModel bare = test::compiled_string(scene);
        StringState free = make_string_state(bare, Metering::Off, skip_nothing);
        std::copy_n(state.displacement.begin(), model.shape->stride, free.displacement.begin());
        std::copy_n(state.velocity.begin(), model.shape->stride, free.velocity.begin());
        notice_change(bare, free);
        double largest = 0;
        for (int n = 0; n < 300; ++n) {
            advance_frame(model, state);
            advance_frame(bare, free);
            for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
                largest = std::max(largest, std::abs(free.displacement[k]));
                ASSERT_NEAR(state.displacement[k], free.displacement[k], 1e-11 * largest) << n << " " << k;
            }
        }
        EXPECT_EQ(state.counters.impulses, impulses);
        reset(model, state);
        EXPECT_FALSE(state.leaves_obstacles);
    }
}

}  // namespace
}  // namespace jawari
