// A quantity that follows a table over time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "formats/json/object_reader.h"

namespace jawari::host {

/// Values at times, linear between them. Twice the same time is a jump, after which the later value holds.
struct TimeTable {
    std::vector<double> time_s;  ///< not decreasing, or empty: value n is at n/rate_hz
    std::vector<double> value;
    double rate_hz = 0;       ///< of values without times
    std::string sound;        ///< the file that the values come from, before load_sounds(); else empty
    double scale = 1;         ///< of the sound's samples
    std::size_t channel = 0;  ///< of the sound
    std::string place;        ///< in the scene file, for messages
};

/// What holds before the first time and after the last.
enum class Outside { Zero, Same };

/// The table at frames 0, 1, ... of the rate, until it ends, `most` at most.
std::vector<double> sample(const TimeTable& table, double rate_hz, std::size_t most, Outside outside);

/// Longest table.
inline constexpr std::size_t most_table_values = 4'000'000;

/// Keys of a table: `time_s` and `value_key`, or `sound`, `channel` and `scale_key`.
std::vector<std::string_view> table_keys(std::string_view value_key, std::string_view scale_key);
TimeTable read_time_table(json::ObjectReader& reader, std::string_view value_key, std::string_view scale_key);

}  // namespace jawari::host
