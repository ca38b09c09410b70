// One track chunk of a standard MIDI file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/midi_file/byte_reader.h"
#include "formats/midi_file/midi_file.h"
#include "formats/midi_file/midi_reading.h"
#include "jawari/result.h"

namespace jawari::host {

struct MidiTrack {
    std::vector<MidiEvent> events;  ///< ticks set, times not yet
    std::vector<MidiTempo> tempos;
    std::uint64_t end_tick = 0;  ///< of End of Track, or of the last event
};

/// Parses the events of a track; `reader` spans the chunk's contents. `index` counts from 0. System exclusive
/// messages go to `file.exclusives`.
Result<MidiTrack> parse_track(ByteReader reader, std::uint16_t index, MidiNotes& notes, MidiFile& file);

}  // namespace jawari::host
