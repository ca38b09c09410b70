// A string at rest on its bridge stays there.
#include "literature/bridge_at_rest.h"

#include <gtest/gtest.h>

namespace jawari::literature {
namespace {

TEST(StringAtRestOnABridge, StaysThere) {
    for (const std::size_t points : {200U, 800U}) {
        const EngineRun r = run(bridge_at_rest(points), 21);
        EXPECT_GT(r.counters.impulses, 0U);
        EXPECT_EQ(r.counters.truncated_solves, 0U);
        // What moves is what the modes that are missing leave open, 1/points^2 of the bridge's curvature.
        const double spacing = 1 / static_cast<double>(points + 1);
        EXPECT_LT(furthest_from_rest(r), 0.1 * spacing * spacing) << points;
        EXPECT_NEAR(energy_kept(r), 1, 30 * spacing * spacing);
    }
}

}  // namespace
}  // namespace jawari::literature
