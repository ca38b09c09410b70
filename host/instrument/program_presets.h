// Which preset a MIDI program is: General MIDI's strings, and a bank of all presets by number
// (docs/formats/midi.md).
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace jawari::host {

/// Presets by number: program n of numbered_bank. The order is frozen.
std::span<const std::string_view> numbered_presets();

/// Controller 0: 74 (J), controller 32: 87 (W). General MIDI 2 uses 120 and 121, GS 0 to 127 with a fine half
/// of 0 to 4, XG 0, 64, 126 and 127: none of them this.
inline constexpr int numbered_bank = 74 * 128 + 87;

/// Name of the preset that plays a program; nothing if that is no instrument with strings to pluck or strike.
/// Banks other than numbered_bank are variations of General MIDI and play as bank 0.
std::optional<std::string_view> program_preset(int bank, int program);

/// Name of the preset that is nearest to a program of General MIDI which program_preset() does not have:
/// in register and in how its notes begin. Nothing for percussion without a pitch and for sound effects.
std::optional<std::string_view> nearest_preset(int program);

/// Presets that may play keys below (or above) those that a preset has strings for, the first one first.
std::span<const std::string_view> neighbour_presets(std::string_view preset, bool below);

}  // namespace jawari::host
