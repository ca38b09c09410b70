// MIDI messages in words.
#pragma once

#include <string>

#include "midi/channel_message.h"

namespace jawari::host {

/// `ch 1  note on   E2  (40)  velocity 100`
std::string message_text(const ChannelMessage& message);

/// `E2`, `F#3`; C4 is 60.
std::string key_name(int key);

}  // namespace jawari::host
