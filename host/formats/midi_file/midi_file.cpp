#include "formats/midi_file/midi_file.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "formats/midi_file/byte_reader.h"
#include "formats/midi_file/midi_track.h"

namespace jawari::host {
namespace {

constexpr std::uint32_t default_tempo_us = 500000;
constexpr std::uint64_t us_per_s = 1000000;

struct Header {
    std::uint16_t format = 0;
    std::uint16_t tracks = 0;
    std::uint16_t division = 0;
};

/// How ticks become exact times.
struct TimeBase {
    std::uint64_t units_per_s = 0;
    std::uint64_t units_per_tick = 0;  ///< SMPTE; 0: the tempo in microseconds per quarter note
};

/// The span of the MIDI file inside an optional RIFF wrapper ("RIFF" size "RMID", chunks, one of them
/// "data").
Result<ByteReader> unwrap(std::span<const std::uint8_t> bytes) {
    ByteReader reader(bytes, 0, bytes.size());
    if (!reader.take_tag("RIFF")) return reader;
    reader.skip(4);
    if (!reader.take_tag("RMID"))
        return midi_failure(reader.offset(), -1, "a RIFF file of another kind", "RMID");
    while (reader.left() >= 8) {
        const bool data = reader.take_tag("data");
        if (!data) reader.skip(4);
        std::uint32_t size = 0;
        for (unsigned i = 0; i < 4; ++i) size |= *reader.big_endian(1) << (8 * i);  // RIFF is little-endian
        if (size > reader.left()) {
            return midi_failure(reader.offset() - 4, -1, "RIFF chunk of " + std::to_string(size) + " bytes",
                                "at most the " + std::to_string(reader.left()) + " bytes left in the file");
        }
        if (data) return ByteReader(bytes, reader.offset(), reader.offset() + size);
        reader.skip(std::min(reader.left(), std::size_t{size} + size % 2));
    }
    return midi_failure(reader.offset(), -1, "an RMID file without a data chunk", "one data chunk");
}

Result<Header> parse_header(ByteReader& reader) {
    const std::size_t start = reader.offset();
    if (!reader.take_tag("MThd")) {
        return midi_failure(start, -1, "not a standard MIDI file", "a file that begins with MThd");
    }
    const auto length = reader.big_endian(4);
    if (!length || *length < 6 || *length > reader.left()) {
        return midi_failure(start + 4, -1,
                            "header of " + (length ? std::to_string(*length) : "no") + " bytes",
                            "6 bytes or more, inside the file");
    }
    const std::size_t end = reader.offset() + *length;
    Header header;
    header.format = static_cast<std::uint16_t>(*reader.big_endian(2));
    header.tracks = static_cast<std::uint16_t>(*reader.big_endian(2));
    header.division = static_cast<std::uint16_t>(*reader.big_endian(2));
    reader.skip(end - reader.offset());
    if (header.format > 1) {
        return midi_failure(start + 8, -1, "MIDI file type " + std::to_string(header.format),
                            "0 or 1; the independent patterns of type 2 have no common time");
    }
    if (header.tracks == 0 || (header.format == 0 && header.tracks != 1)) {
        return midi_failure(start + 10, -1, std::to_string(header.tracks) + " tracks",
                            header.format == 0 ? "1 track in a type 0 file" : "1 to 65535");
    }
    return header;
}

std::optional<TimeBase> time_base(std::uint16_t division) {
    if ((division & 0x8000) == 0) {
        if (division == 0) return std::nullopt;
        return TimeBase{division * us_per_s, 0};
    }
    const unsigned frames_per_s = 256U - (division >> 8);
    const unsigned ticks_per_frame = division & 0xFF;
    if (ticks_per_frame == 0) return std::nullopt;
    switch (frames_per_s) {
        case 24:
        case 25:
        case 30:
            return TimeBase{std::uint64_t{frames_per_s} * ticks_per_frame, 1};
        case 29:  // "30 drop frame" counts frames of 1001/30000 s
            return TimeBase{std::uint64_t{30000} * ticks_per_frame, 1001};
        default:
            return std::nullopt;
    }
}

/// The next track chunk, skipping chunks of other kinds.
Result<ByteReader> next_track_chunk(std::span<const std::uint8_t> bytes, ByteReader& reader,
                                    const Header& header, std::uint16_t index) {
    for (;;) {
        const std::size_t start = reader.offset();
        if (reader.left() < 8) {
            return midi_failure(start, -1, "the file ends before track " + std::to_string(index + 1),
                                "the " + std::to_string(header.tracks) + " tracks that the header announces");
        }
        const bool track = reader.take_tag("MTrk");
        if (!track) reader.skip(4);
        const std::size_t length = *reader.big_endian(4);
        if (length > reader.left()) {
            return midi_failure(start + 4, track ? index : -1,
                                "chunk of " + std::to_string(length) + " bytes",
                                "at most the " + std::to_string(reader.left()) + " bytes left in the file");
        }
        const std::size_t begin = reader.offset();
        reader.skip(length);
        if (track) return ByteReader(bytes, begin, begin + length);
    }
}

/// Walks ticks forwards through the tempo map in exact integer time.
class Clock {
  public:
    Clock(TimeBase base, const std::vector<MidiTempo>& tempos) : base_(base), tempos_(tempos) {}

