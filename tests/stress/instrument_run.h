// One hostile performance: played with all checks, then again with other block sizes.
#pragma once

#include <cstdint>

#include "hostile_instrument.h"
#include "report.h"

namespace jawari::stress {

Report run_instrument(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget);

}  // namespace jawari::stress
