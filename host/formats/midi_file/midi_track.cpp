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
constexpr std::uint8_t meta_device_name = 0x09;
constexpr std::uint8_t meta_port = 0x21;
constexpr std::uint8_t meta_end_of_track = 0x2F;
constexpr std::uint8_t meta_tempo = 0x51;
constexpr std::size_t longest_variable_length = 4;

/// Kinds of repairs: one notice a track for each.
enum TrackRepair {
    NoEnd,
    AfterEnd,
    CutEvent,
    LongNumber,
    RunningStatus,
    LostData,
    HighData,
    SystemByte,
    LongBody,
    BadTempo,
    HighMeta,
    BadPort
};

std::string hex(std::uint32_t byte) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%02X", byte);
    return text;
}

/// Data bytes of a system common message.
std::size_t system_data(std::uint8_t status) {
    switch (status) {
        case 0xF1:
        case 0xF3:
            return 1;
        case 0xF2:
            return 2;
        default:
            return 0;
    }
}

class TrackParser {
  public:
    TrackParser(ByteReader reader, std::uint16_t index, MidiNotes& notes, MidiFile& file)
        : reader_(reader), index_(index), notes_(notes), file_(file) {}

    Result<MidiTrack> run() {
        while (!over_) {
            if (!parse_event()) return *notes_.failure();
        }
        if (!ended_) track_.end_tick = tick_;
        return std::move(track_);
    }

  private:
    /// What is wrong at `offset`, and what a lenient reading takes it for.
    bool repair(TrackRepair kind, std::size_t offset, const std::string& value, const std::string& allowed,
                const std::string& assumed) {
        return notes_.repair(offset, index_, kind, value, allowed, assumed);
    }

    /// Nothing more can be read of this track.
    bool stop_truncated(const char* what) {
        over_ = true;
        return repair(CutEvent, reader_.offset(), std::string("the track's chunk ends inside ") + what,
                      "a complete event, and End of Track as the last", "the track ends before it");
    }

