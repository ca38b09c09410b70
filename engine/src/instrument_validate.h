// Checks an instrument's description value by value before anything is computed from it.
#pragma once

#include <optional>

#include "jawari/instrument_description.h"
#include "jawari/result.h"

namespace jawari {

/// The first value that is not allowed, if any.
std::optional<Failure> validate(const InstrumentDescription& instrument, double output_rate_hz);

/// Speaking length at a fret: length 2^(-fret/12) [m].
double speaking_length(double length_m, std::size_t fret);

}  // namespace jawari
