// compile(): contacts kept, dropped and refused; coefficients that belong together; limits that hold.
#include "jawari/scene/compile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scenes.h"

namespace jawari {
namespace {

SceneDescription bass(std::size_t modes = 40) {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(modes));
    scene.strings[0].contacts.clear();
    return scene;
}

TEST(Compile, DropsContactsThatSitOnTheStringsEnds) {
    SceneDescription scene = bass();
    scene.strings[0].contacts = {{0, -1e-3, 0, Side::Below},    {0.2, -1e-3, 0.1, Side::Below},
                                 {0.863, 0, 0, Side::Below},    {0.4, 2e-3, 0.2, Side::Above},
                                 {0.863, 1e-3, 0, Side::Above}, {1e-9, -1e-3, 0, Side::Below}};
    const StringModel model = test::compiled_string(scene);
    EXPECT_EQ(model.shape->contact_count, 2U);
    EXPECT_EQ(model.shape->contact_of_description, (std::vector<std::ptrdiff_t>{-1, 0, -1, 1, -1, -1}));
    EXPECT_EQ(model.shape->contact_position, (std::vector<double>{0.2, 0.4}));
    EXPECT_EQ(model.shape->contact_restitution, (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(model.shape->contact_height, (std::vector<double>{-1e-3, -2e-3}));  // gap = -u + 2 mm
    EXPECT_EQ(model.shape->contact_stride, 8U);
}

TEST(Compile, RefusesContactsThatLiftTheStringsEnds) {
    for (const auto& contact : {ContactDescription{0, 1e-3, 0, Side::Below},
                                {0.863, 1e-9, 0, Side::Below},
                                {0.863, -1e-3, 0, Side::Above}}) {
        SceneDescription scene = bass();
        scene.strings[0].contacts = {{0.2, -1e-3, 0, Side::Below}, contact};
        const auto refused = compile(scene);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.failure().place, "strings[0].contacts[1].height_m");
        EXPECT_EQ(refused.failure().allowed,
                  "a height that leaves the string's end at rest, or a position inside the string");
    }
}

TEST(Compile, AllowsCoincidentContacts) {
    SceneDescription scene = bass();
    scene.contact_rate_hz = 96000;
    scene.strings[0].contacts.assign(5, {0.3, -1e-3, 0, Side::Below});
    scene.strings[0].contacts.push_back({0.3, 3e-3, 0, Side::Above});
    const StringModel model = test::compiled_string(scene);
    EXPECT_EQ(model.shape->contact_count, 6U);
    StringState state = make_string_state(model, Metering::Step);
    for (int n = 0; n < 5000; ++n) step(model, state);
    EXPECT_GT(state.counters.impulses, 0U);
    EXPECT_EQ(state.counters.truncated_solves, 0U);
    EXPECT_LE(state.energy.worst_rise, 1e-13 * state.energy.initial);
}

TEST(Compile, ArraysArePaddedWithModesAtRest) {
    for (const std::size_t modes : {1U, 7U, 8U, 9U, 41U}) {
        SceneDescription scene = bass(modes);
        scene.strings[0].contacts.push_back({0.3, -1e-3, 0, Side::Below});
        const StringModel model = test::compiled_string(scene);
        EXPECT_EQ(model.shape->mode_count, modes);
        EXPECT_EQ(model.shape->stride % 8, 0U);
        EXPECT_LT(model.shape->stride, modes + 8);
        StringState state = make_string_state(model);
        for (int n = 0; n < 100; ++n) step(model, state);
        for (std::size_t k = modes; k < model.shape->stride; ++k) {
            EXPECT_EQ(state.displacement[k], 0);
            EXPECT_EQ(state.velocity[k], 0);
        }
    }
}

TEST(Compile, ContactRowsAreTheModeShapes) {
    SceneDescription scene = bass(30);
    scene.strings[0].contacts = {{0.2, -1e-3, 0, Side::Below}, {0.5, 1e-3, 0, Side::Above}};
    const StringModel model = test::compiled_string(scene);
    for (std::size_t k = 0; k < 30; ++k) {
        const double root = std::sqrt(2 / 0.863);
        const double wavenumber = static_cast<double>(k + 1) * std::numbers::pi / 0.863;
        EXPECT_NEAR(model.shape->contact_rows[k], root * std::sin(wavenumber * 0.2), 1e-13);
        EXPECT_NEAR(model.shape->contact_rows[model.shape->stride + k], -root * std::sin(wavenumber * 0.5),
                    1e-13);
    }
}

TEST(Compile, ExactStartsPassThroughTheTrueMotion) {
    // Without losses and obstacles the released pluck is even in time: u(-h) = u(h), so v = -(u(h) - u(0))/h.
    SceneDescription scene = bass(60);
    std::get<PhysicalModes>(scene.strings[0].modes).damping = NoLoss{};
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    step(model, state);
    for (std::size_t k = 0; k < 60; ++k) {
        const double scale = std::abs(model.shape->initial_displacement[k]) * model.tuning.omega[k] + 1e-12;
        EXPECT_NEAR(state.velocity[k], -model.shape->initial_velocity[k], 1e-12 * scale);
    }
    // `backward` takes the true velocity literally.
    scene.strings[0].initial.start = Start::Backward;
    const StringModel backward = test::compiled_string(scene);
    for (const double v : backward.shape->initial_velocity) EXPECT_EQ(v, 0);
}

TEST(Compile, RefusesCoefficientsThatAreNotFinite) {
    SceneDescription scene = bass();
    scene.strings[0].modes = ModeTable{{1e300}, {0}};
    const auto refused = compile(scene);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.failure().place, "strings[0].modes");
}

TEST(Compile, LossesThatExtrapolateBelowZeroAreRefused) {
    // Two T60 points whose line falls below zero loss at the lowest modes.
    SceneDescription scene = bass();
    std::get<PhysicalModes>(scene.strings[0].modes).damping = DecayTimePoints{{{{5000, 10}, {6000, 0.01}}}};
    const auto refused = compile(scene);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.failure().place, "strings[0].modes");
}

TEST(Compile, TakesTheLargestSizesAllowed) {
    SceneDescription scene = bass(limits::modes);
    scene.contact_rate_hz = 48000;
    scene.strings[0].contacts = {{0.3, -1e-3, 0, Side::Below}};
    EXPECT_TRUE(compile(scene).ok());
    scene.output_rate_hz = 1;
    scene.contact_rate_hz = 65536;
    scene.strings[0].modes = ModeTable{{100}, {1}};
    EXPECT_EQ(compile(scene).value().steps_per_frame, 65536U);
}

}  // namespace
}  // namespace jawari