    /// Nothing: over_ is set, or the reading has failed.
    std::optional<std::uint32_t> variable_length(const char* what) {
        const std::size_t start = reader_.offset();
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < longest_variable_length; ++i) {
            const auto byte = reader_.big_endian(1);
            if (!byte) {
                stop_truncated(what);
                return std::nullopt;
            }
            value = value << 7 | (*byte & 0x7F);
            if ((*byte & 0x80) == 0) return value;
        }
        over_ = true;
        repair(LongNumber, start, std::string(what) + " of more than 4 bytes",
               "a variable-length number up to 0x0FFFFFFF", "the track ends before it");
        return std::nullopt;
    }

    /// After a number that could not be read.
    [[nodiscard]] bool goes_on() const { return !notes_.failure(); }

    bool at_end() {
        over_ = true;
        if (ended_) return true;
        return repair(NoEnd, reader_.offset(), "no End of Track", "End of Track (FF 2F 00) as the last event",
                      "the track ends with its chunk");
    }

    bool parse_event() {
        if (reader_.left() == 0) return at_end();
        if (ended_) {
            if (only_zeros_left()) return at_end();  // some writers pad chunks to an even length
            if (!repair(AfterEnd, reader_.offset(), "events after End of Track",
                        "End of Track as the last event", "they are played"))
                return false;
        }
        const auto delta = variable_length("a delta time");
        if (!delta) return goes_on();
        tick_ += *delta;
        const auto first = reader_.peek();
        if (!first) return stop_truncated("an event");
        return parse_message(*first);
    }

    bool parse_message(std::uint8_t first) {
        if (first == meta) return parse_meta();
        if (first == sysex || first == sysex_continued) return parse_sysex(first);
        if (first > sysex) return skip_system_byte(first);
        return parse_channel_message(first);
    }

    [[nodiscard]] bool only_zeros_left() const {
        ByteReader rest = reader_;
        while (const auto byte = rest.big_endian(1))
            if (*byte != 0) return false;
        return true;
    }

    bool skip_system_byte(std::uint8_t status) {
        if (!repair(SystemByte, reader_.offset(), "status byte " + hex(status),
                    "0x80 to 0xEF, 0xF0, 0xF7 or 0xFF in a file", "it is left out"))
            return false;
        reader_.skip(1 + std::min(reader_.left() - 1, system_data(status)));
        return true;
    }

    bool parse_channel_message(std::uint8_t first) {
        if ((first & 0x80) != 0) {
            running_status_ = last_status_ = first;
            reader_.skip(1);
        } else if (running_status_ == 0) {
            if (last_status_ == 0) return skip_lost_data(first);
            if (!repair(RunningStatus, reader_.offset(),
                        "data byte " + hex(first) + " without a status byte before it",
                        "a status byte; meta events and system exclusive end running status",
                        "the status before those events goes on"))
                return false;
            running_status_ = last_status_;
        }
        MidiEvent event{.tick = tick_, .track = index_, .status = running_status_, .port = port_};
        if (!parse_data(event.data1)) return goes_on();
        const bool one_byte = (running_status_ & 0xF0) == 0xC0 || (running_status_ & 0xF0) == 0xD0;
        if (!one_byte && !parse_data(event.data2)) return goes_on();
        track_.events.push_back(event);
        if (ended_) track_.end_tick = tick_;
        return true;
    }

    /// Nobody knows what they belong to.
    bool skip_lost_data(std::uint8_t first) {
        if (!repair(LostData, reader_.offset(),
                    "data byte " + hex(first) + " without a status byte before it",
                    "a status byte; meta events and system exclusive end running status",
                    "data up to the next status byte are left out"))
            return false;
        for (auto byte = reader_.peek(); byte && *byte < 0x80; byte = reader_.peek()) reader_.skip(1);
        const auto status = reader_.peek();
        return status ? parse_message(*status) : stop_truncated("an event");
    }

    /// False: over_ is set, or the reading has failed.
    bool parse_data(std::uint8_t& data) {
        const auto byte = reader_.peek();
        if (!byte) {
            stop_truncated("a channel message");
            return false;
        }
        if (*byte > 0x7F && !repair(HighData, reader_.offset(), "data byte " + hex(*byte), "0x00 to 0x7F",
                                    "its lower seven bits count"))
            return false;
        data = *byte & 0x7F;
        return reader_.skip(1);
    }

    /// A message may come in several packets: F0 first, the others with F7, the last of which ends with F7.
    bool parse_sysex(std::uint8_t first) {
        reader_.skip(1);
        running_status_ = 0;
        const auto length = variable_length("a system exclusive length");
        if (!length) return goes_on();
        const auto body = reader_.take(*length);
        if (!body) return refuse_body(*length, "a system exclusive event");
        if (first == sysex) {
            pending_.assign(body->begin(), body->end());
            in_exclusive_ = true;
        } else if (in_exclusive_) {
            pending_.insert(pending_.end(), body->begin(), body->end());
        } else {
            file_.escapes += 1;
            return true;
        }
        if (!pending_.empty() && pending_.back() == sysex_continued) {
            pending_.pop_back();
            keep_exclusive();
        } else if (!continues()) {
            keep_exclusive();  // some writers leave the F7 out
        }
        return true;
    }

    /// Whether the next event is a packet of the message that is open.
    [[nodiscard]] bool continues() const {
        ByteReader next = reader_;
        for (std::size_t i = 0; i < longest_variable_length; ++i) {
            const auto byte = next.big_endian(1);
            if (!byte || (*byte & 0x80) == 0) break;
        }
        return next.peek() == sysex_continued;
    }

    void keep_exclusive() {
        in_exclusive_ = false;
        MidiEvent event{.tick = tick_, .track = index_, .status = sysex, .port = port_};
        event.exclusive = static_cast<std::uint32_t>(file_.exclusives.size());
        file_.exclusives.push_back(std::move(pending_));
        pending_.clear();
        track_.events.push_back(event);
    }

    bool refuse_body(std::uint32_t length, const char* what) {
        over_ = true;
        return repair(LongBody, reader_.offset(),
                      std::string(what) + " of " + std::to_string(length) + " bytes",
                      "at most the " + std::to_string(reader_.left()) + " bytes left in the track",
                      "the track ends before it");
    }

    bool parse_meta() {
        reader_.skip(1);
        running_status_ = 0;
        const auto type = reader_.big_endian(1);
        if (!type) return stop_truncated("a meta event");
        if (*type > 0x7F && !repair(HighMeta, reader_.offset() - 1, "meta event type " + hex(*type),
                                    "0x00 to 0x7F", "it is left out"))
            return false;
        const auto length = variable_length("a meta event's length");
        if (!length) return goes_on();
        const std::size_t start = reader_.offset();
        const auto body = reader_.take(*length);
        if (!body && *type == meta_tempo && *length == 3) return stop_truncated("a tempo");
        if (!body) return refuse_body(*length, "a meta event");
        switch (*type) {
            case meta_tempo:
                return parse_tempo(start, *body);
            case meta_port:
                return parse_port(start, *body);
            case meta_device_name:
                if (!has_port_) port_ = notes_.port_of_device({body->begin(), body->end()});
                return true;
            case meta_end_of_track:
                ended_ = true;
                track_.end_tick = tick_;
                return true;
            default:
                return true;
        }
    }

    bool parse_tempo(std::size_t start, std::span<const std::uint8_t> body) {
        if (body.size() != 3)
            return repair(BadTempo, start, "tempo of " + std::to_string(body.size()) + " bytes", "3 bytes",
                          "it is left out");
        const std::uint32_t tempo = std::uint32_t{body[0]} << 16 | std::uint32_t{body[1]} << 8 | body[2];
        if (tempo == 0)
            return repair(BadTempo, start, "tempo of 0 microseconds per quarter note", "1 to 16777215",
                          "it is left out");
        track_.tempos.push_back({.tick = tick_, .track = index_, .us_per_quarter = tempo});
        return true;
    }

    bool parse_port(std::size_t start, std::span<const std::uint8_t> body) {
        if (body.size() != 1 || body[0] > 0x7F)
            return repair(BadPort, start,
                          "MIDI port " + (body.size() == 1 ? std::to_string(body[0])
                                                           : "of " + std::to_string(body.size()) + " bytes"),
                          "1 byte, 0 to 127", "it is left out");
        port_ = body[0];
        has_port_ = true;
        return true;
    }

    ByteReader reader_;
    std::uint16_t index_;
    MidiNotes& notes_;
    MidiFile& file_;
    std::uint64_t tick_ = 0;  // cannot overflow: at most 2^28 per event and 2^28 bytes
    std::uint8_t running_status_ = 0;
    std::uint8_t last_status_ = 0;  // running status as lenient players keep it
    std::uint8_t port_ = 0;
    bool has_port_ = false;  // FF 21 says more than FF 09
    bool ended_ = false;     // End of Track has come
    bool over_ = false;      // nothing more is read
    bool in_exclusive_ = false;
    std::vector<std::uint8_t> pending_;  // of the system exclusive message that is open
    MidiTrack track_;
};

}  // namespace

Result<MidiTrack> parse_track(ByteReader reader, std::uint16_t index, MidiNotes& notes, MidiFile& file) {
    return TrackParser(reader, index, notes, file).run();
}

}  // namespace jawari::host
