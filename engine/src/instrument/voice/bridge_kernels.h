// The loops over the modes of a body under a moving bridge, dispatched at run time.
#pragma once

#include <cstddef>

#include "jawari/instrument/model.h"

namespace jawari::kernels {

/// mean <- the mean over a frame of free motion from (y, v).
void mean_of_body(const BridgeModel& bridge, const double* y, const double* v, double* mean) noexcept;

/// What is heard of a body.
struct BodyMotion {
    double left = 0, right = 0;  ///< sum of gain v
};

/// y, v <- after a frame under held modal forces; path <- change of y.
void move_body(const BridgeModel& bridge, const double* force_N, double* y, double* v, double* path) noexcept;

/// What is heard of velocities v.
BodyMotion hear_body(const BridgeModel& bridge, const double* v) noexcept;

/// Energy of modes that move like this [J].
double energy_of_body(const BridgeModel& bridge, const double* y, const double* v) noexcept;

}  // namespace jawari::kernels
