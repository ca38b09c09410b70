// A scale on a keyboard: the frequency of each of the 128 MIDI keys.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "base/error.h"
#include "formats/tuning/keyboard_map.h"
#include "formats/tuning/scale.h"

namespace jawari::host {

inline constexpr std::size_t midi_keys = 128;

/// Frequencies in Hz; NaN: the key is silent.
using KeyFrequencies = std::array<double, midi_keys>;

/// Key k plays the degree that the map gives to (k - middle key) modulo its size, raised by as many formal
/// octaves as the pattern has repeated; a linear map (size 0) plays degree k - middle key. The reference
/// key's frequency fixes the pitch. Keys outside first_key to last_key are not retuned: they keep equal
/// temperament at 440 Hz. Keys that would
/// lie outside lowest_key_hz to highest_key_hz are silent. Fails if the reference key is silent.
Result<KeyFrequencies> tune(const Scale& scale, const KeyboardMap& map);

/// Reads both files; an empty `keyboard_map` path stands for the default map. Messages name file and line.
Outcome<KeyFrequencies> load_tuning(const std::string& scale, const std::string& keyboard_map);

}  // namespace jawari::host
