// Stopped strings as geometry: frets, pitches, speaking lengths, tension, and the contacts beyond the stop.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "jawari/instrument/description.h"

namespace jawari {

inline const FretsDescription& frets_of(const InstrumentDescription& instrument,
                                        const InstrumentStringDescription& string) {
    return string.frets ? *string.frets : instrument.frets;
}

/// Above the open string; 0 for fret 0.
int semitones_of(const FretsDescription& frets, std::size_t fret);

/// Speaking length as described, without regard to a tuning [m].
double described_length(const InstrumentStringDescription& string, const FretsDescription& frets,
                        std::size_t fret);

/// Whether a list of strings, empty for all, names string `index`.
inline bool applies_to(const std::vector<std::size_t>& strings, std::size_t index) {
    return strings.empty() || std::find(strings.begin(), strings.end(), index) != strings.end();
}

/// Distance from the bridge [m].
inline double from_bridge(const StringPlace& place, double length_m) {
    return place.share > 0 ? place.share * length_m : place.from_bridge_m;
}

/// First partial of a note [Hz]: the tuning's, else equal temperament from the open string. NaN if the tuning
/// leaves the key unmapped.
double note_frequency(const InstrumentDescription& instrument, const InstrumentStringDescription& string,
                      std::size_t fret);

/// The string `index` stopped at `fret` as a description: what compile_instrument() compiles. Precondition:
/// values are in their ranges, the note has a frequency.
StringDescription stopped_string(const InstrumentDescription& instrument, std::size_t index,
                                 std::size_t fret);

/// For each contact of stopped_string(): whether it is a fret or below the string on the neck.
std::vector<bool> contacts_on_neck(const InstrumentDescription& instrument, std::size_t index,
                                   std::size_t fret);

}  // namespace jawari
