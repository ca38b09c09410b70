// Names of keys.
#pragma once

#include <array>
#include <string>

namespace jawari::host::window {

/// `C4` for 60. `key`: a MIDI note number.
inline std::string note_name(int key) {
    constexpr std::array<const char*, 12> names{"C",  "C#", "D",  "D#", "E",  "F",
                                                "F#", "G",  "G#", "A",  "A#", "B"};
    if (key < 0) return "-";
    return names[static_cast<std::size_t>(key % 12)] + std::to_string(key / 12 - 1);
}

}  // namespace jawari::host::window
