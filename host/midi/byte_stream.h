// MIDI as it comes over a wire: bytes with running status and messages inside messages ("MIDI 1.0 Detailed
// Specification", 4.2). Plain state; nothing allocates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "jawari/realtime.h"
#include "midi/channel_message.h"

namespace jawari::host {

struct MidiByteStream {
    std::uint8_t status = 0;  ///< running status; 0: none, data bytes are skipped
    std::array<std::uint8_t, 2> data{};
    int received = 0;  ///< data bytes of the message under way
};

/// Takes one byte. A channel message when the byte completes one. System real-time bytes (0xF8 to 0xFF) may
/// come anywhere and change nothing; every other status byte abandons an incomplete message; system common
/// and exclusive messages are skipped and end running status.
std::optional<ChannelMessage> take_byte(MidiByteStream& stream, std::uint8_t byte) JAWARI_REALTIME;

}  // namespace jawari::host
