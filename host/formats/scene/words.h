// The words of the scene format for the engine's enumerations, for messages and outputs.
#pragma once

#include <string>

#include "jawari/scene/description.h"

namespace jawari::host {

std::string word(Scheme scheme);
std::string word(ImpactLaw law);
std::string word(Start start);
std::string word(Side side);
std::string word(Quantity quantity);

/// `m`, `m/s`, `m/s^2`, `1`, `N`, `J`; modal coordinates `m^1.5`, or `m` where shapes are tabled.
std::string unit(Quantity quantity, bool tabled_shapes);

}  // namespace jawari::host
