// A frame solved in contact space. One run over the modes computes the free gap rates of the near contacts, a
// loop over the steps solves for their impulses, and a second run over the modes applies the impulses.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Solves the frame with the contacts in state.contact.near from the state at its start. displacement_flown,
/// velocity_flown hold its end in free flight and receive its end with impulses. Returns true if impulses
/// happened.
bool solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
