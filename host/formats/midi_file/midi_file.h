// Standard MIDI files (types 0 and 1), parsed whole and strictly: "Standard MIDI Files 1.0", MIDI
// Manufacturers Association, 1988.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "jawari/result.h"

namespace jawari::host {

/// A channel message. System exclusive and meta events carry no sound and are not kept; tempo changes are in
/// MidiFile::tempos.
struct MidiEvent {
    std::uint64_t tick = 0;   ///< since the start of the file, in the file's division
    std::uint64_t time = 0;   ///< exact, in units of 1/MidiFile::time_units_per_s s
    std::uint16_t track = 0;  ///< 0 is the first
    std::uint8_t status = 0;  ///< 0x80 to 0xEF: message type in the high, channel in the low four bits
    std::uint8_t data1 = 0;   ///< 0 to 127
    std::uint8_t data2 = 0;   ///< 0 to 127; 0 for program change and channel pressure
};

struct MidiTempo {
    std::uint64_t tick = 0;
    std::uint16_t track = 0;
    std::uint32_t us_per_quarter = 500000;  ///< 1 to 2^24 - 1
};

struct MidiFile {
    std::uint16_t format = 0;  ///< 0 or 1
    std::uint16_t track_count = 0;
    std::uint16_t division = 0;  ///< as in the file: ticks per quarter note, or SMPTE if bit 15 is set
    std::uint64_t time_units_per_s = 0;  ///< denominator of every time; > 0
    std::uint64_t end_time = 0;          ///< of the last event or end of track, in the same units
    std::vector<MidiTempo> tempos;       ///< in order of time
    std::vector<MidiEvent> events;       ///< in order of time; at equal times by track, then as in the track
};

/// Largest file accepted [bytes]. Memory used is at most 24 bytes per byte of file.
inline constexpr std::size_t max_midi_file_bytes = std::size_t{16} << 20;
/// Longest music accepted [s], so that every time is exact in 64 bits.
inline constexpr std::uint64_t max_midi_duration_s = 24 * 3600;

/// Parses a whole file, plain or wrapped in RIFF ("RMID"). On failure Failure::place is the byte offset in
/// `bytes` and the track.
Result<MidiFile> parse_midi(std::span<const std::uint8_t> bytes);

/// The output frame nearest to `time`, exactly (ties upwards): no drift however long the file. rate_hz: 1 to
/// 1 000 000.
std::uint64_t frame_of(const MidiFile& file, std::uint64_t time, std::uint32_t rate_hz);

}  // namespace jawari::host
