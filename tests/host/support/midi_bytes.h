// Bytes of MIDI files for tests, written from the standard and sharing nothing with the parser.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace jawari::test {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const Bytes& from) {
    to.insert(to.end(), from.begin(), from.end());
}

inline void append_tag(Bytes& to, std::string_view tag) {
    for (const char c : tag) to.push_back(static_cast<std::uint8_t>(c));
}

inline void append_big_endian(Bytes& to, std::uint32_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        to.push_back(static_cast<std::uint8_t>(value >> shift));
}

inline void append_variable_length(Bytes& to, std::uint32_t value) {
    Bytes digits{static_cast<std::uint8_t>(value & 0x7F)};
    for (value >>= 7; value != 0; value >>= 7)
        digits.push_back(static_cast<std::uint8_t>(0x80 | (value & 0x7F)));
    to.insert(to.end(), digits.rbegin(), digits.rend());
}

/// A delta time and an event's bytes.
inline void append_event(Bytes& to, std::uint32_t delta, const Bytes& event) {
    append_variable_length(to, delta);
    append(to, event);
}

inline Bytes tempo_event(std::uint32_t us_per_quarter) {
    Bytes event{0xFF, 0x51, 0x03};
    append_big_endian(event, us_per_quarter, 3);
    return event;
}

inline const Bytes end_of_track{0xFF, 0x2F, 0x00};

inline Bytes header_chunk(std::uint32_t format, std::uint32_t tracks, std::uint32_t division) {
    Bytes bytes;
    append_tag(bytes, "MThd");
    append_big_endian(bytes, 6, 4);
    append_big_endian(bytes, format, 2);
    append_big_endian(bytes, tracks, 2);
    append_big_endian(bytes, division, 2);
    return bytes;
}

inline Bytes chunk(std::string_view tag, const Bytes& contents) {
    Bytes bytes;
    append_tag(bytes, tag);
    append_big_endian(bytes, static_cast<std::uint32_t>(contents.size()), 4);
    append(bytes, contents);
    return bytes;
}

/// A type 0 file with one track of these bytes.
inline Bytes file_with_track(const Bytes& track, std::uint32_t division = 480) {
    Bytes bytes = header_chunk(0, 1, division);
    append(bytes, chunk("MTrk", track));
    return bytes;
}

}  // namespace jawari::test
