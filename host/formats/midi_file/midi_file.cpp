#include "formats/midi_file/midi_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "formats/midi_file/byte_reader.h"
#include "formats/midi_file/midi_times.h"
#include "formats/midi_file/midi_track.h"

namespace jawari::host {
namespace {

constexpr std::size_t header_bytes = 6;
constexpr std::size_t most_tracks = 65535;

/// Kinds of repairs outside tracks.
enum Repair {
    WrappedWrongly,
    ShortHeader,
    WrongFormat,
    WrongCount,
    OddRate,
    LongChunk,
    ShortChunk,
    NoChunk,
    Patterns
};

struct Header {
    std::uint16_t format = 0;
    std::uint16_t tracks = 0;
    std::uint16_t division = 0;
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

bool is_packed(std::span<const std::uint8_t> bytes) {
    return bytes.size() > 2 && bytes[0] == 0x1F && bytes[1] == 0x8B;
}

Failure packed_failure() {
    return midi_failure(0, -1, "a file packed by gzip", "a MIDI file; gunzip unpacks it");
}

/// A wrapper that is broken, or of another kind (MacBinary, a mail, a cartridge): the file begins at MThd.
Result<ByteReader> find_header(std::span<const std::uint8_t> bytes, const Failure& problem,
                               MidiNotes& notes) {
    static constexpr std::string_view tag = "MThd";
    const auto found = std::search(bytes.begin(), bytes.end(), tag.begin(), tag.end());
    if (found == bytes.end()) return is_packed(bytes) ? packed_failure() : problem;
    const auto begin = static_cast<std::size_t>(found - bytes.begin());
    notes.repair(0, -1, WrappedWrongly, problem.value, problem.allowed,
                 std::to_string(begin) + " bytes before MThd are left out");
    return ByteReader(bytes, begin, bytes.size());
}

Result<ByteReader> find_file(std::span<const std::uint8_t> bytes, MidiNotes& notes) {
    auto inside = unwrap(bytes);
    if (notes.strict() && is_packed(bytes)) return packed_failure();
    if (!inside) return notes.strict() ? inside : find_header(bytes, inside.failure(), notes);
    ByteReader reader = inside.value();
    if (notes.strict() || ByteReader(reader).take_tag("MThd")) return inside;
    return find_header(bytes, midi_failure(0, -1, "not a standard MIDI file", "a file that begins with MThd"),
                       notes);
}

/// Tracks and types that do not fit together.
bool check_counts(std::size_t start, Header& header, MidiNotes& notes) {
    const std::string type = "MIDI file type " + std::to_string(header.format);
    const std::string allowed = "0 or 1; the independent patterns of type 2 have no common time";
    if (header.format == 2 &&
        !notes.repair(start + 8, -1, Patterns, type, allowed, "its tracks are played one after the other"))
        return false;
    if (header.format > 2 && !notes.repair(start + 8, -1, WrongFormat, type, allowed, "type 1")) return false;
    const bool one_track = header.format == 0;
    if (header.tracks != 0 && (!one_track || header.tracks == 1)) return true;
    return notes.repair(start + 10, -1, WrongCount, std::to_string(header.tracks) + " tracks",
                        one_track ? "1 track in a type 0 file" : "1 to 65535",
                        "all tracks that are there are played");
}

Result<Header> parse_header(ByteReader& reader, MidiNotes& notes) {
    const std::size_t start = reader.offset();
    if (!reader.take_tag("MThd")) {
        return midi_failure(start, -1, "not a standard MIDI file", "a file that begins with MThd");
    }
    const auto length = reader.big_endian(4);
    const bool fits = length && *length >= header_bytes && *length <= reader.left();
    if (!fits) {
        const std::string value = "header of " + (length ? std::to_string(*length) : "no") + " bytes";
        const std::string allowed = "6 bytes or more, inside the file";
        if (!length || reader.left() < header_bytes) return midi_failure(start + 4, -1, value, allowed);
        if (!notes.repair(start + 4, -1, ShortHeader, value, allowed, "6 bytes")) return *notes.failure();
    }
    const std::size_t end = reader.offset() + (fits ? *length : header_bytes);
    Header header;
    header.format = static_cast<std::uint16_t>(*reader.big_endian(2));
    header.tracks = static_cast<std::uint16_t>(*reader.big_endian(2));
    header.division = static_cast<std::uint16_t>(*reader.big_endian(2));
    reader.skip(end - reader.offset());
    if (!check_counts(start, header, notes)) return *notes.failure();
    return header;
}

Result<TimeBase> base_of(std::size_t start, std::uint16_t division, MidiNotes& notes) {
    const auto base = time_base(division, true);
    if (base && time_base(division, false)) return *base;
    const std::string value = "division " + std::to_string(division);
    const std::string allowed =
        "1 to 32767 ticks per quarter note, or SMPTE with 24, 25, 29 or 30 frames per second and 1 "
        "to 255 ticks per frame";
    if (!base) return midi_failure(start + 12, -1, value, allowed);
    const std::string assumed = std::to_string(256U - (division >> 8U)) + " frames per second";
    if (!notes.repair(start + 12, -1, OddRate, value, allowed, assumed)) return *notes.failure();
    return *base;
}

/// Whether the next bytes are a chunk's name: four characters that can be printed.
bool at_chunk(const ByteReader& reader) {
    ByteReader tag = reader;
    if (tag.left() < 8) return false;
    for (int i = 0; i < 4; ++i) {
        const auto c = *tag.big_endian(1);
        if (c < 0x20 || c > 0x7E) return false;
    }
    return true;
}

/// Reads chunk by chunk. Unknown ones are skipped, as the standard asks.
class ChunkReader {
  public:
    ChunkReader(std::span<const std::uint8_t> bytes, ByteReader reader, const Header& header,
                MidiNotes& notes)
        : bytes_(bytes), reader_(reader), header_(header), notes_(notes) {}

