// What events do to courses and channels.
#pragma once

#include "jawari/instrument/render.h"

namespace jawari {

/// Events with a field out of range are ignored.
void apply_event(const InstrumentModel& model, InstrumentState& state,
                 const InstrumentEvent& event) JAWARI_REALTIME;

}  // namespace jawari
