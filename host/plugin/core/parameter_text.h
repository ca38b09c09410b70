// Values of parameters as people read and write them in a host: `35 %`, `0.50 mm`, `1/3 of the string`;
// groups.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jawari/parameters.h"

namespace jawari::host {

/// `value`: in the parameter's unit, inside its range. Threads: any. Allocates.
std::string parameter_text(ParameterId parameter, double value);

/// The value that a text stands for, in the parameter's unit and inside its range: what parameter_text()
/// writes, a number with the same unit, or a number alone, which is taken in the shown unit. Nothing if the
/// text is no value. Threads: any.
std::optional<double> parameter_from_text(ParameterId parameter, std::string_view text);

/// The groups of the table, each once, in its order. Threads: any.
const std::vector<std::string_view>& parameter_groups();

}  // namespace jawari::host
