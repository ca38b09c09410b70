// The frequency of each of the 128 MIDI keys: what every tuning comes to.
#pragma once

#include <array>
#include <cstddef>

namespace jawari::host {

inline constexpr std::size_t midi_keys = 128;

/// Frequencies in Hz; NaN: the key is silent.
using KeyFrequencies = std::array<double, midi_keys>;

/// Frequencies that a key can have [Hz]: what is heard.
inline constexpr double lowest_key_hz = 1;
inline constexpr double highest_key_hz = 20000;

}  // namespace jawari::host
