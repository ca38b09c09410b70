// Coefficients of one time step of one mode, for the exact and the theta scheme.
#pragma once

#include <cstddef>

namespace jawari {

/// Coefficients of a step of one mode, in backward velocities: v_free = carry v + change v + restoring q, v+
/// = v_free + mobility/mu * S^T lambda,   q+ = q + h (theta v+ + (1-theta) v).
struct StepCoefficients {
    /// 1, or 0 for modes that lose more than half their velocity in a step (nothing cancels then).
    double carry = 1;
    double change = 0;     ///< carry + change = e for the exact scheme
    double restoring = 0;  ///< -d/h for the exact scheme [1/s]
    double mobility = 1;   ///< w, in (0, 1] for the exact scheme up to omega h = pi, >= 0 always
};

/// The numbers that the exact step is made of.
struct ExactFactors {
    double d = 0;  ///< 1 + e - A, where q(t+h) = A q(t) - e q(t-h)
    double e = 1;  ///< exp(-2 sigma h)
    double s = 4;  ///< 1 + e + A
};

/// Computes d, e and s without the cancellation of 1 + e -+ A. omega >= 0 [rad/s], sigma >= 0 [1/s], h > 0
/// [s]. Relative error <= 4e-16 except where the argument of the sine is itself ill conditioned: near W h = 2
/// pi n, where an error of half an ulp in W h costs W h eps / |tan(W h/2)| (docs/engine/accuracy.md).
/// Threads: any; realtime-safe.
ExactFactors exact_factors(double omega, double sigma, double h);

/// A step of the exact scheme ("Modal-Moreau-Jean", Issanchou et al. 2018; Siconos, MoreauJeanBilbaoOSI).
/// omega >= 0 [rad/s], sigma >= 0 [1/s], h > 0 [s]. Threads: any; realtime-safe.
StepCoefficients exact_step(double omega, double sigma, double h);

/// P^m - I for m steps of free motion, and what a force does meanwhile.
struct FlightFactors {
    double qq = 0;                  ///< of P^m - I: q from q
    double qv = 0;                  ///< of P^m - I: q from v [s]
    double vq = 0;                  ///< of P^m - I: v from q [1/s]
    double vv = 0;                  ///< of P^m - I: v from v
    double q_held = 0, v_held = 0;  ///< sum over n = 1..m of the response to an impulse h w at step n
    double q_ramp = 0, v_ramp = 0;  ///< sum over n of (n - 1) times that response
};

/// m steps of free motion of the exact scheme in closed form: P^m = psi_m P - e psi_{m-1} I with psi_m =
/// exp(-sigma (m-1) h) sin(m W h)/sin(W h) (Cayley-Hamilton). omega >= 0 [rad/s], sigma >= 0 [1/s], h > 0
/// [s]. Threads: any; realtime-safe.
FlightFactors flight_factors(double omega, double sigma, double h, std::size_t m);

/// A step of the theta scheme (Siconos, MoreauJeanOSI): w' = 1/(1 + 2 theta sigma h + theta^2 omega^2 h^2).
/// omega >= 0 [rad/s], sigma >= 0 [1/s], h > 0 [s], theta from 1/2 to 1. Threads: any; realtime-safe.
StepCoefficients theta_step(double omega, double sigma, double h, double theta);

/// Backward velocity (q0 - q(-h))/h of the free motion that passes q0 [m^(3/2)] with true velocity u0 at t =
/// 0 [m^(3/2)/s]. Zero if sigma h > 350, where the motion before t = 0 cannot be represented and no longer
/// matters. Threads: any; realtime-safe.
double exact_backward_velocity(double omega, double sigma, double h, double q0, double u0);

}  // namespace jawari
