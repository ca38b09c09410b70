#include "jawari/step_coefficients.h"

#include <cmath>

namespace jawari {
namespace {

double square(double x) {
    return x * x;
}

/// v_free = e v + restoring q, written so that nothing cancels: v + expm1(-2 sigma h) v for light losses, e v
/// for heavy ones.
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
        const double loss = square(std::expm1(-sigma * h));
        const double turn = 4 * std::exp(-sigma * h);
        factors.d = loss + turn * square(std::sin(W * h / 2));
        factors.s = loss + turn * square(std::cos(W * h / 2));
    } else {
        const double r = std::sqrt((sigma - omega) * (sigma + omega));
        const double slow = -omega * omega * h / (sigma + r);
        const double fast = -(sigma + r) * h;
        factors.d = std::expm1(slow) * std::expm1(fast);
        factors.s = (1 + std::exp(slow)) * (1 + std::exp(fast));
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

namespace {

/// psi_m by its recurrence psi_{n+1} = A psi_n - e psi_{n-1}, for angles near a multiple of pi where the
/// quotient of sines fails.
double psi_by_recurrence(double A, double e, std::size_t m) {
    double before = 0;
    double now = 1;
    for (std::size_t n = 1; n < m; ++n) {
        const double after = A * now - e * before;
        before = now;
        now = after;
    }
    return now;
}

struct FreeMotion {
    double psi = 1;                   ///< psi_m
    double half_trace_minus_one = 0;  ///< trace(P^m)/2 - 1
};

FreeMotion free_motion(double omega, double sigma, double h, std::size_t m) {
    const double steps = static_cast<double>(m);
    const double t = steps * h;
    const double decay_between = std::exp(-sigma * (steps - 1) * h);
    FreeMotion motion;
    if (sigma <= omega) {
        const double W = std::sqrt((omega - sigma) * (omega + sigma));
        const double angle = W * h;
        const double half_turn = std::sin(W * t / 2);
        motion.half_trace_minus_one = std::expm1(-sigma * t) - 2 * std::exp(-sigma * t) * square(half_turn);
        if (angle == 0) {
            motion.psi = steps * decay_between;
        } else if (angle < 1 || std::abs(std::sin(angle)) > 0.1) {
            motion.psi = decay_between * std::sin(W * t) / std::sin(angle);
        } else {
            motion.psi =
                psi_by_recurrence(2 * std::exp(-sigma * h) * std::cos(angle), std::exp(-2 * sigma * h), m);
        }
        return motion;
    }
    const double r = std::sqrt((sigma - omega) * (sigma + omega));
    const double slow = omega * omega / (sigma + r);
    motion.half_trace_minus_one = (std::expm1(-slow * t) + std::expm1(-(sigma + r) * t)) / 2;
    motion.psi = std::exp(-slow * (t - h)) * std::expm1(-2 * r * t) / std::expm1(-2 * r * h);
    return motion;
}

}  // namespace

FlightFactors flight_factors(double omega, double sigma, double h, std::size_t m) {
    const ExactFactors step = exact_factors(omega, sigma, h);
    const FreeMotion motion = free_motion(omega, sigma, h, m);
    const double half_difference = motion.psi * (-std::expm1(-2 * sigma * h) - step.d) / 2;
    FlightFactors flight;
    flight.qq = motion.half_trace_minus_one + half_difference;
    flight.vv = motion.half_trace_minus_one - half_difference;
    flight.qv = h * step.e * motion.psi;
    flight.vq = -step.d / h * motion.psi;

    // Responses to a force by stepping once through the frame.
    const double impulse = h * step.d / square(omega * h);
    double q_held = 0, v_held = 0, q_ramp = 0, v_ramp = 0;
    for (std::size_t n = 0; n < m; ++n) {
        v_held = step.e * v_held - step.d / h * q_held + impulse;
        q_held += h * v_held;
        v_ramp = step.e * v_ramp - step.d / h * q_ramp + static_cast<double>(n) * impulse;
        q_ramp += h * v_ramp;
    }
    flight.q_held = q_held;
    flight.v_held = v_held;
    flight.q_ramp = q_ramp;
    flight.v_ramp = v_ramp;
    return flight;
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
