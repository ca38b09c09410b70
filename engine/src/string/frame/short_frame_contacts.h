// The contacts of a short frame: all gaps side by side, one complementarity problem a step.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

namespace jawari::kernels {

/// Solves the steps of a frame whose free rates are in short_frame.rates, from contact.gap and
/// contact.gap_before at its start to those at its end; short_frame.impulses and `struck` <- its impulses.
/// Signorini's law. Returns false if a gap is not finite.
bool solve_steps(const StringModel& model, StringState& state) noexcept;

}  // namespace jawari::kernels
