// "modes" of a string: physics or tables.
#pragma once

#include <string>
#include <variant>

#include "formats/json/object_reader.h"
#include "jawari/scene/description.h"

namespace jawari::host {

std::variant<PhysicalModes, ModeTable> read_modes(const json::Value& value, const std::string& path,
                                                  json::Problems& problems);

using Damping = std::variant<NoLoss, ValetteLoss, DecayTimePoints>;

/// "damping" of physical modes, also of an instrument's strings.
Damping read_damping(const json::Value& value, const std::string& path, json::Problems& problems);

}  // namespace jawari::host
