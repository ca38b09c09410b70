// Other ways to compute the exact scheme's coefficients and to step with them: rivals in the accuracy tables,
// not in the engine.
#pragma once

#include <cmath>
#include <complex>

namespace jawari::rivals {

/// w = 1/W_kk as Siconos computes it (MoreauJeanBilbaoOSI::compute_parameters, unit mass):
///     A = e^{-sigma h} (e^{h sqrt(sigma^2 - omega^2)} + e^{-h sqrt(sigma^2 - omega^2)}), complex;   e =
///     e^{-2 sigma h} 1 - gamma = 1 - 2/(omega h)^2 + A/(1 + e - A),   h sigma* = (1-e)/(1+e) (1 + (omega
///     h)^2 (1-gamma)/2) W = 1 + (omega h)^2 (1-gamma)/2 + h sigma*
inline double mobility_by_source(double omega, double sigma, double h) {
    const double decay = std::exp(-sigma * h);
    const std::complex<double> root = std::sqrt(std::complex<double>(sigma * sigma - omega * omega)) * h;
    const double A = std::real(decay * (std::exp(root) + std::exp(-root)));
    const double e = decay * decay;
    const double phase_square = omega * omega * h * h;
    const double one_minus_gamma = 1.0 - 2.0 / phase_square + A / (1.0 + e - A);
    const double h_sigma_star = (1.0 - e) / (1.0 + e) * (1.0 + 0.5 * phase_square * one_minus_gamma);
    return 1.0 / (1.0 + 0.5 * phase_square * one_minus_gamma + h_sigma_star);
}

/// w = (1 + e - A)/(omega h)^2, subtracted as it stands.
inline double mobility_by_difference(double omega, double sigma, double h) {
    const double e = std::exp(-2 * sigma * h);
    double A = 0;
    if (sigma <= omega) {
        A = 2 * std::exp(-sigma * h) * std::cos(std::sqrt(omega * omega - sigma * sigma) * h);
    } else {
        const double r = std::sqrt(sigma * sigma - omega * omega);
        A = std::exp((r - sigma) * h) + std::exp(-(r + sigma) * h);
    }
    return (1 + e - A) / (omega * omega * h * h);
}

/// The source's Taylor expansion of 1/W_kk up to h^7 (Siconos, "Time integration of the dynamics - Exact
/// scheme").
inline double mobility_by_taylor(double omega, double sigma, double h) {
    const double o = omega * omega * h * h;  // (omega h)^2
    const double s = sigma * h;
    const double s2 = s * s, s3 = s2 * s, s4 = s2 * s2, s5 = s4 * s, s6 = s3 * s3, s7 = s6 * s;
    return 1 - s + (-o / 12 + 2 * s2 / 3) + (o * s / 12 - s3 / 3) +
           (o * o / 360 - o * s2 / 20 + 2 * s4 / 15) + (-o * o * s / 360 + o * s3 / 45 - 2 * s5 / 45) +
           (-o * o * o / 20160 + o * o * s2 / 630 - o * s4 / 126 + 4 * s6 / 315) +
           (o * o * o * s / 20160 - o * o * s3 / 1512 + o * s5 / 420 - s7 / 315);
}

}  // namespace jawari::rivals
