// The impulses of a frame may push contacts in that were certified before the impulses were known
// (docs/engine/certificate.md, section 5).
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Of a stepped frame. True if the impulses just found may reach contacts that are not near; they are then
/// near, with their gaps in this step, and the step's impulses must be found again.
bool admit_pushed_in_step(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Of a stepped frame: charges the step's impulses to the margins of the other contacts, for the rest of it.
/// Precondition: admit_pushed_in_step() was the last to ask about them.
void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Of a frame solved in contact space. True if its impulses may have reached contacts that are not near; they
/// are then near, and the frame must be solved again from its start.
bool admit_pushed_in_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
