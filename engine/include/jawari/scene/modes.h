// Modal frequencies and losses of a string, and its mode shapes.
#pragma once

#include <cstddef>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari {

/// One entry per mode k = 1..N.
struct Modes {
    std::vector<double> omega;  ///< undamped angular frequency 2 pi f_k [rad/s], > 0
    std::vector<double> sigma;  ///< decay rate [1/s], >= 0
};

/// Modes from physics (InharmonicityLaw, ValetteLoss, DecayTimePoints) or from
/// tables. Precondition: the description has been validated (compile() does so).
Modes modes_of(const StringDescription& string);

/// phi_k(x) = sqrt(2/L) sin(k pi x / L) [m^(-1/2)], k from 1; the argument is reduced before the sine, error
/// <= 4 ulp of sqrt(2/L) for every k up to limits::modes.
double mode_shape(std::size_t k, double x, double length_m);

/// q_k of a triangle of height h at x_p: h L^3 phi_k(x_p) / (pi^2 k^2 x_p (L - x_p)).
double pluck_coordinate(std::size_t k, const Pluck& pluck, double length_m);

}  // namespace jawari
