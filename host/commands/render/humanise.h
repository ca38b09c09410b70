// Small irregularities of a player, the same for the same seed on every machine.
#pragma once

#include <cstdint>

#include "commands/render/score.h"

namespace jawari::host {

inline constexpr double latest_human_s = 0.012;  ///< notes come up to this late
inline constexpr double human_velocity = 0.12;   ///< velocities change by up to this share

/// Each note-on comes late by a random time and is louder or softer, both triangularly distributed; its
/// note-off comes late by the same time, so that lengths stay. Events of a note keep their order. Other
/// events stay where they are; so does the end of the score, but for note-offs.
void humanise(Score& score, std::uint64_t seed, double rate_hz);

}  // namespace jawari::host
