// What a seed stands for: a scene or a performance.
#pragma once

#include <cstdint>

#include "hostile_instrument.h"
#include "report.h"

namespace jawari::stress {

/// Every third seed plays an instrument.
Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget);

}  // namespace jawari::stress
