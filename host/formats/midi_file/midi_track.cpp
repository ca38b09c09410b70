#include "formats/midi_file/midi_track.h"

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace jawari::host {
namespace {

constexpr std::uint8_t sysex = 0xF0;
constexpr std::uint8_t sysex_continued = 0xF7;
constexpr std::uint8_t meta = 0xFF;
constexpr std::uint8_t meta_end_of_track = 0x2F;
constexpr std::uint8_t meta_tempo = 0x51;
constexpr std::size_t longest_variable_length = 4;

std::string hex(std::uint32_t byte) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%02X", byte);
    return text;
}

class TrackParser {
  public:
    TrackParser(ByteReader reader, std::uint16_t index) : reader_(reader), index_(index) {}

    Result<MidiTrack> run() {
        while (!ended_) {
            if (!parse_event()) return *std::move(failure_);
        }
        track_.end_tick = tick_;
        return std::move(track_);
    }

  private:
    bool fail(std::size_t offset, std::string value, std::string allowed) {
        failure_ = midi_failure(offset, index_, std::move(value), std::move(allowed));
        return false;
    }

    bool fail_truncated(const char* what) {
        return fail(reader_.offset(), std::string("the track's chunk ends inside ") + what,
                    "a complete event, and End of Track as the last");
    }

    std::optional<std::uint32_t> variable_length(const char* what) {
        const std::size_t start = reader_.offset();
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < longest_variable_length; ++i) {
            const auto byte = reader_.big_endian(1);
            if (!byte) {
                fail_truncated(what);
                return std::nullopt;
            }
            value = value << 7 | (*byte & 0x7F);
            if ((*byte & 0x80) == 0) return value;
        }
        fail(start, std::string(what) + " of more than 4 bytes", "a variable-length number up to 0x0FFFFFFF");
        return std::nullopt;
    }

    bool parse_event() {
        const std::size_t start = reader_.offset();
        if (reader_.left() == 0)
            return fail(start, "no End of Track", "End of Track (FF 2F 00) as the last event");
        const auto delta = variable_length("a delta time");
        if (!delta) return false;
        tick_ += *delta;
        const auto first = reader_.peek();
        if (!first) return fail_truncated("an event");
        if (*first == meta) return parse_meta();
        if (*first == sysex || *first == sysex_continued) return parse_sysex();
        if (*first > sysex) {
            return fail(reader_.offset(), "status byte " + hex(*first),
                        "0x80 to 0xEF, 0xF0, 0xF7 or 0xFF in a file");
        }
        return parse_channel_message(*first);
    }

    bool parse_channel_message(std::uint8_t first) {
        if ((first & 0x80) != 0) {
            running_status_ = first;
            reader_.skip(1);
        } else if (running_status_ == 0) {
            return fail(reader_.offset(), "data byte " + hex(first) + " without a status byte before it",
                        "a status byte; meta events and system exclusive end running status");
        }
        MidiEvent event{.tick = tick_, .track = index_, .status = running_status_};
        if (!parse_data(event.data1)) return false;
        const bool one_byte = (running_status_ & 0xF0) == 0xC0 || (running_status_ & 0xF0) == 0xD0;
        if (!one_byte && !parse_data(event.data2)) return false;
        track_.events.push_back(event);
        return true;
    }

    bool parse_data(std::uint8_t& data) {
        const auto byte = reader_.peek();
        if (!byte) return fail_truncated("a channel message");
        if (*byte > 0x7F) return fail(reader_.offset(), "data byte " + hex(*byte), "0x00 to 0x7F");
        data = *byte;
        return reader_.skip(1);
    }

    bool parse_sysex() {
        reader_.skip(1);
        running_status_ = 0;
        const auto length = variable_length("a system exclusive length");
        if (!length) return false;
        return skip_body(*length, "a system exclusive event");
    }

    bool skip_body(std::uint32_t length, const char* what) {
        if (reader_.skip(length)) return true;
        return fail(reader_.offset(), std::string(what) + " of " + std::to_string(length) + " bytes",
                    "at most the " + std::to_string(reader_.left()) + " bytes left in the track");
    }

    bool parse_meta() {
        reader_.skip(1);
        running_status_ = 0;
        const auto type = reader_.big_endian(1);
        if (!type) return fail_truncated("a meta event");
        if (*type > 0x7F) return fail(reader_.offset() - 1, "meta event type " + hex(*type), "0x00 to 0x7F");
        const auto length = variable_length("a meta event's length");
        if (!length) return false;
        if (*type == meta_tempo) return parse_tempo(*length);
        if (*type == meta_end_of_track) ended_ = true;
        return skip_body(*length, "a meta event");
    }

    bool parse_tempo(std::uint32_t length) {
        const std::size_t start = reader_.offset();
        if (length != 3) return fail(start, "tempo of " + std::to_string(length) + " bytes", "3 bytes");
        const auto tempo = reader_.big_endian(3);
        if (!tempo) return fail_truncated("a tempo");
        if (*tempo == 0) return fail(start, "tempo of 0 microseconds per quarter note", "1 to 16777215");
        track_.tempos.push_back({.tick = tick_, .track = index_, .us_per_quarter = *tempo});
        return true;
    }

    ByteReader reader_;
    std::uint16_t index_;
    std::uint64_t tick_ = 0;  // cannot overflow: at most 2^28 per event and 2^24 bytes
    std::uint8_t running_status_ = 0;
    bool ended_ = false;
    MidiTrack track_;
    std::optional<Failure> failure_;
};

}  // namespace

Result<MidiTrack> parse_track(ByteReader reader, std::uint16_t index) {
    return TrackParser(reader, index).run();
}

Failure midi_failure(std::size_t offset, int track, std::string value, std::string allowed) {
    std::string place = "byte " + std::to_string(offset);
    if (track >= 0) place += " (track " + std::to_string(track + 1) + ")";
    return {std::move(place), std::move(value), std::move(allowed)};
}

}  // namespace jawari::host
