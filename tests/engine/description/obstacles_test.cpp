// Obstacles with a shape: fret positions by their intervals, necks by hand.
#include "jawari/scene/obstacles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jawari {
namespace {

TEST(Obstacles, FretsDivideTheStringIntoEqualTemperament) {
    EXPECT_EQ(equal_temperament_position(0.863, 0), 0);
    EXPECT_NEAR(equal_temperament_position(0.863, 12), 0.863 / 2, 1e-16);
    EXPECT_NEAR(equal_temperament_position(0.863, 24), 0.863 * 3 / 4, 1e-15);
    // The sounding length shrinks by the same semitone at every fret, and twelve of them are an octave.
    double sounding = 1;
    for (std::size_t fret = 1; fret <= 36; ++fret) {
        const double next = 1 - equal_temperament_position(1, fret);
        EXPECT_NEAR(std::pow(sounding / next, 12), 2, 1e-12) << fret;
        sounding = next;
    }
}

TEST(Obstacles, FretsKeepTheirHeightsInOrder) {
    const std::vector<double> heights{-1e-3, -2e-3, 0.5e-3};
    const auto frets = equal_temperament_frets(0.65, heights, 0.3);
    ASSERT_EQ(frets.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(frets[i].height_m, heights[i]);
        EXPECT_EQ(frets[i].restitution, 0.3);
        EXPECT_EQ(frets[i].side, Side::Below);
        EXPECT_EQ(frets[i].position_m, equal_temperament_position(0.65, i + 1));
    }
    EXPECT_TRUE(equal_temperament_frets(0.65, {}, 0).empty());
}

TEST(Obstacles, NeckIsLinearBetweenItsPointsAndConstantOutside) {
    const std::vector<ProfilePoint> profile{{0.2, -1.0}, {0.4, -3.0}, {0.6, -3.0}, {0.8, 1.0}};
    const auto neck = sampled_neck(1.0, 9, profile, 0.7);
    ASSERT_EQ(neck.size(), 9U);
    const double expected[] = {-1, -1, -2, -3, -3, -3, -1, 1, 1};
    for (std::size_t j = 0; j < 9; ++j) {
        EXPECT_NEAR(neck[j].position_m, 0.1 * static_cast<double>(j + 1), 1e-15);
        EXPECT_NEAR(neck[j].height_m, expected[j], 1e-12) << j;
        EXPECT_EQ(neck[j].restitution, 0.7);
        EXPECT_EQ(neck[j].side, Side::Below);
    }
}

TEST(Obstacles, NeckMayStepAndMayBeAPoint) {
    const std::vector<ProfilePoint> step{{0.5, -1.0}, {0.5, -2.0}};
    const auto neck = sampled_neck(1.0, 4, step, 0);
    EXPECT_EQ(neck[1].height_m, -1);  // x = 0.4
    EXPECT_EQ(neck[2].height_m, -2);  // x = 0.6
    const std::vector<ProfilePoint> flat{{0.3, -0.5}};
    for (const auto& contact : sampled_neck(2.0, 7, flat, 0)) EXPECT_EQ(contact.height_m, -0.5);
    EXPECT_TRUE(sampled_neck(2.0, 0, flat, 0).empty());
}

}  // namespace
}  // namespace jawari
