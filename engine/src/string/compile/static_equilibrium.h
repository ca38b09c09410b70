// The shape of a string held by obstacles.
#pragma once

#include <optional>
#include <span>

#include "jawari/detail/string_model.h"

namespace jawari {

/// The part that obstacles hold: the change of q that lifts `displacement` just clear of every obstacle of
/// the model with the least potential energy, q_held = diag(1/(mu omega^2)) S^T F, 0 <= S (q + q_held) - b
/// perp  F >= 0. All zero if no gap is negative. Nothing if the obstacles contradict one another.
std::optional<AlignedVector<double>> held_displacement(const StringModel& model,
                                                       std::span<const double> displacement);

}  // namespace jawari
