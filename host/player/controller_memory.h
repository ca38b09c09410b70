// What controllers, bends, data entry and tunings have set so far: a recording that begins later starts with
// it, so that its messages alone reproduce it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "jawari/realtime.h"
#include "midi/channel_message.h"
#include "midi/system_message.h"
#include "player/tuning_memory.h"

namespace jawari::host {

struct ChannelMemory {
    std::array<int, 128> controllers{};  ///< last values; -1: never sent
    int bend = -1;                       ///< 14 bits; -1: never sent
    int pressure = -1;
    int mono = -1;  ///< 1: mode 4, 0: mode 3; -1: never sent
    /// Coarse and fine values of RPN 0 to 2 and of RPN 6 (an MPE zone, on its manager); -1: never sent.
    std::array<int, 7> registered_coarse{}, registered_fine{};
    int selected = -1;  ///< RPN that data entry speaks to; -1: none of these
};

struct ControllerMemory {
    std::array<ChannelMemory, 16> channels;
    /// The latest reset, master volume and master tunings; status 0: none has come.
    std::array<ChannelMessage, 4> system{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    TuningMemory tunings = make_tuning_memory();
    std::array<int, 16> rhythm{-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
};

ControllerMemory make_controller_memory();

void remember(ControllerMemory& memory, const ChannelMessage& message) JAWARI_REALTIME;

/// At most this many messages say it all.
inline constexpr std::size_t most_recalled_messages =
    std::size_t{16} * (128 + 3 + 7 * 6 + 1) + 4 + most_recalled_tunings;

namespace detail {

/// Set by other means than their last value: bank, data entry and its selection, modes; or for one note:
/// velocity prefix, portamento control.
constexpr bool is_recalled(int controller) {
    return controller != 0 && controller != 32 && controller != 6 && controller != 38 && controller != 84 &&
           controller != 88 && !(controller >= 96 && controller <= 101) && controller < 120;
}

template <class Sink>
void recall_registered(const ChannelMemory& channel, std::uint8_t control, int number, const Sink& sink) {
    const auto at = static_cast<std::size_t>(number);
    if (channel.registered_coarse[at] < 0) return;
    const auto send = [&](int controller, int value) {
        sink(
            ChannelMessage{control, static_cast<std::uint8_t>(controller), static_cast<std::uint8_t>(value)});
    };
    send(101, 0);
    send(100, number);
    send(6, channel.registered_coarse[at]);
    if (channel.registered_fine[at] >= 0) send(38, channel.registered_fine[at]);
    send(101, 127);
    send(100, 127);
}

}  // namespace detail

/// Calls sink(message): the whole instrument first, then zones, for they reset their channels; then each
/// channel's tuning and controllers.
template <class Sink>
void recall(const ControllerMemory& memory, const Sink& sink) {
    for (const ChannelMessage& message : memory.system)
        if (message.status != 0) sink(message);
    for (std::uint8_t c = 0; c < 16; ++c)
        if (memory.rhythm[c] >= 0)
            sink(ChannelMessage{static_cast<std::uint8_t>(SystemKind::Rhythm), c,
                                static_cast<std::uint8_t>(memory.rhythm[c])});
    recall_tunings(memory.tunings, sink);
    for (std::uint8_t c = 0; c < 16; ++c)
        detail::recall_registered(memory.channels[c], static_cast<std::uint8_t>(0xB0 + c), 6, sink);
    for (std::uint8_t c = 0; c < 16; ++c) {
        const ChannelMemory& channel = memory.channels[c];
        const auto control = static_cast<std::uint8_t>(0xB0 + c);
        for (const int number : {0, 1, 2, 3}) detail::recall_registered(channel, control, number, sink);
        if (channel.mono >= 0)
            sink(ChannelMessage{control, static_cast<std::uint8_t>(channel.mono > 0 ? 126 : 127),
                                static_cast<std::uint8_t>(channel.mono)});
        for (int controller = 0; controller < 128; ++controller) {
            const int value = channel.controllers[static_cast<std::size_t>(controller)];
            if (value < 0 || !detail::is_recalled(controller)) continue;
            sink(ChannelMessage{control, static_cast<std::uint8_t>(controller),
                                static_cast<std::uint8_t>(value)});
        }
        if (channel.bend >= 0)
            sink(ChannelMessage{static_cast<std::uint8_t>(0xE0 + c),
                                static_cast<std::uint8_t>(channel.bend % 128),
                                static_cast<std::uint8_t>(channel.bend / 128)});
        if (channel.pressure >= 0)
            sink(ChannelMessage{static_cast<std::uint8_t>(0xD0 + c),
                                static_cast<std::uint8_t>(channel.pressure), 0});
    }
}

}  // namespace jawari::host
