#include "jawari/detail/step_coefficients.h"

#include <cmath>

namespace jawari {
namespace {

/// Coefficients are computed in more digits than they are kept in: a flight's own rounding, repeated over the
/// 200 000 frames of ten seconds, is what limits free motion to 1e-12. Where long double is no wider than
/// double the same formulas hold, with errors up to four times as large (docs/engine/accuracy.md).
using Extended = long double;

template <class Number>
Number square(Number x) {
    return x * x;
}

double rounded(Extended x) {
    return static_cast<double>(x);
}

/// v_free = e v + restoring q, written so that nothing cancels: v + expm1(-2 sigma h) v for light losses, e v
/// for heavy ones.
void set_retained_velocity(StepCoefficients& step, double e, double e_minus_one) {
    step.carry = e > 0.5 ? 1 : 0;
    step.change = e > 0.5 ? e_minus_one : e;
}

struct ExtendedFactors {
    Extended d = 0;
    Extended e = 1;
    Extended s = 4;
};

ExtendedFactors extended_factors(Extended omega, Extended sigma, Extended h) {
    ExtendedFactors factors;
    factors.e = std::exp(-2 * sigma * h);
    if (sigma <= omega) {
        const Extended W = std::sqrt((omega - sigma) * (omega + sigma));
        const Extended loss = square(std::expm1(-sigma * h));
        const Extended turn = 4 * std::exp(-sigma * h);
        factors.d = loss + turn * square(std::sin(W * h / 2));
        factors.s = loss + turn * square(std::cos(W * h / 2));
    } else {
        const Extended r = std::sqrt((sigma - omega) * (sigma + omega));
        const Extended slow = -omega * omega * h / (sigma + r);
        const Extended fast = -(sigma + r) * h;
        factors.d = std::expm1(slow) * std::expm1(fast);
        factors.s = (1 + std::exp(slow)) * (1 + std::exp(fast));
    }
    return factors;
}

/// w = d/(omega h)^2, and its limit where nothing holds the mode: the mean of exp(-2 sigma t) over the step.
Extended mobility(Extended omega, Extended sigma, Extended h, Extended d) {
    if (omega > 0) return d / square(omega * h);
    return sigma > 0 ? -std::expm1(-2 * sigma * h) / (2 * sigma * h) : 1;
}

}  // namespace

ExactFactors exact_factors(double omega, double sigma, double h) {
    const ExtendedFactors factors = extended_factors(omega, sigma, h);
    return {rounded(factors.d), rounded(factors.e), rounded(factors.s)};
}

StepCoefficients exact_step(double omega, double sigma, double h) {
    const ExtendedFactors factors = extended_factors(omega, sigma, h);
    StepCoefficients step;
    set_retained_velocity(step, rounded(factors.e), rounded(std::expm1(-2 * Extended(sigma) * h)));
    step.restoring = rounded(-factors.d / h);
    step.mobility = rounded(mobility(omega, sigma, h, factors.d));
    return step;
}

namespace {

/// psi_m by its recurrence psi_{n+1} = A psi_n - e psi_{n-1}, for angles near a multiple of pi where the
/// quotient of sines fails.
Extended psi_by_recurrence(Extended A, Extended e, std::size_t m) {
    Extended before = 0;
    Extended now = 1;
    for (std::size_t n = 1; n < m; ++n) {
        const Extended after = A * now - e * before;
        before = now;
        now = after;
    }
    return now;
}

struct FreeMotion {
    Extended psi = 1;                   ///< psi_m
    Extended half_trace_minus_one = 0;  ///< trace(P^m)/2 - 1
};

FreeMotion free_motion(Extended omega, Extended sigma, Extended h, std::size_t m) {
    const Extended steps = static_cast<Extended>(m);
    const Extended t = steps * h;
    const Extended decay_between = std::exp(-sigma * (steps - 1) * h);
    FreeMotion motion;
    if (sigma <= omega) {
        const Extended W = std::sqrt((omega - sigma) * (omega + sigma));
        const Extended angle = W * h;
        const Extended half_turn = std::sin(W * t / 2);
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
    const Extended r = std::sqrt((sigma - omega) * (sigma + omega));
    const Extended slow = omega * omega / (sigma + r);
    motion.half_trace_minus_one = (std::expm1(-slow * t) + std::expm1(-(sigma + r) * t)) / 2;
    motion.psi = std::exp(-slow * (t - h)) * std::expm1(-2 * r * t) / std::expm1(-2 * r * h);
    return motion;
}

}  // namespace

FlightFactors flight_factors(double omega, double sigma, double h, std::size_t m) {
    const ExtendedFactors factors = extended_factors(omega, sigma, h);
    const FreeMotion motion = free_motion(omega, sigma, h, m);
    const Extended half_difference = motion.psi * (-std::expm1(-2 * Extended(sigma) * h) - factors.d) / 2;
    FlightFactors flight;
    flight.qq = rounded(motion.half_trace_minus_one + half_difference);
    flight.vv = rounded(motion.half_trace_minus_one - half_difference);
    flight.qv = rounded(h * factors.e * motion.psi);
    flight.vq = rounded(-factors.d / h * motion.psi);

    const ExactFactors step = exact_factors(omega, sigma, h);
    // Responses to a force by stepping once through the frame.
    const double impulse =
        omega > 0 ? h * step.d / square(omega * h) : h * exact_step(omega, sigma, h).mobility;
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

double exact_backward_velocity(double omega_in, double sigma_in, double h_in, double q0, double u0) {
    if (sigma_in * h_in > 350) return 0;
    const Extended omega = omega_in, sigma = sigma_in, h = h_in;
    if (sigma <= omega) {
        // q0 - q(-h) = q0 (1 - e^{sigma h} cos W h) + (u0 + sigma q0) e^{sigma h} sin(W h)/W
        const Extended W = std::sqrt((omega - sigma) * (omega + sigma));
        const Extended growth = std::exp(sigma * h);
        const Extended one_minus_cosine = 2 * square(std::sin(W * h / 2));
        const Extended sine_over_W = W * h < 1e-8 ? h : std::sin(W * h) / W;
        const Extended displacement_part = growth * one_minus_cosine - std::expm1(sigma * h);
        return rounded((displacement_part * q0 + growth * sine_over_W * (u0 + sigma * q0)) / h);
    }
    // Roots -slow and -fast of the characteristic equation; q(t) = a e^{-slow t} + b e^{-fast t}.
    const Extended r = std::sqrt((sigma - omega) * (sigma + omega));
    const Extended fast = sigma + r;
    const Extended slow = omega * omega / fast;
    // With slow and fast close together the two exponentials nearly coincide: sinh(r h)/r stays exact.
    const Extended growth = std::exp(sigma * h);
    const Extended sinh_over_r = r * h < 1e-8 ? h : std::sinh(r * h) / r;
    if (r * h < 1) {
        const Extended cosh_minus_one = 2 * square(std::sinh(r * h / 2));
        const Extended displacement_part = -growth * cosh_minus_one - std::expm1(sigma * h);
        return rounded((displacement_part * q0 + growth * sinh_over_r * (u0 + sigma * q0)) / h);
    }
    const Extended b = -(u0 + slow * q0) / (fast - slow);
    const Extended a = q0 - b;
    return rounded((-a * std::expm1(slow * h) - b * std::expm1(fast * h)) / h);
}

}  // namespace jawari
