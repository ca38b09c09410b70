// What events do to courses and channels.
#pragma once

#include <span>

#include "jawari/instrument/render.h"

namespace jawari {

/// Events of one frame, in their order. Those with a field out of range are ignored.
void apply_events(const InstrumentModel& model, InstrumentState& state,
                  std::span<const InstrumentEvent> events) JAWARI_REALTIME;

}  // namespace jawari
