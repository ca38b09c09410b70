// Which preset a MIDI program is: General MIDI's strings, and a bank of all presets by number
// (docs/formats/midi.md).
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace jawari::host {

/// Presets by number: program n of bank 1 (controller 0: 0, controller 32: 1). The order is frozen.
std::span<const std::string_view> numbered_presets();

inline constexpr int numbered_bank = 1;
/// Channel of General MIDI's drums, from 0.
inline constexpr int drum_channel = 9;

/// Name of the preset that plays a program; nothing if that is no instrument with strings to pluck or strike.
/// Banks other than numbered_bank are variations of General MIDI and play as bank 0.
std::optional<std::string_view> program_preset(int bank, int program);

}  // namespace jawari::host
