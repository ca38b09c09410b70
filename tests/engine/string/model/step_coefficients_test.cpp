// Step coefficients against 100-digit arithmetic. How the allowances come about: docs/engine/accuracy.md.
#include "jawari/detail/step_coefficients.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>

#include "support/high_precision.h"

namespace jawari {
namespace {

using test::Definition;
using test::definition_of;
using test::Real;

constexpr double unit_roundoff = 0x1p-53;

double relative_error(double value, const Real& truth) {
    return static_cast<double>(abs((Real(value) - truth) / truth));
}

/// Coefficients are computed in long double and rounded once.
constexpr bool extended = std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits;
constexpr double working_roundoff = static_cast<double>(std::numeric_limits<long double>::epsilon() / 2);

/// 1e-15 (two roundings where long double is wider), and what the sine's argument costs where it is ill
/// conditioned: W h carries at most 3.5 roundings (two in the factors of W^2 and one in their product, all
/// halved by the root, one in the root, one in the product with h), of which each costs |d ln d/d ln(W h)|
/// times its size. A condition up to 2 (that of a square) is part of the 1e-15.
double allowance(const Real& argument_condition) {
    const double condition = std::abs(static_cast<double>(argument_condition));
    const double well_conditioned = extended ? 2 * unit_roundoff : 1e-15;
    return well_conditioned + 3.5 * working_roundoff * std::max(0.0, condition - 2);
}

void expect_exact(double omega, double sigma, double h) {
    const Definition truth = definition_of(omega, sigma, h);
    const ExactFactors factors = exact_factors(omega, sigma, h);
    const StepCoefficients step = exact_step(omega, sigma, h);
    const double allowed = allowance(truth.argument_condition);
    SCOPED_TRACE(testing::Message() << "omega h = " << omega * h << ", sigma/omega = " << sigma / omega
                                    << ", condition = " << truth.argument_condition);
    EXPECT_LE(relative_error(factors.d, truth.d), allowed);
    EXPECT_LE(relative_error(factors.s, truth.s), allowance(truth.argument_condition_of_s));
    EXPECT_LE(relative_error(step.mobility, truth.w), allowed);
    EXPECT_LE(relative_error(step.restoring, -truth.d / h), allowed);
    // e = exp(-2 sigma h): one rounding of the argument, amplified by it, and one of the exponential.
    const double smallest = std::numeric_limits<double>::min();
    if (truth.e > smallest) {
        EXPECT_LE(relative_error(factors.e, truth.e), unit_roundoff * (2 + 2 * sigma * h));
        const Real retained = Real(step.carry) + Real(step.change);
        EXPECT_LE(relative_error(static_cast<double>(retained), truth.e),
                  unit_roundoff * (3 + 2 * sigma * h));
    } else {
        EXPECT_LE(factors.e, 2 * smallest);
        EXPECT_LE(step.carry + step.change, 2 * smallest);
    }
    // The part of the step that carries small losses over millions of steps: 1 - e to full relative
    // precision.
    if (step.carry == 1 && sigma > 0) {
        EXPECT_LE(relative_error(step.change, truth.e - 1), 1e-15);
    }
}

TEST(StepCoefficients, ExactSchemeOnALogarithmicGrid) {
    const double h = 1 / 44100.0;
    for (double phase = -9; phase <= 3.001; phase += 0.125) {
        const double omega = std::pow(10.0, phase) / h;
        expect_exact(omega, 0, h);
        for (double ratio = -12; ratio <= 6.001; ratio += 0.375)
            expect_exact(omega, omega * std::pow(10.0, ratio), h);
    }
}

TEST(StepCoefficients, ExactSchemeAtRandom) {
    std::mt19937_64 generator(20180528);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const double h = std::pow(10.0, -8 + 6 * uniform(generator));
        const double omega = std::pow(10.0, -9 + 12 * uniform(generator)) / h;
        double sigma = omega * uniform(generator);
        if (i % 3 == 1) sigma = omega * std::pow(10.0, -9 + 15 * uniform(generator));
        if (i % 3 == 2)
            sigma = omega * (1 + std::pow(10.0, -16 + 15 * uniform(generator)) * (i % 2 == 0 ? 1 : -1));
        expect_exact(omega, sigma, h);
    }
}

TEST(StepCoefficients, CriticalDampingAndItsNeighbours) {
    const double h = 1 / 2016000.0;
    for (double phase = -9; phase <= 3.001; phase += 0.25) {
        const double omega = std::pow(10.0, phase) / h;
        expect_exact(omega, omega, h);
        expect_exact(omega, std::nextafter(omega, 0), h);
        expect_exact(omega, std::nextafter(omega, 2 * omega), h);
    }
}

TEST(StepCoefficients, FullTurnsAreIllConditionedButStayPositiveAndFinite) {
    // sigma = 0 and omega h = 2 pi n: d = 0 in exact arithmetic, and nothing may divide by it.
    for (int turns = 1; turns <= 159; ++turns) {
        const double phase = 2 * std::numbers::pi * turns;
        const StepCoefficients step = exact_step(phase, 0, 1);
        EXPECT_GE(step.mobility, 0);
        EXPECT_LE(step.mobility, 1e-30);
        EXPECT_EQ(step.carry + step.change, 1);
        expect_exact(phase, 0, 1);
    }
}

TEST(StepCoefficients, MobilityNeverExceedsOne) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> exponent(-9, 3);
    for (int i = 0; i < 20000; ++i) {
        const StepCoefficients step =
            exact_step(std::pow(10.0, exponent(generator)), std::pow(10.0, exponent(generator)), 1);
        EXPECT_GE(step.mobility, 0);
        EXPECT_LE(step.mobility, 1 + 1e-15);
    }
}

