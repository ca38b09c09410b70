#include "devices/held_notes.h"

namespace jawari::host {

namespace {

constexpr std::uint8_t sustain_controller = 64;
constexpr std::uint8_t medium_release = 64;

ChannelMessage message(MessageKind kind, std::size_t channel, std::uint8_t data1, std::uint8_t data2) {
    return {static_cast<std::uint8_t>(static_cast<std::size_t>(kind) | channel), data1, data2};
}

}  // namespace

void follow(HeldNotes& held, const ChannelMessage& message) {
    const auto channel = static_cast<std::size_t>(channel_of(message));
    switch (kind_of(message)) {
        case MessageKind::NoteOn:
            held.keys[channel][message.data1 & 0x7FU] = message.data2 > 0;
            break;
        case MessageKind::NoteOff:
            held.keys[channel][message.data1 & 0x7FU] = false;
            break;
        case MessageKind::ControlChange:
            if (message.data1 == sustain_controller) held.pedals[channel] = message.data2 >= 64;
            break;
        case MessageKind::PitchBend:
            held.bends[channel] = message.data1 != 0 || message.data2 != 64;
            break;
        default:
            break;
    }
}

std::vector<ChannelMessage> release_all(HeldNotes& held) {
    std::vector<ChannelMessage> messages;
    for (std::size_t channel = 0; channel < midi_channel_count; ++channel) {
        for (std::uint8_t key = 0; key < 128; ++key)
            if (held.keys[channel][key])
                messages.push_back(message(MessageKind::NoteOff, channel, key, medium_release));
        if (held.pedals[channel])
            messages.push_back(message(MessageKind::ControlChange, channel, sustain_controller, 0));
        if (held.bends[channel]) messages.push_back(message(MessageKind::PitchBend, channel, 0, 64));
    }
    held = {};
    return messages;
}

}  // namespace jawari::host
