// Preset files ("jawari.preset/2", docs/formats/preset.md) and built-in instruments.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "jawari/instrument/description.h"

namespace jawari::host {

struct Preset {
    std::string file;  ///< the file's path or the built-in name, for messages
    InstrumentDescription instrument;
};

/// Reads a preset's text; every problem names `file`, the path inside it, the value and what is allowed.
/// Ranges of physical values are checked by compile_instrument(), which spells its places like this format.
Outcome<Preset> read_preset(const std::string& text, const std::string& file);

/// Sorted.
std::vector<std::string> builtin_preset_names();

}  // namespace jawari::host
