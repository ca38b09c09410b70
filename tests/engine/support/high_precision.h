// The exact scheme's coefficients from their definitions, in 100-digit arithmetic: the oracle of
// step_coefficients.
#pragma once

#include "support/multiprecision.h"

namespace jawari::test {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// q(t+h) = A q(t) - e q(t-h), A = z1 + z2, e = z1 z2, where z = exp(s h) for the two roots s of s^2 + 2
/// sigma s + omega^2. One hundred digits make the cancellation in d = 1 + e - A harmless: at omega h = 1e-9
/// it costs 18 of them.
struct Definition {
    Real A, e, d, w;
    Real s;             ///< 1 + e + A
    Real damped_phase;  ///< W h, 0 when overdamped
    /// d ln d / d ln(W h): by how much an error of the sine's argument is amplified; 0 when overdamped.
    Real argument_condition;
    Real argument_condition_of_s;  ///< the same for s
};

inline Definition definition_of(double omega_in, double sigma_in, double h_in) {
    using boost::multiprecision::cos, boost::multiprecision::exp, boost::multiprecision::sin,
        boost::multiprecision::sqrt;
    const Real omega = omega_in, sigma = sigma_in, h = h_in;
    const Real discriminant = sigma * sigma - omega * omega;
    Definition result;
    result.e = exp(-2 * sigma * h);
    if (discriminant > 0) {
        const Real r = sqrt(discriminant);
        result.A = exp((r - sigma) * h) + exp((-r - sigma) * h);
    } else {
        result.damped_phase = sqrt(-discriminant) * h;
        result.A = 2 * exp(-sigma * h) * cos(result.damped_phase);
    }
    result.d = 1 + result.e - result.A;
    result.s = 1 + result.e + result.A;
    result.w = result.d / (omega * omega * h * h);
    if (result.damped_phase > 0 && result.d > 0 && result.s > 0) {
        const Real slope = 2 * exp(-sigma * h) * result.damped_phase * sin(result.damped_phase);
        result.argument_condition = slope / result.d;
        result.argument_condition_of_s = -slope / result.s;
    }
    return result;
}

}  // namespace jawari::test
