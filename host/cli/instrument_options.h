// How the instruments of a command sound and what they make of MIDI: what `jawari render` and `jawari play`
// ask alike.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file_plan.h"
#include "instrument/instrument_cache.h"
#include "instrument/quality.h"
#include "jawari/parameters.h"
#include "midi/interpreter.h"

namespace CLI {
class App;
}

namespace jawari::host {

/// Nothing: not said.
struct InstrumentOptions {
    std::optional<Quality> quality;           ///< else live
    std::optional<double> gain_db;            ///< relative to the preset, else 0
    std::optional<double> limiter_dbfs;       ///< else no limiter
    std::optional<std::string> tuning;        ///< a .scl, .ascl or .tun file, else as the presets are tuned
    std::optional<std::string> keyboard_map;  ///< a .kbm file, else the default map
    std::optional<bool> move_frets;           ///< to the notes of the tuning, else not
    std::optional<std::string> midi_map;      ///< JSON, else the default map
    std::optional<int> guitar_channel;        ///< 1 to 16, else as the preset says
    std::vector<std::pair<ParameterId, double>> parameters;  ///< at the start, in each parameter's unit
};

/// `limiter`: what --limiter says of itself.
void add_instrument_options(CLI::App& app, InstrumentOptions& options, const std::string& limiter);

/// The first option that asks for another one which is not there. `programs_choose`: no preset is named.
MaybeError check_dependencies(const InstrumentOptions& options, bool programs_choose);

/// The files that the options name.
void add_inputs(const InstrumentOptions& options, FilePlan& files);

/// Reads the tuning's files, if there are any.
Outcome<InstrumentSettings> instrument_settings(const InstrumentOptions& options, double rate_hz);

/// Parameters at the start; reads the map's file, if there is one.
MaybeError set_interpreter(const InstrumentOptions& options, InterpreterSettings& settings);

/// The parameters that the engine reads; the bend range belongs to the interpreter.
std::vector<std::pair<ParameterId, double>> engine_parameters(const InstrumentOptions& options);

/// The first channel of guitar mode, from 1; 0: none.
int guitar_channel(const InstrumentOptions& options, const InstrumentDescription& instrument);

}  // namespace jawari::host
