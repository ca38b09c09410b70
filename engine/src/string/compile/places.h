// Where something acts on a string or reads it: values of the mode shapes in the engine's coordinates, and
// all contacts of a description in one list.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/scene/description.h"

namespace jawari {

/// A contact of the model before it has a row: one that is described, one of a hammer, or one of a spring.
struct ContactPlace {
    ContactDescription contact;
    std::optional<std::size_t> hammer;  ///< its index
};

/// The described contacts, then one for each hammer, then those of the springs: a spring presses from both
/// sides, and so does a dashpot.
std::vector<ContactPlace> contact_places(const StringDescription& string);

/// row <- sign phi_k at a place, 0 at the hammers' modes. `row`: StringShape::mode_count values.
void write_shape(const StringShape& shape, const StringDescription& string, double position_m,
                 std::size_t point, double sign, double* row);

/// What a hammer's coordinate has to be multiplied with to give its displacement [m]: sqrt(mu/m).
double hammer_unit(const StringShape& shape, const FlyingHammer& hammer);

/// The mode of a hammer.
std::size_t hammer_mode(const StringShape& shape, std::size_t hammer);

/// The string's own modes, without those of hammers.
std::size_t own_mode_count(const StringShape& shape);

}  // namespace jawari
