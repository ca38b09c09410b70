// Parameters as users spell them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "jawari/parameters.h"

namespace jawari::host {

/// Null if there is none of that key.
const ParameterDeclaration* find_parameter(std::string_view key);

std::vector<std::string> parameter_keys();

/// `0 to 2 semitones`
std::string parameter_range(const ParameterDeclaration& parameter);

}  // namespace jawari::host
