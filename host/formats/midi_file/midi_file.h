// Standard MIDI files, parsed whole: "Standard MIDI Files 1.0", MIDI Manufacturers Association, 1988.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/midi_file/midi_reading.h"
#include "jawari/result.h"

namespace jawari::host {

/// A channel message, or a system exclusive one. Meta events carry no sound and are not kept; tempo changes
/// are in MidiFile::tempos, ports in each event.
struct MidiEvent {
    std::uint64_t tick = 0;       ///< since the start of the file, in the file's division
    std::uint64_t time = 0;       ///< exact, in units of 1/MidiFile::time_units_per_s s
    std::uint32_t exclusive = 0;  ///< of a system exclusive message: index in MidiFile::exclusives
    std::uint16_t track = 0;      ///< 0 is the first
    std::uint8_t status = 0;      ///< 0x80 to 0xEF: message type in the high, channel in the low four bits;
                                  ///< 0xF0: system exclusive
    std::uint8_t data1 = 0;       ///< 0 to 127
    std::uint8_t data2 = 0;       ///< 0 to 127; 0 for program change and channel pressure
    std::uint8_t port = 0;        ///< 0 to 127: each has 16 channels of its own (FF 21, or FF 09)
};

inline constexpr std::uint8_t exclusive_status = 0xF0;

struct MidiTempo {
    std::uint64_t tick = 0;
    std::uint16_t track = 0;
    std::uint32_t us_per_quarter = 500000;  ///< 1 to 2^24 - 1
};

struct MidiFile {
    std::uint16_t format = 0;       ///< as in the file
    std::uint16_t track_count = 0;  ///< tracks that are there
    std::uint16_t division = 0;     ///< as in the file: ticks per quarter note, or SMPTE if bit 15 is set
    std::uint64_t time_units_per_s = 0;  ///< denominator of every time; > 0
    std::uint64_t end_time = 0;          ///< of the last event or end of track, in the same units
    std::vector<MidiTempo> tempos;       ///< in order of time
    /// In order of time. At equal times what a track does before its first note-on of that time, in order of
    /// tracks, then the rest, in order of tracks: a program, a pedal or a note-off of one track comes before
    /// the notes of another.
    std::vector<MidiEvent> events;
    std::vector<std::vector<std::uint8_t>> exclusives;  ///< without F0 and F7
    std::uint64_t escapes = 0;                          ///< F7 events with bytes for other devices, left out
    std::vector<MidiRepair> repairs;                    ///< of a lenient reading
};

/// Largest file accepted [bytes]. Memory used is at most 32 bytes per byte of file.
inline constexpr std::size_t max_midi_file_bytes = std::size_t{256} << 20;
/// Longest music accepted [s], so that every time is exact in 64 bits.
inline constexpr std::uint64_t max_midi_duration_s = 1000 * 3600;
/// A lenient reading ends at the last message if End of Track comes more than this much later [s].
inline constexpr std::uint64_t longest_silent_end_s = 30;

/// Parses a whole file, plain or wrapped in RIFF ("RMID"). On failure Failure::place is the byte offset in
/// `bytes` and the track. A lenient reading (docs/formats/midi.md, "Files") fails only if there is no track
/// to play, or no time base, or too much of either.
Result<MidiFile> parse_midi(std::span<const std::uint8_t> bytes, MidiReading reading = MidiReading::Strict);

/// The output frame nearest to `time`, exactly (ties upwards): no drift however long the file. rate_hz: 1 to
/// 1 000 000.
std::uint64_t frame_of(const MidiFile& file, std::uint64_t time, std::uint32_t rate_hz);

}  // namespace jawari::host