    /// The next track; nothing at the end. A failure is in the notes.
    std::optional<ByteReader> next_track(std::size_t index) {
        if (index == most_tracks) return std::nullopt;
        while (!notes_.failure()) {
            if (index >= header_.tracks && notes_.strict()) return refuse_surplus(index);
            const std::size_t start = reader_.offset();
            if (!find_chunk(index)) return std::nullopt;
            const bool track = reader_.take_tag("MTrk");
            if (!track) reader_.skip(4);
            const auto chunk = take_chunk(start, track ? static_cast<int>(index) : -1);
            if (chunk && track) return chunk;
        }
        return std::nullopt;
    }

  private:
    /// The header announces fewer tracks than there are.
    std::optional<ByteReader> refuse_surplus(std::size_t index) {
        ByteReader rest = reader_;
        while (rest.left() >= 8) {
            const std::size_t start = rest.offset();
            const bool track = rest.take_tag("MTrk");
            if (track) {
                notes_.repair(start, static_cast<int>(index), WrongCount, "a track more than announced",
                              "the " + std::to_string(header_.tracks) + " tracks that the header announces",
                              "");
                break;
            }
            rest.skip(4);
            const std::size_t length = *rest.big_endian(4);
            if (!rest.skip(length)) break;
        }
        return std::nullopt;
    }

    /// False at the end of the file; then missing tracks and bytes that are no chunk are noted.
    bool find_chunk(std::size_t index) {
        const std::size_t start = reader_.offset();
        if (reader_.left() >= 8 && (notes_.strict() || at_chunk(reader_))) return true;
        if (reader_.left() >= 8) return skip_to_track();
        if (index < header_.tracks) {
            notes_.repair(start, -1, WrongCount, "the file ends before track " + std::to_string(index + 1),
                          "the " + std::to_string(header_.tracks) + " tracks that the header announces",
                          "the tracks that are there are all");
        }
        return false;
    }

    bool skip_to_track() {
        static constexpr std::string_view tag = "MTrk";
        const std::size_t start = reader_.offset();
        const auto rest = bytes_.subspan(start, reader_.left());
        const auto found = std::search(rest.begin(), rest.end(), tag.begin(), tag.end());
        const auto count = static_cast<std::size_t>(found - rest.begin());
        reader_.skip(count);
        const bool padding = std::all_of(rest.begin(), found, [](std::uint8_t byte) { return byte == 0; });
        if (!padding)
            notes_.repair(start, -1, NoChunk, std::to_string(count) + " bytes that are no chunk",
                          "chunks of a name, a length and that many bytes", "they are left out");
        return reader_.left() >= 8;
    }

    /// How long a track is whose length is wrong: it goes on to the next one, or the next one begins in it.
    std::size_t track_length(std::size_t start, int track, std::size_t length) {
        static constexpr std::array<std::uint8_t, 7> end_and_next{0xFF, 0x2F, 0x00, 'M', 'T', 'r', 'k'};
        const auto rest = bytes_.subspan(reader_.offset(), reader_.left());
        const auto inside = rest.first(std::min(length, rest.size()));
        const auto next = std::search(inside.begin(), inside.end(), end_and_next.begin(), end_and_next.end());
        if (next != inside.end()) {
            notes_.repair(start + 4, track, LongChunk, "chunk of " + std::to_string(length) + " bytes",
                          "a length that ends before the next chunk", "it ends where the next track begins");
            return static_cast<std::size_t>(next - inside.begin()) + 3;
        }
        if (length >= rest.size() || is_whole(inside) || ends_well(rest.subspan(length))) return length;
        const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(length);
        const auto end = std::search(begin, rest.end(), end_and_next.begin() + 3, end_and_next.end());
        notes_.repair(start + 4, track, ShortChunk, "chunk of " + std::to_string(length) + " bytes",
                      "a length that ends with End of Track", "it goes on to the next track");
        return static_cast<std::size_t>(end - rest.begin());
    }

