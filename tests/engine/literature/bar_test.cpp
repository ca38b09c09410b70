// A bar on a stop: the modes of the bar, the contact of a string.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "literature/cases.h"

namespace jawari::literature {
namespace {

TEST(BarOnAStop, ReferenceIsClampedAtTheStop) {
    const ClampedHalves exact;
    EXPECT_NEAR(std::tan(exact.z), std::tanh(exact.z), 1e-12);
    EXPECT_NEAR(exact.at(0.5, 0.1), exact.rise, 1e-15);
    EXPECT_NEAR(exact.at(0.5 - 1e-4, 0) - exact.rise, 0, 1e-7);  // flat there
    const std::vector<double> q = exact.modal(2001);
    double u = 0;
    for (std::size_t k = 1; k <= q.size(); ++k) u += q[k - 1] * mode_shape(k, 0.3, 1);
    EXPECT_NEAR(u, exact.at(0.3, 0), 1e-10);
}

TEST(BarOnAStop, SwingsAsTwoHalvesClampedThere) {
    for (const ImpactLaw law : {ImpactLaw::Signorini, ImpactLaw::Newton, ImpactLaw::Passive}) {
        EXPECT_LT(clamped_halves_error(law, 20, 4000), 1e-4) << name_of(law);
        EXPECT_LT(clamped_halves_error(law, 80, 16000), 6e-6) << name_of(law);
    }
}

TEST(BarOnAStop, BouncesAsEventsInClosedFormSay) {
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Passive}) {
        for (const double e : {0.5, 0.8, 1.0}) {
            EXPECT_LT(bouncing_bar_error(law, e, 1e5), 2e-3) << name_of(law) << e;
            EXPECT_LT(bouncing_bar_error(law, e, 1e7), 5e-5) << name_of(law) << e;
        }
    }
}

}  // namespace
}  // namespace jawari::literature
