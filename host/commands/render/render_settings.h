// What the options of a rendering mean for the reading of its MIDI files.
#pragma once

#include "base/error.h"
#include "commands/render/options.h"
#include "commands/render/score.h"
#include "instrument/instrument_cache.h"

namespace jawari::host {

/// The preset of the options is loaded, unless programs choose presets. Reads the map's file, if there is
/// one.
Outcome<ScoreRules> score_rules(const RenderOptions& options, const InstrumentSettings& instruments);

/// The same with an instrument that is loaded already; null: programs choose presets.
Outcome<ScoreRules> score_rules(const RenderOptions& options, const InstrumentDescription* instrument);

}  // namespace jawari::host
