// The published figure: restitution falls as 1 - a v with a = 2 d/3 (Hunt and Crossley 1975), and the exact
// relation behind it.
#include "hunt_crossley.h"

#include <gtest/gtest.h>

#include "falling_mass.h"

namespace jawari::rivals {
namespace {

double simulated_restitution(double exponent, double damping, double speed, double h) {
    const HuntCrossleyContacts contacts({1e7, exponent}, {damping}, h);
    return test::collide(contacts, 0.01, speed, h, 1000000, [](const auto&) { return 0.0; }).leaving_speed /
           speed;
}

TEST(HuntCrossley, RestitutionOfSlowImpactsFallsByTwoThirdsOfDampingTimesSpeed) {
    for (const double x : {1e-4, 1e-3, 1e-2}) {
        EXPECT_NEAR((1 - restitution_of_damping(x, 1)) / (2 * x / 3), 1, x);
        EXPECT_NEAR((1 - simulated_restitution(1.5, x, 1, 2e-8)) / (2 * x / 3), 1, 2 * x + 1e-3);
    }
}

TEST(HuntCrossley, SimulatedRestitutionIsTheClosedForm) {
    for (const double exponent : {1.0, 1.5, 2.3}) {
        for (const double damping : {0.05, 0.5, 2.0, 10.0}) {
            for (const double speed : {0.3, 2.0}) {
                const double expected = restitution_of_damping(damping, speed);
                EXPECT_NEAR(simulated_restitution(exponent, damping, speed, 1e-7), expected,
                            2e-4 + 1e-3 * (1 - expected))
                    << exponent << " " << damping << " " << speed;
            }
        }
    }
}

TEST(HuntCrossley, DampingInvertsRestitution) {
    for (const double e : {0.05, 0.5, 0.9, 0.999}) {
        for (const double v : {0.1, 1.0, 3.0}) {
            EXPECT_NEAR(restitution_of_damping(damping_of_restitution(e, v), v), e, 1e-12);
        }
    }
}

}  // namespace
}  // namespace jawari::rivals
