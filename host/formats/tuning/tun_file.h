// AnaMark tuning files (.tun), versions 0 to 2: the pitch of each key. Version 2: M. Henning, "Specifications
// AnaMark tuning file format", 2009.
#pragma once

#include <string_view>

#include "formats/tuning/key_frequencies.h"
#include "jawari/result.h"

namespace jawari::host {

/// [Exact Tuning] if it has notes, [Tuning] otherwise: both say what each key plays, [Mapping] is in them. A
/// file that has neither is read by its formulas and its mapping ([Functional Tuning], tun_formulas.h).
/// Several scales are refused. Failure::place is the line.
Result<KeyFrequencies> parse_tun(std::string_view text);

}  // namespace jawari::host
