// Scala scale files (.scl): https://www.huygens-fokker.org/scala/scl_format.html
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "jawari/result.h"

namespace jawari::host {

struct Scale {
    std::string description;
    /// Degrees 1, 2, ...; degree 0 is 0 cents. The last one is the interval at which the scale repeats.
    std::vector<double> cents;
};

inline constexpr double cents_per_octave = 1200;
inline constexpr std::size_t most_scale_notes = 16384;
inline constexpr double largest_scale_cents = 120000;  ///< 100 octaves, up or down
inline constexpr std::size_t longest_scala_file_bytes = std::size_t{1} << 20U;

/// Ratios (`3/2`, `2`) and cents (`701.955`, with a period); what follows a value after a space is ignored.
/// Failure::place is the line.
Result<Scale> parse_scale(std::string_view text);

/// Any degree, below 0 and above the last too: the scale repeats. A scale without notes is its first degree.
double degree_cents(const Scale& scale, long long degree);

}  // namespace jawari::host
