// The state of a string at t = 0, and the one in which it restarts.
#pragma once

#include <optional>
#include <string>

#include "jawari/result.h"
#include "string/compile/string_draft.h"

namespace jawari {

/// A free string has a past in free motion; one that obstacles hold was at rest against them before t = 0.
/// `place`: of the string, for the failure that its obstacles leave no room.
std::optional<Failure> set_initial_state(StringDraft& draft, const StringDescription& string,
                                         const std::string& place);

}  // namespace jawari
