// Strings that start against obstacles: against the piecewise linear shapes of a flexible string, and by
// staying at rest.
#include "string/compile/static_equilibrium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

constexpr double length_m = 0.8;
constexpr double tension_N = 100;

SceneDescription flexible_string(std::size_t modes, double rate_hz, ImpactLaw law = ImpactLaw::Signorini) {
    StringDescription string;
    string.length_m = length_m;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes physical;
    physical.count = modes;
    physical.tension_N = tension_N;
    string.modes = physical;
    SceneDescription scene;
    scene.output_rate_hz = scene.contact_rate_hz = rate_hz;
    scene.law = law;
    scene.strings.push_back(string);
    return scene;
}

double shape_at(const StringModel& model, const AlignedVector<double>& q, double x) {
    double u = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        u += std::sqrt(2 / length_m) *
             std::sin(static_cast<double>(k + 1) * std::numbers::pi * x / length_m) * q[k];
    }
    return u;
}

/// What N modes cannot show of the kink under 1 N: 2 L/(pi^2 T N).
double truncation_per_newton(std::size_t modes) {
    return 2 * length_m / (std::numbers::pi * std::numbers::pi * tension_N * static_cast<double>(modes));
}

TEST(StaticEquilibrium, OverOneFretTheStringIsStraightOnBothSides) {
    const double x_fret = 0.3, height = 2e-3;
    SceneDescription scene = flexible_string(4000, 48000);
    scene.strings[0].contacts.push_back({x_fret, height, 0, Side::Below});
    const StringModel model = test::compiled_string(scene);
    const double force = tension_N * height * length_m / (x_fret * (length_m - x_fret));
    for (const double x : {0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75}) {
        const double expected =
            x < x_fret ? height * x / x_fret : height * (length_m - x) / (length_m - x_fret);
        EXPECT_NEAR(shape_at(model, model.shape->initial_displacement, x), expected,
                    2 * force * truncation_per_newton(4000))
            << x;
    }
    EXPECT_NEAR(shape_at(model, model.shape->initial_displacement, x_fret), height, 1e-15);
    EXPECT_EQ(model.shape->initial_displacement, model.shape->rest_displacement);
    // Force balance: the fret carries the tension's two vertical components.
    StringState state = make_string_state(model);
    step(model, state);
    EXPECT_NEAR(state.contact.impulse[0] * 48000, force, 2e-3 * force);
}

TEST(StaticEquilibrium, OverManyFretsTheStringIsTheirConcaveHull) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    const std::size_t modes = 3000;
    for (int trial = 0; trial < 12; ++trial) {
        SceneDescription scene = flexible_string(modes, 48000);
        std::vector<std::pair<double, double>> points{{0, 0}};
        for (int i = 1; i <= 9; ++i) {
            points.emplace_back(length_m * (i + 0.5 * uniform(random)) / 11, 3e-3 * (uniform(random) - 0.2));
            scene.strings[0].contacts.push_back({points.back().first, points.back().second, 0, Side::Below});
        }
        points.emplace_back(length_m, 0);
        const StringModel model = test::compiled_string(scene);

        std::vector<std::pair<double, double>> hull;
        for (const auto& p : points) {
            while (hull.size() >= 2) {
                const auto& [x0, y0] = hull[hull.size() - 2];
                const auto& [x1, y1] = hull.back();
                if ((x1 - x0) * (p.second - y0) < (y1 - y0) * (p.first - x0)) break;
                hull.pop_back();
            }
            hull.push_back(p);
        }
        for (int j = 1; j < 40; ++j) {
            const double x = length_m * j / 40;
            const auto right =
                std::find_if(hull.begin(), hull.end(), [&](const auto& p) { return p.first >= x; });
            const auto left = right - 1;
            const double chord = left->second + (right->second - left->second) * (x - left->first) /
                                                    (right->first - left->first);
            EXPECT_NEAR(shape_at(model, model.shape->initial_displacement, x), chord,
                        15 * truncation_per_newton(modes))
                << "trial " << trial << ", x = " << x;
        }
    }
}

class Resting : public testing::TestWithParam<ImpactLaw> {};

