// Ticks of a MIDI file as exact times, and the order of its events.
#pragma once

#include <cstdint>
#include <optional>

#include "formats/midi_file/midi_file.h"

namespace jawari::host {

/// How ticks become exact times.
struct TimeBase {
    std::uint64_t units_per_s = 0;
    std::uint64_t units_per_tick = 0;  ///< SMPTE; 0: the tempo in microseconds per quarter note
};

/// Of the header's division. Nothing for 0 ticks; `any_rate`: also for frames per second that SMPTE lacks.
std::optional<TimeBase> time_base(std::uint16_t division, bool any_rate);

/// Puts events and tempos, appended track by track, in order, and fills the times in.
std::optional<Failure> assign_times(MidiFile& file, TimeBase base, std::uint64_t end_tick, MidiNotes& notes);

}  // namespace jawari::host
