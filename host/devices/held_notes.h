// What one keyboard holds down, so that it can be let go when the keyboard is gone.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "midi/channel_message.h"
#include "midi/interpreter.h"

namespace jawari::host {

struct HeldNotes {
    /// Note-ons without their note-off: each of them needs one.
    std::array<std::array<std::uint8_t, 128>, midi_channel_count> keys{};
    /// Sustain, sostenuto and hold 2.
    std::array<std::bitset<midi_channel_count>, 3> pedals;
    std::bitset<midi_channel_count> bends;  ///< off the centre
};

/// Allocates nothing.
void follow(HeldNotes& held, const ChannelMessage& message);

/// The messages that let go of all of it: note-offs, pedals up, wheels to the centre. Empties `held`.
std::vector<ChannelMessage> release_all(HeldNotes& held);

}  // namespace jawari::host
