// A MIDI channel message, wherever it came from.
#pragma once

#include <cstdint>

namespace jawari::host {

struct ChannelMessage {
    std::uint8_t status = 0x80;  ///< 0x80 to 0xEF: kind in the high, channel in the low four bits
    std::uint8_t data1 = 0;      ///< 0 to 127
    std::uint8_t data2 = 0;      ///< 0 to 127; 0 for program change and channel pressure
};

/// High four bits of the status byte.
enum class MessageKind : std::uint8_t {
    NoteOff = 0x80,
    NoteOn = 0x90,
    PolyPressure = 0xA0,
    ControlChange = 0xB0,
    ProgramChange = 0xC0,
    ChannelPressure = 0xD0,
    PitchBend = 0xE0
};

constexpr MessageKind kind_of(const ChannelMessage& message) {
    return static_cast<MessageKind>(message.status & 0xF0U);
}

/// 0 to 15.
constexpr int channel_of(const ChannelMessage& message) {
    return message.status & 0x0F;
}

/// Controllers that carry data of an RPN or NRPN: entry, coarse and fine; increment, decrement.
constexpr bool is_data_entry(int controller) {
    return controller == 6 || controller == 38 || controller == 96 || controller == 97;
}

/// Data bytes that follow a status byte of this kind.
constexpr int data_bytes(std::uint8_t status) {
    const unsigned kind = status & 0xF0U;
    return kind == 0xC0U || kind == 0xD0U ? 1 : 2;
}

}  // namespace jawari::host
