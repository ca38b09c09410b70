// Checks a description value by value before anything is computed from it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "jawari/result.h"
#include "jawari/scene/description.h"

namespace jawari {

namespace detail {

/// What a value fails by, if it does.
using Check = std::optional<Failure>;

/// `list[i]`
std::string indexed_place(const std::string& list, std::size_t i);

}  // namespace detail

/// The first value that is not allowed, if any.
std::optional<Failure> validate(const SceneDescription& scene);

/// Prints a double so that it reads back the same.
std::string printed(double value);

}  // namespace jawari
