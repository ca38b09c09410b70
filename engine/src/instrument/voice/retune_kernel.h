// All coefficients of a string at another tension, in one pass over its modes.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/instrument/model.h"

namespace jawari::kernels {

/// What changes: omega_k^2 becomes omega_k^2 + rise k^2, at most highest_omega^2.
struct Retuning {
    double rise = 0;           ///< (tau - 1) omega_1^2/(1 + B) [rad^2/s^2]
    double highest_omega = 0;  ///< [rad/s]
};

/// Fills the mode_arrays() of `bent` from those of `base`, and the growth of its bounds; takes v from the old
/// to the new backward velocity of the same true velocity; backward_q and backward_u are those of the old
/// tension and become those of the new. Overdamped modes stay as they are.
void retune(const StoppedStringModel& base, const Retuning& retuning, StringTuning& bent, double* backward_q,
            double* backward_u, const double* q, double* v) noexcept;

}  // namespace jawari::kernels
