// Cabannes' string over a point obstacle, against its solution in closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "literature/cases.h"

namespace jawari::literature {
namespace {

const std::array<double, 3> cabannes_depths{0.3, 0.5, 1 / std::sqrt(3.0)};

TEST(CabannesString, TwoReferencesAgree) {
    // The lattice is exact where every event falls on it; the other reference is exact for every depth.
    const UnitString u = cabannes(0.3, 40);
    const MiddleObstacle exact(0.3, 7);
    EXPECT_EQ(exact.landings(), 4U);
    const auto lattice = lattice_samples(u, 121);
    for (std::size_t p = 0; p < u.probes.size(); ++p) {
        for (std::size_t n = 0; n < 121; ++n)
            ASSERT_NEAR(lattice[p][n], exact.at(u.probes[p], static_cast<double>(n) / 20), 1e-13) << n;
    }
}

TEST(CabannesString, OverAPointInTheMiddleConvergesAtFirstOrder) {
    for (const double depth : cabannes_depths) {
        for (const std::size_t intervals : {160U, 320U, 640U}) {
            const double error = cabannes_error(depth, cabannes(depth, intervals));
            EXPECT_LT(error, 3.5 / static_cast<double>(intervals)) << depth;
        }
    }
}

TEST(CabannesString, DoesNotDependOnRestitution) {
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Passive}) {
        for (const double e : {0.0, 0.5, 1.0}) {
            UnitString u = cabannes(0.3, 320);
            u.law = law;
            u.restitution = e;
            u.steps_per_interval = 2;
            EXPECT_LT(cabannes_error(0.3, u), 7.0 / 320) << name_of(law) << e;
        }
    }
}

}  // namespace
}  // namespace jawari::literature
