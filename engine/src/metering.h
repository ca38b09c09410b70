// The energy balance of one step, measured term by term.
#pragma once

#include "jawari/model.h"
#include "jawari/realtime.h"
#include "jawari/state.h"

namespace jawari {

/// Adds the step just made to state.energy. Call after the displacement has advanced and before accept_gaps(): gap_before and
/// height_before are then two steps old relative to the new gap, as the balance needs.
void meter_step(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Notes H at the end of a frame.
void meter_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
