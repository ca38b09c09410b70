// Open strings that nobody plays, on a bridge that moves: when they begin to answer, and who damps them.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Every control_frames: idle strings begin to answer while the bridge drives them, and what answers is
/// damped as the bridge and the pedal say. Precondition: bridge_moves(model).
void follow_answers(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
