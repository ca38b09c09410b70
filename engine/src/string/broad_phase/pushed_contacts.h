// The impulses of a stepped frame may push contacts in that were certified before the impulses were known
// (docs/engine/certificate.md, section 5).
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Makes those contacts near, with their gaps in this step, that the impulses just found may push in. Returns
/// true if there are any: the step's impulses must then be solved again.
bool admit_pushed_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Adds what the step's impulses may move the contacts that are not near, until the frame's end, to
/// group_push.
void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
