// Scala keyboard maps (.kbm): which key plays which degree of a scale, and at which pitch.
// https://www.huygens-fokker.org/scala/help.htm#mappings
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/tuning/key_frequencies.h"
#include "jawari/result.h"

namespace jawari::host {

/// Defaults: what holds without a file. Degree 0 on middle C at its pitch in equal temperament, a degree a
/// key.
struct KeyboardMap {
    int first_key = 0;    ///< keys below it are not retuned
    int last_key = 127;   ///< keys above it are not retuned
    int middle_key = 60;  ///< of the first entry of the pattern
    int reference_key = 60;
    double reference_hz = 261.6255653005986;  ///< 440 2^(-9/12)
    /// Degree whose pitch is the distance between two repetitions of the pattern; 0: the scale's last.
    int formal_octave = 0;
    /// Degree of each key of the pattern, nothing if the key is silent. Empty: linear, a degree a key.
    std::vector<std::optional<int>> degrees;
};

inline constexpr std::size_t most_map_keys = 1024;
inline constexpr int largest_map_degree = 16384;

/// Failure::place is the line.
Result<KeyboardMap> parse_keyboard_map(std::string_view text);

}  // namespace jawari::host
