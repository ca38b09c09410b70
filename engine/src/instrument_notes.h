// Which string and voice a note takes, and what events do to them. The rules are those of
// instrument_render.h.
#pragma once

#include "jawari/instrument_render.h"

namespace jawari {

void apply_event(const InstrumentModel& model, InstrumentState& state,
                 const InstrumentEvent& event) JAWARI_REALTIME;

/// Starts notes that wait for a voice, where one has become idle.
void start_pending_notes(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
