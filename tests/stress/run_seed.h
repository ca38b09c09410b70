// What a seed stands for: a scene or a performance.
#pragma once

#include <cstdint>
#include <string>

#include "hostile_instrument.h"
#include "report.h"

namespace jawari::stress {

/// Every third seed plays an instrument.
bool plays_instrument(std::uint64_t seed);

Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget);

/// One line.
std::string describe_seed(const PresetShelf& shelf, std::uint64_t seed);

}  // namespace jawari::stress
