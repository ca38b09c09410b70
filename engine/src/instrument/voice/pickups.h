// From a voice's modes to the signals of pickups and the force on the bridge.
#pragma once

#include "jawari/detail/string_state.h"
#include "jawari/instrument/model.h"
#include "jawari/realtime.h"

namespace jawari {

/// Fills pickup_rows, bridge_row and their values at rest.
void set_output_rows(StoppedStringModel& stopped, const InstrumentDescription& instrument,
                     double output_rate_hz);

/// The sum of the pickups, at `mix` (parameter pickup_mix) [output before the string's level].
double pickup_signal(const InstrumentModel& model, const StoppedStringModel& stopped,
                     const StringState& string, double mix) JAWARI_REALTIME;

/// What the string exerts on the bridge beyond its rest [N].
double bridge_force(const StoppedStringModel& stopped, const StringState& string) JAWARI_REALTIME;

}  // namespace jawari
