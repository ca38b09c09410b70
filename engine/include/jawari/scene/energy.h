// The discrete energy of a string, and its balance over one step.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Exact scheme: H = 1/2 mu sum_k [ (1+e)/(2w) v^2 + omega^2 q (q - h v) ] with q, v at the end of a step.
/// evaluated as 1/2 mu sum_k omega^2 [ h^2 (1+e+A)/(4d) v^2 + (q - h v/2)^2 ], where nothing cancels.
/// Theta scheme: H = 1/2 mu sum_k (v^2 + omega^2 q^2). [J], >= 0. Modes with w = 0 count their potential
/// only.
double energy(const StringModel& model, const StringState& state) JAWARI_REALTIME;

}  // namespace jawari
