// Strings over distributed obstacles and between two, against d'Alembert's solution on a lattice.
#include <gtest/gtest.h>

#include <cstddef>

#include "literature/cases.h"
#include "literature/spring_string.h"

namespace jawari::literature {
namespace {

constexpr std::size_t fine_lattice = 2560;

TEST(LatticeReference, ConvergesItself) {
    // On the arch with e = 0 the lattice is exact at any number of intervals.
    const UnitString inelastic = arch(80);
    EXPECT_LT(error_of(lattice_samples(inelastic, 41), lattice_samples(inelastic, 41, 8)), 1e-11);
    UnitString elastic = arch(400);
    elastic.restitution = 1;
    const auto finest = lattice_samples(elastic, 41, 16);
    EXPECT_LT(error_of(lattice_samples(elastic, 41, 8), finest), 1e-3);
    EXPECT_LT(error_of(lattice_samples(elastic, 41, 4), finest), 3e-3);
    const UnitString bridge = sitar(80);
    EXPECT_LT(error_of(lattice_samples(bridge, 121, 16), lattice_samples(bridge, 121, 64)), 1e-4);
}

TEST(LatticeReference, OfAnElasticArchIsTheLimitOfStiffSprings) {
    UnitString elastic = arch(6400);
    elastic.restitution = 1;
    const auto rigid = lattice_samples(elastic, 41);
    double before = HUGE_VAL;
    for (const std::size_t refinement : {1U, 2U, 4U}) {
        UnitString u = arch(1600 * refinement);
        const double stiffness = 2.5e5 * static_cast<double>(refinement * refinement);  // K dx^2 = 0.1
        const double error = error_of(samples_of(SpringString(u, stiffness), u, 41, u.intervals / 20), rigid);
        EXPECT_LT(error, before / 1.6) << refinement;
        before = error;
    }
    EXPECT_LT(before, 5e-3);
}

TEST(LatticeReference, OfFinerStepsThanPointsIsWrongToo) {
    // Finite differences share nothing with modes. Below their limit of stability they stop converging as
    // well.
    for (const std::size_t intervals : {200U, 400U}) {
        const UnitString u = arch(intervals);
        const auto exact = lattice_samples(u, 41);
        EXPECT_GT(error_of(difference_samples(u, 41, 16), exact), 0.012) << intervals;
    }
}

TEST(RattlingString, BetweenAPointBelowAndAPointAbove) {
    for (const std::size_t intervals : {160U, 320U, 640U}) {
        const UnitString u = rattling(intervals);
        EXPECT_LT(lattice_error(u, 121, fine_lattice), 5.0 / static_cast<double>(intervals));
    }
    SceneDescription scene = scene_of(rattling(160));  // and it strikes both
    for (std::size_t contact = 0; contact < 2; ++contact)
        scene.strings[0].probes.push_back({Quantity::ContactForce, 0, contact});
    const EngineRun r = run(scene, 121);
    for (const std::size_t probe : {r.probes.size() - 2, r.probes.size() - 1}) {
        double pushed = 0;
        for (const double force : r.probes[probe]) pushed += force;
        EXPECT_GT(pushed, 0.1);
    }
}

TEST(SitarString, WrapsAroundTheBridgeOfBurridgeKappraffAndMorshedi) {
    double before = HUGE_VAL;
    for (const std::size_t intervals : {80U, 160U, 320U}) {
        const double error = lattice_error(sitar(intervals), 121, fine_lattice);
        EXPECT_LT(error, before / 2.5) << intervals;
        before = error;
    }
    EXPECT_LT(before, 1e-3);
}

TEST(StringOverAnArch, WithoutReboundIsTheLatticesAtOneAndTwoStepsAnInterval) {
    for (const double steps : {1.0, 1.5, 2.0}) {
        for (const std::size_t intervals : {100U, 200U, 400U}) {
            UnitString u = arch(intervals);
            u.steps_per_interval = steps;
            EXPECT_LT(lattice_error(u, 41, intervals), 0.75 / static_cast<double>(intervals)) << steps;
        }
    }
}

TEST(StringOverAnArch, OfMoreModesThanPointsAtOneStepAnIntervalIsTooAndAtTwoIsNot) {
    const UnitString u = arch(200);
    SceneDescription scene = scene_of(u);
    std::get<PhysicalModes>(scene.strings[0].modes).count = 799;
    scene.strings[0].initial.shape = Pluck{0.3, 0.5};
    const auto reference = lattice_samples(u, 41);
    EXPECT_LT(error_of(run(scene, 41).probes, reference), 1e-3);
    scene.contact_rate_hz *= 2;  // now a wave needs two steps between points, and they are single points
    EXPECT_GT(error_of(run(scene, 41).probes, reference), 0.03);
}

TEST(FrontOfContact, TakesTheEnergyOfTheStringsMotionAcrossTheWedge) {
    for (const double front : {1.25, 1.5, 2.0, 3.0}) {
        const double right = 1 - 1 / (front * front);
        for (const double steps : {1.0, 2.0})
            EXPECT_NEAR(front_loss(front, 400, steps), right, 0.007) << front;
    }
    // Points that a wave needs many steps between act one by one: a front near the speed of waves then takes
    // too little, however many points there are.
    for (const std::size_t intervals : {100U, 400U})
        EXPECT_NEAR(front_loss(1.25, intervals, 32), 0.8 * (1 - 1 / (1.25 * 1.25)), 0.02) << intervals;
}

}  // namespace
}  // namespace jawari::literature
