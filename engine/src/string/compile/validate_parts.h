// Checks of what acts on a string, and of what reads it. Precondition of all: its modes have been checked.
#pragma once

#include <cstddef>
#include <string>

#include "string/compile/validate.h"

namespace jawari::checks {

using detail::Check;
using detail::indexed_place;

/// Modes of the system itself, without hammers.
std::size_t own_modes(const StringDescription& string);

/// Places: 0 to L on a string, an index of ShapeTable::points else.
Check check_place(const std::string& place, const StringDescription& string, double position_m,
                  std::size_t point);

Check check_shapes(const std::string& place, const StringDescription& string);
Check check_initial(const std::string& place, const StringDescription& string);
/// Contacts, springs and hammers.
Check check_obstacles(const std::string& place, const StringDescription& string);
/// Forces and motions.
Check check_drives(const std::string& place, const StringDescription& string);
Check check_probes(const std::string& place, const StringDescription& string);
/// What the theta scheme does not have.
Check check_for_theta(const std::string& place, const StringDescription& string);

}  // namespace jawari::checks
