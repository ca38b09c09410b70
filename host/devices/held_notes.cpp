#include "devices/held_notes.h"

namespace jawari::host {

namespace {

constexpr std::array<std::uint8_t, 3> pedal_controllers{64, 66, 69};  // sustain, sostenuto, hold 2
constexpr std::uint8_t first_channel_mode = 120;
constexpr std::uint8_t local_control = 122, reset_controllers_mode = 121;
constexpr std::uint8_t medium_release = 64;

ChannelMessage message(MessageKind kind, std::size_t channel, std::uint8_t data1, std::uint8_t data2) {
    return {static_cast<std::uint8_t>(static_cast<std::size_t>(kind) | channel), data1, data2};
}

/// What modes and resets let go of by themselves.
void follow_mode(HeldNotes& held, std::size_t channel, std::uint8_t mode) {
    if (mode == local_control) return;
    if (mode != reset_controllers_mode) {
        held.keys[channel].fill(0);
        return;
    }
    for (auto& pedal : held.pedals) pedal[channel] = false;
    held.bends[channel] = false;
}

void follow_controller(HeldNotes& held, std::size_t channel, const ChannelMessage& message) {
    if (message.data1 >= first_channel_mode) follow_mode(held, channel, message.data1);
    for (std::size_t pedal = 0; pedal < pedal_controllers.size(); ++pedal)
        if (message.data1 == pedal_controllers[pedal]) held.pedals[pedal][channel] = message.data2 >= 64;
}

void note_ends(std::uint8_t& open) {
    if (open > 0) open -= 1;
}

}  // namespace

void follow(HeldNotes& held, const ChannelMessage& message) {
    const auto channel = static_cast<std::size_t>(channel_of(message));
    switch (kind_of(message)) {
        case MessageKind::NoteOn: {
            std::uint8_t& open = held.keys[channel][message.data1 & 0x7FU];
            if (message.data2 == 0)
                note_ends(open);
            else if (open < 255)
                open += 1;
            break;
        }
        case MessageKind::NoteOff:
            note_ends(held.keys[channel][message.data1 & 0x7FU]);
            break;
        case MessageKind::ControlChange:
            follow_controller(held, channel, message);
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
            for (int open = held.keys[channel][key]; open > 0; --open)
                messages.push_back(message(MessageKind::NoteOff, channel, key, medium_release));
        for (std::size_t pedal = 0; pedal < pedal_controllers.size(); ++pedal)
            if (held.pedals[pedal][channel])
                messages.push_back(message(MessageKind::ControlChange, channel, pedal_controllers[pedal], 0));
        if (held.bends[channel]) messages.push_back(message(MessageKind::PitchBend, channel, 0, 64));
    }
    held = {};
    return messages;
}

}  // namespace jawari::host
