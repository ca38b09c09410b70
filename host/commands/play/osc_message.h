// Open Sound Control 1.0 packets, as far as commands need them, read and written through liblo.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "commands/play/verbs.h"

namespace jawari::host {

struct OscMessage {
    std::string path;
    std::vector<VerbValue> arguments;
};

inline constexpr std::size_t longest_osc_packet = 8192;
inline constexpr std::size_t most_osc_messages = 64;  ///< in one packet

/// The messages of a packet, those of bundles in order, whatever their time tags say. Arguments are i, h, f,
/// d, s, S, T and F. Anything else, and everything malformed, is an error.
Outcome<std::vector<OscMessage>> decode_osc(std::span<const char> packet);

/// A packet with one message; texts become s, numbers f.
std::vector<char> encode_osc(const OscMessage& message);

}  // namespace jawari::host
