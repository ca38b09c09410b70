// What a string of energy H can do at most at a place: the bounds of outputs, gaps and speeds.
#pragma once

#include <span>

#include "jawari/detail/string_model.h"

namespace jawari::stress {

/// A row r of mode shapes against H = sum_k kin_k v_k^2 + pot_k (q_k - lag v_k)^2, lag = h/2 (exact scheme)
/// or 0 (theta). By the inequality of Cauchy and Schwarz, with q = (q - lag v) + lag v,
///     |r . v| <= sqrt(H sum r_k^2/kin_k),    |r . q| <= sqrt(H sum r_k^2 (1/pot_k + lag^2/kin_k)),
///     |r . (q - lag v)| <= sqrt(H sum r_k^2/pot_k).
/// For h -> 0 the second is sqrt(2 H C) with C = sum r_k^2/(mu omega_k^2), the static compliance. Infinite
/// where H does not see a mode (w = 0).
struct Reach {
    double speed = 0;   ///< |r . v| / sqrt(H)
    double extent = 0;  ///< |r . q| / sqrt(H)
    double middle = 0;  ///< |r . (q - lag v)| / sqrt(H)
};

Reach reach_of(const StringModel& model, std::span<const double> row);

/// The lag of H above [s].
double lag_of(const StringModel& model);

/// reach sqrt(H); infinite where reach is, whatever H.
double bound_of(double reach, double energy_J);

/// Rounding of H in one step, as a multiple of eps H: an error eps (|q| + h |v|) of a mode's displacement and
/// eps |v| of its velocity change H by at most eps H (1 + (1 + x) (sqrt(1 + x^2/4) + x)), x = h
/// sqrt(pot/kin), to first order; x grows without limit near odd multiples of the step's Nyquist rate, where
/// H loses its hold on q.
double rounding_share(const StringModel& model);

/// Size of a velocity's change by an impulse of 1 N s on the row, in the norm sqrt(H).
double kick_of(const StringModel& model, std::span<const double> row);

/// phi_k(x), padded.
AlignedVector<double> shape_row(const StringModel& model, double x);

}  // namespace jawari::stress
