#include "midi/byte_stream.h"

namespace jawari::host {

namespace {

constexpr std::uint8_t first_system_status = 0xF0;
constexpr std::uint8_t first_real_time_status = 0xF8;

}  // namespace

std::optional<ChannelMessage> take_byte(MidiByteStream& stream, std::uint8_t byte) JAWARI_REALTIME {
    if (byte >= first_real_time_status) return std::nullopt;
    if (byte >= 0x80) {
        stream.status = byte < first_system_status ? byte : std::uint8_t{0};
        stream.received = 0;
        return std::nullopt;
    }
    if (stream.status == 0) return std::nullopt;
    stream.data[static_cast<std::size_t>(stream.received++)] = byte;
    if (stream.received < data_bytes(stream.status)) return std::nullopt;
    const bool two = stream.received == 2;
    stream.received = 0;
    return ChannelMessage{stream.status, stream.data[0], two ? stream.data[1] : std::uint8_t{0}};
}

}  // namespace jawari::host
