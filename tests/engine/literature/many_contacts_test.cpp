// Scenes in which several hundred contacts touch at once.
#include <gtest/gtest.h>

#include <cstddef>

#include "literature/bridge_at_rest.h"
#include "literature/cases.h"

namespace jawari::literature {
namespace {

TEST(ManyContacts, OnAPlaneOf999PointsHalfTheEnergyIsKept) {
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Signorini}) {
        const EngineRun r = run(plane_scene(999, law), rows_past_landing);
        EXPECT_EQ(r.counters.truncated_solves, 0U) << name_of(law);
        EXPECT_NEAR(energy_kept(r), 0.5, 0.004) << name_of(law);
    }
}

TEST(ManyContacts, AStringThatRestsOn2400PointsOfABridgeStaysThere) {
    const EngineRun r = run(bridge_at_rest(2400), 11);
    EXPECT_EQ(r.counters.truncated_solves, 0U);
    EXPECT_LT(furthest_from_rest(r), 5e-8);
    EXPECT_NEAR(energy_kept(r), 1, 1e-5);
}

TEST(ManyContacts, LandingConvergesBeyond128Contacts) {
    EXPECT_LT(landing_energy_error(0.3, landing(0.3, 640)), 1.0 / 640);
    EXPECT_LT(lattice_error(landing(0.5, 640), 81, 640), 0.3 / 640);
}

}  // namespace
}  // namespace jawari::literature
