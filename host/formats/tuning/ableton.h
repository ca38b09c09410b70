// Ableton's additions to Scala scales (.ascl), in comment lines that begin with `! @ABL`: the pitch of a
// reference note, and the range of notes.
// https://help.ableton.com/hc/en-us/articles/10998372840220-ASCL-Specification
#pragma once

#include <limits>
#include <optional>
#include <string_view>

#include "formats/tuning/keyboard_map.h"
#include "formats/tuning/scale.h"
#include "jawari/result.h"

namespace jawari::host {

/// What the lines say about keys. Notes are counted from index 0 of the reference note's octave.
struct AbletonLines {
    struct Reference {
        int octave = 0;
        int index = 0;  ///< in its octave, 0 is the scale's first degree
        double hz = 0;
    };
    std::optional<Reference> reference;
    double lowest_hz = 0, highest_hz = std::numeric_limits<double>::infinity();
    std::optional<long long> lowest_note, highest_note;
};

inline constexpr int lowest_ableton_octave = -2, highest_ableton_octave = 8;
inline constexpr int furthest_range_octave = 100;  ///< up and down, of a range by index

/// Of a text that parse_scale() has read. Failure::place is the line.
Result<AbletonLines> parse_ableton_lines(std::string_view text, const Scale& scale);

/// A degree a key. With a reference the degree that is nearest to middle C lies on key 60.
KeyboardMap ableton_map(const Scale& scale, const AbletonLines& lines);

}  // namespace jawari::host
