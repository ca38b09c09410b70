// How the strings of an instrument move, and where they strike: for pictures of them. Reading changes nothing
// that is heard.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Points of a string at which string_shape() gives its displacement, both ends left out.
inline constexpr std::size_t shape_points = 63;

/// What a string does now.
struct StringMotion {
    bool moves = false;       ///< a voice of it is not idle
    std::size_t fret = 0;     ///< at which it is stopped, 0 is open
    double length_m = 0;      ///< from there to the bridge [m]
    double frequency_hz = 0;  ///< of its first partial, bends included [Hz]
};

/// Of string `string` (index): of the voice that has its note, else of one that still moves. A string at rest
/// has zeros alone. Threads: one at a time per state; realtime-safe.
StringMotion string_motion(const InstrumentModel& model, const InstrumentState& state,
                           std::size_t string) JAWARI_REALTIME;

/// Displacement of the voice of string_motion() from the line between its ends, up is positive [m]: point j
/// is (j + 1) / (shape_points + 1) of the way from the stop to the bridge. Zeros for a string at rest. Costs
/// shape_points^2 / 2 multiplications beside one pass over the modes. Threads: one at a time per state;
/// realtime-safe.
void string_shape(const InstrumentModel& model, const InstrumentState& state, std::size_t string,
                  std::span<double, shape_points> heights_m) JAWARI_REALTIME;

/// From now on impulses are added up by string and place (ImpactLog), or no longer. Sums so far are
/// forgotten. Threads: one at a time per state; realtime-safe.
void watch_impacts(InstrumentState& state, bool on) JAWARI_REALTIME;

/// Adds to `sums_Ns` what string `string` (index) has given to its obstacles since it was asked before, and
/// forgets it: place p covers the distances from the bridge from p to p + 1, in shares of the longest
/// speaking length by impact_places [N s]. False if there was nothing. Threads: one at a time per state;
/// realtime-safe.
bool take_impacts(InstrumentState& state, std::size_t string,
                  std::span<float, impact_places> sums_Ns) JAWARI_REALTIME;

}  // namespace jawari
