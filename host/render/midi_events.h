// MIDI messages -> instrument events at output frames.
#pragma once

#include <cstdint>
#include <vector>

#include "jawari/instrument_render.h"
#include "midi/midi_file.h"

namespace jawari::host {

struct TimedEvent {
    std::uint64_t frame = 0;  ///< since the start of the file
    InstrumentEvent event;    ///< its own frame is not set
};

struct MidiScore {
    std::vector<TimedEvent> events;  ///< in order of time
    std::uint64_t end_frame = 0;     ///< of the last event or end of track
    std::uint64_t pitch_bends = 0;   ///< messages off the centre, which the instrument does not follow
};

/// Note on and off, sustain (64), all sound off (120), all notes off (123 to 127) of every channel; other
/// messages are dropped.
MidiScore midi_score(const MidiFile& file, std::uint32_t rate_hz);

}  // namespace jawari::host
