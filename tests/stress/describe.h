// One line that says what a scene is, for --verbose.
#pragma once

#include <string>

#include "hostile_instrument.h"
#include "hostile_scene.h"

namespace jawari::stress {

std::string describe(const HostileScene& hostile);
std::string describe(const HostileInstrument& hostile);

}  // namespace jawari::stress