/// One step of v+ = v - h (2 sigma v_theta + omega^2 q_theta) + p, x_theta = theta x+ + (1-theta) x, q+ = q +
/// h v_theta, solved for v+ as the linear equation that it is.
Real theta_velocity(const Real& omega, const Real& sigma, const Real& h, const Real& theta, const Real& q,
                    const Real& v, const Real& p) {
    // q_theta = q + theta h v_theta, so v+ (1 + 2 theta sigma h + theta^2 h^2 omega^2) = right
    const Real stiffness = omega * omega;
    const Real right = v + p - h * (1 - theta) * (2 * sigma + stiffness * theta * h) * v - h * stiffness * q;
    return right / (1 + h * theta * (2 * sigma + stiffness * theta * h));
}

TEST(StepCoefficients, ThetaSchemeSolvesItsImplicitEquation) {
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 5000; ++i) {
        const double theta = i % 3 == 0 ? 0.5 : (i % 3 == 1 ? 1.0 : 0.5 + 0.5 * uniform(generator));
        const double h = std::pow(10.0, -7 + 5 * uniform(generator));
        const double omega = std::pow(10.0, -6 + 9 * uniform(generator)) / h;
        const double sigma = i % 5 == 0 ? 0 : omega * std::pow(10.0, -6 + 9 * uniform(generator));
        const StepCoefficients step = theta_step(omega, sigma, h, theta);
        EXPECT_LE(relative_error(step.mobility, theta_velocity(omega, sigma, h, theta, 0, 0, 1)), 1e-15);
        EXPECT_LE(relative_error(step.restoring, theta_velocity(omega, sigma, h, theta, 1, 0, 0)), 1.5e-15);
        // carry + change may cancel; what is added to the velocity must be right to its own size.
        const Real change = theta_velocity(omega, sigma, h, theta, 0, 1, 0) - step.carry;
        EXPECT_LE(static_cast<double>(abs(Real(step.change) - change)),
                  1.5e-15 * static_cast<double>(abs(change)) + 1e-300);
    }
}

