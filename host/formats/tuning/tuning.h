// A scale on a keyboard: the frequency of each of the 128 MIDI keys.
#pragma once

#include <optional>
#include <string>

#include "base/error.h"
#include "formats/tuning/ableton.h"
#include "formats/tuning/key_frequencies.h"
#include "formats/tuning/keyboard_map.h"
#include "formats/tuning/scale.h"

namespace jawari::host {

/// Key k plays the degree that the map gives to (k - middle key) modulo its size, raised by as many formal
/// octaves as the pattern has repeated; a linear map (size 0) plays degree k - middle key. The reference
/// key's frequency fixes the pitch. Keys outside first_key to last_key are not retuned: they keep equal
/// temperament at 440 Hz. Keys that would
/// lie outside lowest_key_hz to highest_key_hz are silent. Fails if the reference key is silent.
Result<KeyFrequencies> tune(const Scale& scale, const KeyboardMap& map);

/// As the lines say that Ableton adds to a scale: where its notes lie and which of them there are.
Result<KeyFrequencies> tune(const Scale& scale, const AbletonLines& lines);

/// A file's text, and the name that messages give it.
struct NamedText {
    std::string name, text;
};

/// load_tuning() from texts; the scale's name tells whether it is a .tun file.
Outcome<KeyFrequencies> read_tuning(const NamedText& scale, const std::optional<NamedText>& keyboard_map);

/// `scale`: a Scala scale, with what Ableton adds to it, or a .tun file. An empty `keyboard_map` path stands
/// for the default map; .tun files take none. Messages name file and line.
Outcome<KeyFrequencies> load_tuning(const std::string& scale, const std::string& keyboard_map);

}  // namespace jawari::host