    /// Ticks must not decrease from call to call. Nothing if the time is past the longest music accepted.
    std::optional<std::uint64_t> time_at(std::uint64_t tick) {
        while (next_ < tempos_.size() && tempos_[next_].tick <= tick) {
            if (!advance(tempos_[next_].tick)) return std::nullopt;
            tempo_ = tempos_[next_].us_per_quarter;
            ++next_;
        }
        if (!advance(tick)) return std::nullopt;
        return time_;
    }

  private:
    bool advance(std::uint64_t tick) {
        const std::uint64_t units = base_.units_per_tick != 0 ? base_.units_per_tick : tempo_;
        const std::uint64_t longest = max_midi_duration_s * base_.units_per_s;
        if (tick - tick_ > (longest - time_) / units) return false;
        time_ += (tick - tick_) * units;
        tick_ = tick;
        return true;
    }

    TimeBase base_;
    const std::vector<MidiTempo>& tempos_;
    std::size_t next_ = 0;
    std::uint64_t tick_ = 0;
    std::uint64_t time_ = 0;
    std::uint32_t tempo_ = default_tempo_us;
};

/// Puts events and tempos in order of time (stable: tracks are appended in order) and fills the times in.
std::optional<Failure> assign_times(MidiFile& file, TimeBase base, std::uint64_t end_tick) {
    const auto earlier = [](const auto& a, const auto& b) { return a.tick < b.tick; };
    std::stable_sort(file.events.begin(), file.events.end(), earlier);
    std::stable_sort(file.tempos.begin(), file.tempos.end(), earlier);
    file.time_units_per_s = base.units_per_s;
    Clock clock(base, file.tempos);
    for (MidiEvent& event : file.events) {
        const auto time = clock.time_at(event.tick);
        if (!time) {
            return Failure{"track " + std::to_string(event.track + 1),
                           "an event at tick " + std::to_string(event.tick),
                           "events within the first 24 hours"};
        }
        event.time = *time;
    }
    const auto end = clock.time_at(end_tick);
    if (!end) return Failure{"end of track", "tick " + std::to_string(end_tick), "within the first 24 hours"};
    file.end_time = *end;
    return std::nullopt;
}

}  // namespace

Result<MidiFile> parse_midi(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > max_midi_file_bytes) {
        return midi_failure(0, -1, "a file of " + std::to_string(bytes.size()) + " bytes",
                            "at most " + std::to_string(max_midi_file_bytes));
    }
    auto contents = unwrap(bytes);
    if (!contents) return contents.failure();
    ByteReader reader = contents.value();
    const std::size_t start = reader.offset();
    const auto header = parse_header(reader);
    if (!header) return header.failure();
    const auto base = time_base(header.value().division);
    if (!base) {
        return midi_failure(
            start + 12, -1, "division " + std::to_string(header.value().division),
            "1 to 32767 ticks per quarter note, or SMPTE with 24, 25, 29 or 30 frames per second and 1 "
            "to 255 ticks per frame");
    }
    MidiFile file;
    file.format = header.value().format;
    file.track_count = header.value().tracks;
    file.division = header.value().division;
    std::uint64_t end_tick = 0;
    for (std::uint16_t index = 0; index < file.track_count; ++index) {
        const auto chunk = next_track_chunk(bytes, reader, header.value(), index);
        if (!chunk) return chunk.failure();
        auto track = parse_track(chunk.value(), index);
        if (!track) return track.failure();
        const MidiTrack& t = track.value();
        file.events.insert(file.events.end(), t.events.begin(), t.events.end());
        file.tempos.insert(file.tempos.end(), t.tempos.begin(), t.tempos.end());
        end_tick = std::max(end_tick, t.end_tick);
    }
    if (auto failure = assign_times(file, *base, end_tick)) return *std::move(failure);
    return file;
}

std::uint64_t frame_of(const MidiFile& file, std::uint64_t time, std::uint32_t rate_hz) {
    const std::uint64_t seconds = time / file.time_units_per_s;
    const std::uint64_t rest = time % file.time_units_per_s;
    return seconds * rate_hz + (rest * rate_hz + file.time_units_per_s / 2) / file.time_units_per_s;
}

}  // namespace jawari::host
