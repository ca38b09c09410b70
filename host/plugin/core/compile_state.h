// From a plugin's state to an instrument that can play.
#pragma once

#include "base/error.h"
#include "instrument/instrument_cache.h"
#include "midi/interpreter.h"
#include "plugin/core/plugin_state.h"

namespace jawari::host {

struct CompiledState {
    SharedInstrument instrument;
    InterpreterSettings interpreter;
};

/// Reads the texts inside the state and compiles its preset, tuned, at `quality` and `rate_hz` (8000 to 1e6
/// [Hz]). A problem names the part of the state, the place in it, the value and what is allowed. Threads:
/// any.
Outcome<CompiledState> compile_state(const PluginState& state, Quality quality, double rate_hz);

/// Whether both compile to the same instrument and interpreter, quality and rate aside.
bool compile_alike(const PluginState& a, const PluginState& b);

}  // namespace jawari::host
