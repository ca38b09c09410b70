// What makes the numbers of a run doubtful, as counters of its contacts tell: lines for the user.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "jawari/scene/counters.h"

namespace jawari::host {

/// The counters of one string, or of one instrument.
struct NamedCounters {
    std::string name;
    Counters counters;
};

/// Contact problems that were not solved to their end, and states that were not finite: a line that starts
/// with `warning:` for each kind that occurred. `subject`: the file that was computed. `kind`: "string" or
/// "preset".
std::vector<std::string> contact_warnings(const std::string& subject, const std::string& kind,
                                          const std::vector<NamedCounters>& parts);

/// What --strict makes of `warnings` warnings, which are printed already; empty if there are none.
MaybeError strict_error(const std::string& subject, std::size_t warnings);

}  // namespace jawari::host
