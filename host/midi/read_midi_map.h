// MIDI map files ("jawari.midi-map/1", docs/formats/midi.md): which controller moves which parameter.
#pragma once

#include <string>

#include "base/error.h"
#include "midi/midi_map.h"

namespace jawari::host {

/// The default map, with the bindings of the file instead of the defaults of the same controls. Every problem
/// names `file`, the path inside it, the value and what is allowed.
Outcome<MidiMap> read_midi_map(const std::string& text, const std::string& file);

Outcome<MidiMap> load_midi_map(const std::string& path);

}  // namespace jawari::host
