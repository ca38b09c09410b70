// What the impulses of a stepped frame do to contacts that were certified before them
// (docs/engine/certificate.md, section 5).
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// True if the impulses just found may reach contacts that are not near; they are then near, with their gaps
/// in this step, and the step's impulses must be found again.
bool admit_pushed_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Charges the step's impulses to the margins of the other contacts, for the rest of the frame.
void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
