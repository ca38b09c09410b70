// Names of what the interpreter ignores, for notices.
#pragma once

#include <string>

#include "midi/interpreter.h"

namespace jawari::host {

/// `controller 91 (reverb)`
std::string controller_kind(int controller);

/// The kind of a message for which MidiActions::ignored was set: `controller 91 (reverb)`.
std::string ignored_kind(const MidiInterpreter& interpreter, const ChannelMessage& message);

}  // namespace jawari::host
