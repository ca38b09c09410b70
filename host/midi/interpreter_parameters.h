// Parameters that the host sets for the whole instrument: they replace what controllers have set so far, and
// what controllers come back to.
#pragma once

#include "midi/interpreter.h"

namespace jawari::host {

/// Of all channels, in the parameter's unit. Appends to `actions`; nothing happens if the value is out of the
/// parameter's range. Threads: one at a time per interpreter; realtime-safe.
void set_parameter(MidiInterpreter& interpreter, ParameterId parameter, double value,
                   MidiActions& actions) JAWARI_REALTIME;

}  // namespace jawari::host
