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

/// Modes from the string's physics (InharmonicityLaw, ValetteLoss, DecayTimePoints) or from its tables.
/// Precondition: compile() accepts the description. Threads: any. Allocates.
Modes modes_of(const StringDescription& string);

/// Mode shape phi_k(x) = sqrt(2/L) sin(k pi x / L) [m^(-1/2)]. `k`: from 1; `x`: 0 to L [m]; `length_m`: L,
/// above 0 [m]. The argument is reduced before the sine; the error is at most 4 ulp of sqrt(2/L) for every k
/// up to limits::modes. Threads: any; realtime-safe.
double mode_shape(std::size_t k, double x, double length_m);

/// Its slope phi_k'(x) = sqrt(2/L) (k pi/L) cos(k pi x/L) [m^(-3/2)], as exact. Threads: any; realtime-safe.
double mode_slope(std::size_t k, double x, double length_m);

/// Modal coordinate q_k [m^(3/2)] of a triangle of height h at x_p: h L^3 phi_k(x_p) / (pi^2 k^2 x_p (L -
/// x_p)). `k`: from 1; `length_m`: L, above 0 [m]. Threads: any; realtime-safe.
double pluck_coordinate(std::size_t k, const Pluck& pluck, double length_m);

}  // namespace jawari
