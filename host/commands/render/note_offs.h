// Note-offs that a MIDI file lacks.
#pragma once

#include <vector>

#include "formats/midi_file/midi_file.h"

namespace jawari::host {

/// Note-ons whose note-off never comes, of keys that are played again: the next note of the key ends them, as
/// a re-struck string does. Without this the matching of note-offs would hold every later note of the key.
/// Returns the events, with a note-off before such notes.
std::vector<MidiEvent> with_note_offs(const std::vector<MidiEvent>& events);

}  // namespace jawari::host
