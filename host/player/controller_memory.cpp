#include "player/controller_memory.h"

#include <algorithm>

namespace jawari::host {

namespace {

constexpr int data_coarse = 6, data_fine = 38, nrpn_fine = 98, nrpn_coarse = 99, rpn_fine = 100,
              rpn_coarse = 101;
constexpr int reset_all_controllers = 121, mono_on = 126, poly_on = 127;
constexpr std::size_t hold_2 = 69;

/// Modes and resets put what they reset back by themselves; what they leave alone stays remembered.
void reset_controllers(ChannelMemory& channel) {
    constexpr int modulation = 1, expression = 11, first_pedal = 64, last_pedal = 67;
    for (const int controller : {modulation, expression})
        channel.controllers[static_cast<std::size_t>(controller)] = -1;
    for (int pedal = first_pedal; pedal <= last_pedal; ++pedal)
        channel.controllers[static_cast<std::size_t>(pedal)] = -1;
    channel.controllers[hold_2] = -1;
    channel.bend = -1;
    channel.pressure = -1;
    channel.selected = -1;
}

/// Mode 4 of `count` channels, 0: all from this one on (MIDI 1.0).
void remember_mode(ControllerMemory& memory, std::size_t first, int controller, int count) {
    const bool mono = controller == mono_on;
    const std::size_t all = memory.channels.size();
    const std::size_t end = mono && count != 1
                                ? std::min(all, count == 0 ? all : first + static_cast<std::size_t>(count))
                                : first + 1;
    for (std::size_t channel = first; channel < end; ++channel) memory.channels[channel].mono = mono ? 1 : 0;
}

void remember_data(ChannelMemory& channel, int controller, int value) {
    if (channel.selected < 0) return;
    const auto at = static_cast<std::size_t>(channel.selected);
    (controller == data_coarse ? channel.registered_coarse : channel.registered_fine)[at] = value;
}

void remember_selection(ChannelMemory& channel, int controller, int value) {
    channel.selected = -1;
    if (controller == nrpn_fine || controller == nrpn_coarse) return;
    const int fine = controller == rpn_fine ? value : channel.controllers[rpn_fine];
    const int coarse = controller == rpn_coarse ? value : channel.controllers[rpn_coarse];
    if (coarse == 0 && fine >= 0 && fine <= 6) channel.selected = fine;
}

void remember_system(ControllerMemory& memory, const ChannelMessage& message) {
    switch (static_cast<SystemKind>(message.status)) {
        case SystemKind::Reset:
            memory = make_controller_memory();  // what came before counts no more
            memory.system[0] = message;
            break;
        case SystemKind::MasterVolume:
            memory.system[1] = message;
            break;
        case SystemKind::MasterFine:
            memory.system[2] = message;
            break;
        case SystemKind::MasterCoarse:
            memory.system[3] = message;
            break;
        case SystemKind::Rhythm:
            if (message.data1 < memory.rhythm.size()) memory.rhythm[message.data1] = message.data2;
            break;
        default:
            remember_tuning(memory.tunings, message);
            break;
    }
}

}  // namespace

ControllerMemory make_controller_memory() {
    ControllerMemory memory;
    for (ChannelMemory& channel : memory.channels) {
        channel.controllers.fill(-1);
        channel.registered_coarse.fill(-1);
        channel.registered_fine.fill(-1);
    }
    return memory;
}

void remember(ControllerMemory& memory, const ChannelMessage& message) JAWARI_REALTIME {
    if (is_system(message)) remember_system(memory, message);
    if (message.status < 0x80 || message.status >= 0xF0 || message.data1 > 127 || message.data2 > 127) return;
    ChannelMemory& channel = memory.channels[static_cast<std::size_t>(channel_of(message))];
    switch (kind_of(message)) {
        case MessageKind::PitchBend:
            channel.bend = message.data1 + 128 * message.data2;
            return;
        case MessageKind::ChannelPressure:
            channel.pressure = message.data1;
            return;
        case MessageKind::ControlChange:
            break;
        default:
            return;
    }
    const int controller = message.data1;
    if (controller == data_coarse || controller == data_fine)
        remember_data(channel, controller, message.data2);
    if (controller >= nrpn_fine && controller <= rpn_coarse)
        remember_selection(channel, controller, message.data2);
    if (controller == reset_all_controllers) reset_controllers(channel);
    if (controller == mono_on || controller == poly_on)
        remember_mode(memory, static_cast<std::size_t>(channel_of(message)), controller, message.data2);
    channel.controllers[static_cast<std::size_t>(controller)] = message.data2;
}

}  // namespace jawari::host
