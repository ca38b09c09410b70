// Restitution at position level as Paoli and Schatzman publish it, y+ >= -e y_before (SIAM J. Numer. Anal.
// 40, 2002), on one mode and on a string over an arch.
#include <gtest/gtest.h>

#include <cstddef>

#include "literature/cases.h"

namespace jawari::literature {
namespace {

TEST(PublishedPaoliSchatzmanLaw, FollowsTheOscillatorOnAStop) {
    for (const double e : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        for (const double rate : {10000.0, 100000.0})
            EXPECT_LT(oscillator_error(ImpactLaw::PaoliSchatzman, e, rate, 20), 400 / rate) << e;
    }
}

TEST(PublishedPaoliSchatzmanLaw, KeepsTheEnergyOfAnElasticOscillator) {
    const EngineRun r = run(oscillator_scene(ImpactLaw::PaoliSchatzman, 1, 100000), 2501);
    EXPECT_NEAR(energy_kept(r), 1, 2e-3);
}

TEST(PublishedPaoliSchatzmanLaw, BouncesABarAsEventsInClosedFormSay) {
    for (const double e : {0.5, 0.8, 1.0})
        EXPECT_LT(bouncing_bar_error(ImpactLaw::PaoliSchatzman, e, 1e7), 1e-3) << e;
}

TEST(PublishedPaoliSchatzmanLaw, OnAnArchConvergesToTheLatticeAtOneAndTwoStepsAnInterval) {
    for (const double e : {0.5, 0.9, 1.0}) {
        UnitString finest = arch(100);
        finest.restitution = e;
        const auto reference = lattice_samples(finest, 41, 64);
        for (const double steps : {1.0, 1.5, 2.0}) {
            for (const std::size_t intervals : {100U, 200U, 400U}) {
                UnitString u = arch(intervals);
                u.law = ImpactLaw::PaoliSchatzman;
                u.restitution = e;
                u.steps_per_interval = steps;
                EXPECT_LT(error_of(run(scene_of(u), 41).probes, reference),
                          6.0 / static_cast<double>(intervals))
                    << e << ' ' << steps;
            }
        }
    }
}

TEST(PublishedPaoliSchatzmanLaw, OnAnArchOf499PointsIsRightAtTheRateThatSuitsThem) {
    // The scene file curved_499, at 750 Hz instead of 200 kHz: 1.5 steps an interval.
    UnitString u = arch(500);
    u.output_rate_hz = 50;
    u.law = ImpactLaw::PaoliSchatzman;
    u.restitution = 1;
    u.steps_per_interval = 1.5;
    SceneDescription scene = scene_of(u);
    scene.strings[0].initial.shape = Pluck{0.3, 0.5};
    EXPECT_LT(error_of(run(scene, 101).probes, lattice_samples(u, 101, 16)), 0.012);
}

}  // namespace
}  // namespace jawari::literature