/// (q(0) - q(-h))/h of the free motion through q0 with velocity u0, from the characteristic roots.
Real backward_velocity(double omega_in, double sigma_in, double h_in, double q0, double u0) {
    const Real omega = omega_in, sigma = sigma_in, h = h_in;
    const Real discriminant = sigma * sigma - omega * omega;
    Real before;
    if (discriminant == 0) {
        before = exp(sigma * h) * (q0 - (Real(u0) + sigma * q0) * h);
    } else if (discriminant < 0) {
        const Real W = sqrt(-discriminant);
        before = exp(sigma * h) * (q0 * cos(W * h) - (Real(u0) + sigma * q0) * sin(W * h) / W);
    } else {
        const Real r = sqrt(discriminant);
        const Real growing = (Real(u0) + (sigma + r) * q0) / (2 * r);
        before = growing * exp((sigma - r) * h) + (q0 - growing) * exp((sigma + r) * h);
    }
    return (q0 - before) / h;
}

TEST(StepCoefficients, ExactBackwardVelocity) {
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const double h = std::pow(10.0, -7 + 5 * uniform(generator));
        const double omega = std::pow(10.0, -9 + 11 * uniform(generator)) / h;
        double sigma = omega * std::pow(10.0, -6 + 9 * uniform(generator));
        if (i % 4 == 0) sigma = 0;
        if (i % 4 == 1)
            sigma = omega * (1 + std::pow(10.0, -16 + 15 * uniform(generator)) * (i % 8 == 1 ? 1 : -1));
        sigma = std::min(sigma, 300 / h);  // above 350/h the function gives up, as documented
        const double q0 = i % 3 == 0 ? 0 : 1e-3 * (uniform(generator) - 0.5);
        const double u0 = i % 3 == 1 ? 0 : 1e-3 * omega * (uniform(generator) - 0.5);
        const double value = exact_backward_velocity(omega, sigma, h, q0, u0);
        // The velocity of a mode of this amplitude is of this size, times the growth backward in time; the
        // arguments of sine and exponential are rounded before they are used, which costs in proportion to
        // them.
        const double fastest = sigma + (sigma > omega ? std::sqrt((sigma - omega) * (sigma + omega)) : 0);
        const double size = (std::abs(u0) + (omega + sigma) * std::abs(q0)) * std::exp(fastest * h);
        const double error =
            static_cast<double>(abs(Real(value) - backward_velocity(omega, sigma, h, q0, u0))) / size;
        ASSERT_LE(error, 1e-15 * (1 + fastest * h + omega * h))
            << "omega h = " << omega * h << ", sigma/omega = " << sigma / omega << ", q0 = " << q0
            << ", u0 = " << u0;
    }
}

TEST(StepCoefficients, BackwardVelocityContinuesTheFreeMotion) {
    // A free step from (q0, v) must arrive at q(h): the definition of the exact start, through the step
    // itself.
    const double h = 1 / 48000.0;
    for (const double ratio : {0.0, 1e-3, 0.5, 1.0, 3.0}) {
        for (const double phase : {1e-3, 0.1, 1.0, 3.0, 7.0}) {
            const double omega = phase / h, sigma = ratio * omega, q0 = 2e-3, u0 = -0.3 * omega * q0;
            const StepCoefficients step = exact_step(omega, sigma, h);
            const double v = exact_backward_velocity(omega, sigma, h, q0, u0);
            const double arrived = q0 + h * ((step.carry + step.change) * v + step.restoring * q0);
            // The motion h later is the one h before of time reversed motion: sigma -> -sigma, u0 -> -u0.
            const Real truth = q0 - h * backward_velocity(omega, -sigma, h, q0, -u0);
            EXPECT_NEAR(arrived, static_cast<double>(truth), 1e-13 * q0) << phase << " " << ratio;
        }
    }
}

}  // namespace
}  // namespace jawari
