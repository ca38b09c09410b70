// Every check can fail: each is fed a sound number and a broken one.
#include "invariants.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace jawari::stress {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_sound(const Judge& judge) {
    EXPECT_TRUE(judge.violations().empty());
}

void expect_broken(const Judge& judge, Invariant invariant) {
    ASSERT_EQ(judge.violations().size(), 1U);
    EXPECT_EQ(judge.violations().front().invariant, invariant);
}

TEST(Judge, TakesNotANumberForAViolationOnEitherSide) {
    for (const auto& [found, allowed] :
         {std::pair{nan, 1.0}, std::pair{0.0, nan}, std::pair{infinity, 1.0}}) {
        Judge judge;
        judge.at_most(Invariant::Output, found, allowed, "here");
        expect_broken(judge, Invariant::Output);
    }
}

TEST(Judge, KeepsTheFirstOfEachInvariantAndTheClosestApproach) {
    Judge judge;
    judge.at_most(Invariant::Output, 1, 4, "a");
    judge.at_most(Invariant::Output, 8, 4, "b");
    judge.at_most(Invariant::Output, 9, 4, "c");
    expect_broken(judge, Invariant::Output);
    EXPECT_EQ(judge.violations().front().where, "b");
    EXPECT_EQ(judge.closest(Invariant::Output), 9.0 / 4);
    EXPECT_EQ(judge.closest(Invariant::Finite), 0);
}

TEST(Checks, SeeWhatIsNotFinite) {
    for (const double value : {nan, infinity, -infinity}) {
        Judge judge;
        check_finite(judge, std::array{0.0, 1.0}, "sound");
        expect_sound(judge);
        check_finite(judge, std::array{0.0, value}, "broken");
        expect_broken(judge, Invariant::Finite);
    }
    Judge judge;
    check_resets(judge, 0, "sound");
    expect_sound(judge);
    check_resets(judge, 1, "broken");
    expect_broken(judge, Invariant::Finite);
}

TEST(Checks, SeeABalanceThatDoesNotClose) {
    Judge judge;
    EnergyMeter meter;
    meter.worst_imbalance = 1e-16;
    check_balance(judge, meter, 1e-15, "sound");
    expect_sound(judge);
    meter.worst_imbalance = 2e-15;
    check_balance(judge, meter, 1e-15, "broken");
    expect_broken(judge, Invariant::EnergyBalance);
    Judge of_losses;
    meter = {};
    meter.dissipated = -1e-30;
    check_balance(of_losses, meter, 1e-15, "broken");
    expect_broken(of_losses, Invariant::EnergyBalance);
}

TEST(Checks, SeeEnergyFromNowhere) {
    Judge of_step;
    EnergyMeter meter;
    meter.worst_rise = 1e-16;
    check_rise_of_step(of_step, meter, 1e-15, "sound");
    expect_sound(of_step);
    meter.worst_rise = 2e-15;
    check_rise_of_step(of_step, meter, 1e-15, "broken");
    expect_broken(of_step, Invariant::EnergyRise);
    Judge of_block;
    check_rise_of_block(of_block, -1, 1e-15, "sound");
    expect_sound(of_block);
    check_rise_of_block(of_block, 2e-15, 1e-15, "broken");
    expect_broken(of_block, Invariant::EnergyRise);
}

TEST(Checks, SeePenetrationAndPoorSolves) {
    Judge of_depth;
    check_depth(of_depth, 1e-6, 1e-6, "sound");
    expect_sound(of_depth);
    check_depth(of_depth, 1.1e-6, 1e-6, "broken");
    expect_broken(of_depth, Invariant::Penetration);
    Judge of_residual;
    check_residual(of_residual, 1e-10, 1e-3, 0, "sound");
    expect_sound(of_residual);
    check_residual(of_residual, 1e-8, 1e-3, 0, "broken");
    expect_broken(of_residual, Invariant::Residual);
}

TEST(Checks, SeeTruncatedSolves) {
    Counters counters;
    counters.solves = 1000;
    Judge sound;
    check_truncation(sound, counters, true, "sound");
    counters.truncated_solves = 1;
    check_truncation(sound, counters, false, "sound");
    expect_sound(sound);
    Judge independent;
    check_truncation(independent, counters, true, "broken");
    expect_broken(independent, Invariant::Truncation);
    Judge dependent;
    counters.truncated_solves = 20;
    check_truncation(dependent, counters, false, "broken");
    expect_broken(dependent, Invariant::Truncation);
}

TEST(Checks, SeeOutputsThatAreTooLarge) {
    Judge judge;
    check_output(judge, std::array{-1.0, 0.5}, 1, "sound");
    check_not_negative(judge, std::array{0.0, 2.0}, "sound");
    expect_sound(judge);
    check_output(judge, std::array{-1.001, 0.5}, 1, "broken");
    expect_broken(judge, Invariant::Output);
    Judge of_force;
    check_not_negative(of_force, std::array{0.0, -1e-300}, "broken");
    expect_broken(of_force, Invariant::Output);
}

TEST(Checks, SeeASingleBit) {
    Judge judge;
    check_same(judge, std::array{1.0, nan}, std::array{1.0, nan}, "sound");
    expect_sound(judge);
    check_same(judge, std::array{1.0, 0.0}, std::array{1.0, -0.0}, "broken");
    expect_broken(judge, Invariant::Determinism);
    Judge of_length;
    check_same(of_length, std::array{1.0}, std::array{1.0, 1.0}, "broken");
    expect_broken(of_length, Invariant::Determinism);
}

TEST(Bounds, OfTheLaws) {
    EXPECT_EQ(depth_of_law(ImpactLaw::Signorini, 1, 2), 0);
    EXPECT_EQ(depth_of_law(ImpactLaw::Newton, 0, 2), 3);
    EXPECT_EQ(depth_of_law(ImpactLaw::Passive, 1, 2), 3);
    EXPECT_EQ(depth_of_law(ImpactLaw::PaoliSchatzman, 1, 2), 2);
    EXPECT_EQ(depth_of_law(ImpactLaw::PaoliSchatzman, 0, 2), 0);
}

}  // namespace
}  // namespace jawari::stress
