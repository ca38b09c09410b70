// One contact step of a frame that is stepped through.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// step() of scene/render.h with the near contacts alone; their gaps must hold at the step's start.
void step_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
