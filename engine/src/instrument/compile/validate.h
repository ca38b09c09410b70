// Checks an instrument's description value by value before anything is computed from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jawari/instrument/description.h"
#include "jawari/result.h"
#include "string/compile/checks.h"

namespace jawari {

namespace detail {

struct CheckedValue {
    const char* name;
    double value;
    double low;
    double high;
};

/// Fails unless low <= value <= high; also for NaN.
Check check_values(const std::string& prefix, std::initializer_list<CheckedValue> values);
/// Exciters, hand, pickups and body; `shortest_m`: the shortest speaking length.
Check validate_players(const InstrumentDescription& instrument, double shortest_m);
Check validate_output(const InstrumentDescription& instrument, double shortest_m);
Check check_place(const std::string& place, const StringPlace& value, double shortest_m);

}  // namespace detail

/// The first value that is not allowed, if any.
std::optional<Failure> validate(const InstrumentDescription& instrument, double output_rate_hz);

}  // namespace jawari
