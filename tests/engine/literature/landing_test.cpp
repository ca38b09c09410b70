// A plucked string lands on a plane: half of it, or another part, all at once.
#include <gtest/gtest.h>

#include <cstddef>

#include "literature/cases.h"

namespace jawari::literature {
namespace {

TEST(LandingString, LosesTheMotionOfThePartThatLands) {
    for (const double depth : {0.3, 0.5, 0.8}) {
        for (const std::size_t intervals : {80U, 160U})
            EXPECT_LT(landing_energy_error(depth, landing(depth, intervals)),
                      1.0 / static_cast<double>(intervals))
                << depth;
    }
}

TEST(LandingString, LiesOnThePlaneAsTheLatticeDoes) {
    for (const std::size_t intervals : {80U, 160U})
        EXPECT_LT(lattice_error(landing(0.5, intervals), 81, intervals),
                  0.3 / static_cast<double>(intervals));
}

TEST(LandingString, Of255ModesKeepsHalfItsEnergy) {
    const EngineRun r = run(plane_scene(255, ImpactLaw::Newton), rows_past_landing);
    EXPECT_NEAR(energy_kept(r), 0.5, 0.004);
    EXPECT_EQ(r.counters.truncated_solves, 0U);
}

TEST(LandingString, ThrownBackElasticallyHasThePeriodOnePlusDepth) {
    for (const double depth : {0.3, 0.5}) {
        for (const std::size_t intervals : {80U, 160U}) {
            UnitString u = landing(depth, intervals);
            u.law = ImpactLaw::Newton;
            u.restitution = 1;
            u.steps_per_interval = 32;
            EXPECT_LT(landing_elastic_error(depth, u), 1.3 / static_cast<double>(intervals)) << depth;
        }
    }
}

}  // namespace
}  // namespace jawari::literature
