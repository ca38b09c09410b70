// What one keyboard holds down, so that it can be let go when the keyboard is gone.
#pragma once

#include <array>
#include <bitset>
#include <vector>

#include "midi/channel_message.h"
#include "midi/interpreter.h"

namespace jawari::host {

struct HeldNotes {
    std::array<std::bitset<128>, midi_channel_count> keys;
    std::bitset<midi_channel_count> pedals;  ///< sustain
    std::bitset<midi_channel_count> bends;   ///< off the centre
};

/// Allocates nothing.
void follow(HeldNotes& held, const ChannelMessage& message);

/// The messages that let go of all of it: note-offs, pedals up, wheels to the centre. Empties `held`.
std::vector<ChannelMessage> release_all(HeldNotes& held);

}  // namespace jawari::host
