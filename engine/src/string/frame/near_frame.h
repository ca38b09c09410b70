// A frame in contact space: the free gap rates of the near contacts come from one run over the modes, their
// impulses from a causal loop over the contacts alone, and the modes receive the impulses in a second run.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// The frame with the contacts in state.contact.near, from the state at its start. displacement_flown,
/// velocity_flown hold its end in free flight and receive its end with impulses. Returns true if impulses
/// happened.
bool solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