    static bool is_whole(std::span<const std::uint8_t> track) {
        static constexpr std::array<std::uint8_t, 3> end{0xFF, 0x2F, 0x00};
        return std::search(track.begin(), track.end(), end.begin(), end.end()) != track.end();
    }

    /// What may follow a track: a chunk, or zeros to the end.
    bool ends_well(std::span<const std::uint8_t> rest) const {
        if (std::all_of(rest.begin(), rest.end(), [](std::uint8_t byte) { return byte == 0; })) return true;
        const auto begin = static_cast<std::size_t>(rest.data() - bytes_.data());
        return at_chunk(ByteReader(bytes_, begin, begin + rest.size()));
    }

    std::optional<ByteReader> take_chunk(std::size_t start, int track) {
        std::size_t length = *reader_.big_endian(4);
        if (track >= 0 && !notes_.strict()) length = track_length(start, track, length);
        if (length > reader_.left()) {
            const std::string left = std::to_string(reader_.left());
            if (!notes_.repair(start + 4, track, LongChunk, "chunk of " + std::to_string(length) + " bytes",
                               "at most the " + left + " bytes left in the file",
                               "it has the " + left + " bytes that are left"))
                return std::nullopt;
            length = reader_.left();
        }
        const std::size_t begin = reader_.offset();
        reader_.skip(length);
        return ByteReader(bytes_, begin, begin + length);
    }

    std::span<const std::uint8_t> bytes_;
    ByteReader reader_;
    const Header& header_;
    MidiNotes& notes_;
};

/// Appends the tracks; returns the tick at which the last one ends.
Result<std::uint64_t> read_tracks(ChunkReader& chunks, MidiNotes& notes, MidiFile& file) {
    std::uint64_t end_tick = 0;
    std::size_t count = 0;
    for (auto chunk = chunks.next_track(0); chunk; chunk = chunks.next_track(count)) {
        auto track = parse_track(*chunk, static_cast<std::uint16_t>(count++), notes, file);
        if (!track) return track.failure();
        MidiTrack& t = track.value();
        const std::uint64_t begin = file.format == 2 ? end_tick : 0;  // patterns: one after the other
        for (MidiEvent& event : t.events) event.tick += begin;
        for (MidiTempo& tempo : t.tempos) tempo.tick += begin;
        file.events.insert(file.events.end(), t.events.begin(), t.events.end());
        file.tempos.insert(file.tempos.end(), t.tempos.begin(), t.tempos.end());
        end_tick = std::max(end_tick, begin + t.end_tick);
    }
    if (notes.failure()) return *notes.failure();
    file.track_count = static_cast<std::uint16_t>(count);
    return end_tick;
}

}  // namespace

Result<MidiFile> parse_midi(std::span<const std::uint8_t> bytes, MidiReading reading) {
    if (bytes.size() > max_midi_file_bytes) {
        return midi_failure(0, -1, "a file of " + std::to_string(bytes.size()) + " bytes",
                            "at most " + std::to_string(max_midi_file_bytes));
    }
    MidiNotes notes(reading);
    auto contents = find_file(bytes, notes);
    if (!contents) return contents.failure();
    ByteReader reader = contents.value();
    const std::size_t start = reader.offset();
    const auto header = parse_header(reader, notes);
    if (!header) return header.failure();
    const auto base = base_of(start, header.value().division, notes);
    if (!base) return base.failure();
    MidiFile file;
    file.format = header.value().format;
    file.division = header.value().division;
    ChunkReader chunks(bytes, reader, header.value(), notes);
    const auto end_tick = read_tracks(chunks, notes, file);
    if (!end_tick) return end_tick.failure();
    if (file.track_count == 0)
        return midi_failure(reader.offset(), -1, "no track", "a track chunk (MTrk) after the header");
    if (file.track_count > header.value().tracks && header.value().tracks > 0 &&
        (file.format != 0 || header.value().tracks == 1))
        notes.repair(start + 10, -1, WrongCount,
                     std::to_string(header.value().tracks) +
                         (header.value().tracks == 1 ? " track" : " tracks") + " announced",
                     "as many as there are", "all " + std::to_string(file.track_count) + " are played");
    if (auto failure = assign_times(file, base.value(), end_tick.value(), notes)) return *std::move(failure);
    file.repairs = std::move(notes.repairs());
    return file;
}

}  // namespace jawari::host
