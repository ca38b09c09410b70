// The energy balance of one step, measured term by term.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Adds the step just made to state.energy. Call after the displacement has advanced.
void meter_step(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Notes H at the end of a frame.
void meter_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
