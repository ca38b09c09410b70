// The published figures of a mass against a barrier: energy kept to rounding, and the largest penetration of
// the continuous collision, ((alpha+1) m v^2/(2 K))^(1/(alpha+1)), reached with at least first order
// (the scheme's is second; the largest of samples adds their phase).
#include "quadratised_contact.h"

#include <gtest/gtest.h>

#include "falling_mass.h"
#include "support/test_names.h"

namespace jawari::rivals {
namespace {

constexpr double mass = 0.01, speed = 2, stiffness = 1e7;

test::Collision collision(Auxiliary auxiliary, double exponent, double h) {
    const QuadratisedContacts contacts({stiffness, exponent}, 1, auxiliary);
    return test::collide(contacts, mass, speed, h, 1000000, [](const auto& c) { return c.energy(); });
}

double deepest(double exponent) {
    return std::pow((exponent + 1) * mass * speed * speed / (2 * stiffness), 1 / (exponent + 1));
}

class Quadratised : public testing::TestWithParam<std::tuple<Auxiliary, double>> {};

TEST_P(Quadratised, KeepsEnergyWhileInContact) {
    const auto [auxiliary, exponent] = GetParam();
    // What is left of psi when the mass leaves is dropped: of second order in h, not of rounding.
    EXPECT_LT(collision(auxiliary, exponent, 1e-7).worst_energy, 1e-4);
    EXPECT_NEAR(collision(auxiliary, exponent, 1e-7).leaving_speed, speed, 1e-4 * speed);
}

TEST_P(Quadratised, KeepsEnergyToRoundingUntilTheMassLeaves) {
    const auto [auxiliary, exponent] = GetParam();
    const double h = 1e-7;
    QuadratisedContacts contacts({stiffness, exponent}, 1, auxiliary);
    const double half_duration = deepest(exponent) / speed;  // a lower bound
    const auto steps = static_cast<std::size_t>(10 + half_duration / h);
    EXPECT_LT(
        test::collide(contacts, mass, speed, h, steps, [](const auto& c) { return c.energy(); }).worst_energy,
        1e-9);  // rounding of (p - p_before)/h over a thousand steps
}

TEST_P(Quadratised, PenetratesAsDeepAsTheContinuousCollision) {
    const auto [auxiliary, exponent] = GetParam();
    const double coarse = std::abs(collision(auxiliary, exponent, 8e-7).deepest / deepest(exponent) - 1);
    const double fine = std::abs(collision(auxiliary, exponent, 1e-7).deepest / deepest(exponent) - 1);
    EXPECT_LT(fine, 1e-4);
    EXPECT_GT(std::log2(coarse / fine) / 3, 1.2) << coarse << " " << fine;
}

INSTANTIATE_TEST_SUITE_P(Exponents, Quadratised,
                         testing::Combine(testing::Values(Auxiliary::PerContact, Auxiliary::Shared),
                                          testing::Values(1.0, 1.5, 2.3)),
                         [](const auto& parameters) {
                             const bool own = std::get<0>(parameters.param) == Auxiliary::PerContact;
                             return (own ? "PerContact_" : "Shared_") +
                                    test::name_of_number(std::get<1>(parameters.param));
                         });

// Two contacts that share the string's inertia: the linear system is solved, whatever the coupling.
TEST(Quadratised, CoupledContactsSatisfyTheirEquations) {
    const PowerLaw law{3e4, 1.5};
    QuadratisedContacts contacts(law, 3, Auxiliary::PerContact);
    const std::vector<double> now{1e-5, 2e-5, -1e-5}, before{0.8e-5, 2.2e-5, -2e-5},
        free{1.3e-5, 1.9e-5, -0.5e-5};
    const std::vector<double> M{2e-7, 1e-7, 0, 1e-7, 3e-7, 0.5e-7, 0, 0.5e-7, 2e-7};
    std::vector<double> force(3);
    contacts.start(now);
    contacts.solve(now, before, free, M, force);
    for (std::size_t c = 0; c < 2; ++c) {
        const double psi = std::sqrt(2 * law.energy(now[c])), g = law.slope(now[c]);
        double next = free[c];
        for (std::size_t d = 0; d < 3; ++d) next -= M[3 * c + d] * force[d];
        EXPECT_NEAR(force[c], g * (psi + g * (next - before[c]) / 4), 1e-12 * force[c]);
    }
    EXPECT_EQ(force[2], 0);
}

}  // namespace
}  // namespace jawari::rivals
