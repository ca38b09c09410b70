// Guitar mode: one string (or course) a channel, as MIDI guitars send.
#pragma once

#include "base/error.h"
#include "jawari/instrument/description.h"
#include "midi/interpreter.h"

namespace jawari::host {

/// The first channel (0 to 15) plays the course that is listed last, as string 1 of a guitar is its highest;
/// each next channel the course before it. Refused if the channels do not suffice.
MaybeError set_guitar_mode(const InstrumentDescription& instrument, int first_channel,
                           InterpreterSettings& settings);

}  // namespace jawari::host
