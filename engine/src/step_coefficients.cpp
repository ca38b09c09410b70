#include "jawari/step_coefficients.h"

#include <cmath>

namespace jawari {
namespace {

double square(double x) { return x * x; }

/// v_free = e v + restoring q, written so that nothing cancels: v + expm1(-2 sigma h) v for light losses, e v for heavy ones.
void set_retained_velocity(StepCoefficients& step, double e, double e_minus_one) {
    step.carry = e > 0.5 ? 1 : 0;
    step.change = e > 0.5 ? e_minus_one : e;
}

}  // namespace

ExactFactors exact_factors(double omega, double sigma, double h) {
    ExactFactors factors;
    factors.e = std::exp(-2 * sigma * h);
    if (sigma <= omega) {
        const double W = std::sqrt((omega - sigma) * (omega + sigma));
        factors.d = square(std::expm1(-sigma * h)) + 4 * std::exp(-sigma * h) * square(std::sin(W * h / 2));
    } else {
        const double r = std::sqrt((sigma - omega) * (sigma + omega));
        factors.d = std::expm1(-omega * omega * h / (sigma + r)) * std::expm1(-(sigma + r) * h);
    }
    return factors;
}

StepCoefficients exact_step(double omega, double sigma, double h) {
    const ExactFactors factors = exact_factors(omega, sigma, h);
    StepCoefficients step;
    set_retained_velocity(step, factors.e, std::expm1(-2 * sigma * h));
    step.restoring = -factors.d / h;
    step.mobility = factors.d / square(omega * h);
    return step;
}

StepCoefficients theta_step(double omega, double sigma, double h, double theta) {
    const double damping = 2 * sigma * h;
    const double stiffness = square(omega * h);
    StepCoefficients step;
    step.mobility = 1 / (1 + theta * damping + square(theta) * stiffness);
    step.carry = 1;
    step.change = -step.mobility * (damping + theta * stiffness);
    step.restoring = -step.mobility * omega * omega * h;
    return step;
}

double exact_backward_velocity(double omega, double sigma, double h, double q0, double u0) {
    if (sigma * h > 350) return 0;
    if (sigma <= omega) {
        // q0 - q(-h) = q0 (1 - e^{sigma h} cos W h) + (u0 + sigma q0) e^{sigma h} sin(W h)/W
        const double W = std::sqrt((omega - sigma) * (omega + sigma));
        const double growth = std::exp(sigma * h);
        const double one_minus_cosine = 2 * square(std::sin(W * h / 2));
        const double sine_over_W = W * h < 1e-8 ? h : std::sin(W * h) / W;
        const double displacement_part = growth * one_minus_cosine - std::expm1(sigma * h);
        return (displacement_part * q0 + growth * sine_over_W * (u0 + sigma * q0)) / h;
    }
    // Roots -slow and -fast of the characteristic equation; q(t) = a e^{-slow t} + b e^{-fast t}.
    const double r = std::sqrt((sigma - omega) * (sigma + omega));
    const double fast = sigma + r;
    const double slow = omega * omega / fast;
    // With slow and fast close together the two exponentials nearly coincide: sinh(r h)/r stays exact.
    const double growth = std::exp(sigma * h);
    const double sinh_over_r = r * h < 1e-8 ? h : std::sinh(r * h) / r;
    if (r * h < 1) {
        const double cosh_minus_one = 2 * square(std::sinh(r * h / 2));
        const double displacement_part = -growth * cosh_minus_one - std::expm1(sigma * h);
        return (displacement_part * q0 + growth * sinh_over_r * (u0 + sigma * q0)) / h;
    }
    const double b = -(u0 + slow * q0) / (fast - slow);
    const double a = q0 - b;
    return (-a * std::expm1(slow * h) - b * std::expm1(fast * h)) / h;
}

}  // namespace jawari