TEST_P(Resting, StringHeldByFretsStaysAtRest) {
    for (const double rate : {4000.0, 44100.0, 1e6, 8e6}) {
        SceneDescription scene = flexible_string(60, rate, GetParam());
        std::get<PhysicalModes>(scene.strings[0].modes).inharmonicity = 1e-4;
        scene.strings[0].contacts = {{0.2, 1e-3, 0, Side::Below},   {0.3, 1.6e-3, 0, Side::Below},
                                     {0.3, 1.6e-3, 0, Side::Below}, {0.4, -1e-3, 0, Side::Below},
                                     {0.5, 1.1e-3, 0, Side::Below}, {0.65, -0.5e-3, 0, Side::Above}};
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const double initial = energy(model, state);
        EXPECT_GT(initial, 1e-6);
        for (int n = 0; n < 4000; ++n) step(model, state);
        EXPECT_GT(state.counters.impulses, 4000U);
        EXPECT_EQ(state.counters.truncated_solves, 0U);
        for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
            const double drift = state.displacement[k] - model.shape->initial_displacement[k];
            EXPECT_LE(std::abs(drift), 1e-13) << rate << " Hz, mode " << k + 1;
            EXPECT_LE(std::abs(state.velocity[k]), 1e-9) << rate << " Hz, mode " << k + 1;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, Resting, testing::Values(ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman),
                         test::named);

TEST(StaticEquilibrium, FreeStringsAreNotTouched) {
    SceneDescription scene = flexible_string(50, 48000);
    scene.strings[0].contacts = {
        {0.3, -1e-3, 0, Side::Below}, {0.4, 1e-3, 0, Side::Above}, {0.5, 0, 0, Side::Below}};
    const StringModel model = test::compiled_string(scene);
    for (const double q : model.shape->initial_displacement) EXPECT_EQ(q, 0);
    for (const double q : model.shape->rest_displacement) EXPECT_EQ(q, 0);
}

class HeldPluck : public testing::TestWithParam<ImpactLaw> {};

TEST_P(HeldPluck, IsLiftedClearOfObstaclesAndGainsNothing) {
    // Down: the triangle alone would be 1.3 mm inside the first fret. Up: both frets hold the string higher
    // than the pluck.
    for (const double rate : {48000.0, 1e6}) {
        for (const auto& [pluck, fret] : {std::pair{-3e-3, -0.2e-3}, std::pair{1e-3, 2e-3}}) {
            SceneDescription scene = flexible_string(80, rate, GetParam());
            scene.strings[0].initial.shape = Pluck{0.5, pluck};
            scene.strings[0].contacts = {{0.25, fret, 0, Side::Below}, {0.7, fret, 0, Side::Below}};
            const StringModel model = test::compiled_string(scene);
            EXPECT_NEAR(shape_at(model, model.shape->initial_displacement, 0.25), fret, 1e-15);
            EXPECT_GE(shape_at(model, model.shape->initial_displacement, 0.7), fret - 1e-15);
            StringState state = make_string_state(model, Metering::Step);
            for (int n = 0; n < 2000; ++n) step(model, state);
            EXPECT_LE(state.energy.worst_rise, 1e-13 * state.energy.initial)
                << rate << " Hz, pluck " << pluck;
            EXPECT_LE(state.energy.highest, state.energy.initial * (1 + 1e-12))
                << rate << " Hz, pluck " << pluck;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, HeldPluck, testing::Values(ImpactLaw::Passive, ImpactLaw::Signorini),
                         test::named);

TEST(StaticEquilibrium, ObstaclesThatContradictOneAnotherAreRefused) {
    SceneDescription scene = flexible_string(50, 48000);
    scene.strings[0].contacts = {{0.3, 1e-3, 0, Side::Below}, {0.3, -1e-3, 0, Side::Above}};
    const auto refused = compile(scene);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.failure().place, "strings[0].contacts");
    EXPECT_EQ(refused.failure().allowed, "obstacles between which the string fits");
    // Below one and above the other there is room.
    scene.strings[0].contacts[1].height_m = 1.5e-3;
    EXPECT_TRUE(compile(scene).ok());
    // More obstacles than modes can follow.
    scene = flexible_string(2, 48000);
    scene.strings[0].contacts = {{0.2, 1e-3, 0, Side::Below},
                                 {0.4, -1e-3, 0, Side::Above},
                                 {0.6, 1e-3, 0, Side::Below},
                                 {0.7, -1e-3, 0, Side::Above}};
    EXPECT_FALSE(compile(scene).ok());
}

}  // namespace
}  // namespace jawari
