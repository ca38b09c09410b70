// One track chunk of a standard MIDI file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/midi_file/byte_reader.h"
#include "formats/midi_file/midi_file.h"
#include "jawari/result.h"

namespace jawari::host {

struct MidiTrack {
    std::vector<MidiEvent> events;  ///< ticks set, times not yet
    std::vector<MidiTempo> tempos;
    std::uint64_t end_tick = 0;  ///< of End of Track
};

/// Parses the events of a track; `reader` spans the chunk's contents. `index` counts from 0.
Result<MidiTrack> parse_track(ByteReader reader, std::uint16_t index);

/// A failure at a byte offset; `track` counts from 0, negative outside tracks.
Failure midi_failure(std::size_t offset, int track, std::string value, std::string allowed);

}  // namespace jawari::host
