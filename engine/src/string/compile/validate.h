// Checks a description value by value before anything is computed from it.
#pragma once

#include <optional>

#include "jawari/result.h"
#include "jawari/scene/description.h"

namespace jawari {

/// The first value that is not allowed, if any.
std::optional<Failure> validate(const SceneDescription& scene);

/// Prints a double so that it reads back the same.
std::string printed(double value);

}  // namespace jawari
