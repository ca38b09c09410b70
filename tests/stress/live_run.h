// One hostile live performance: instruments exchanged while notes sound.
#pragma once

#include <cstdint>

#include "hostile_instrument.h"
#include "report.h"

namespace jawari::stress {

Report run_live(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget);

}  // namespace jawari::stress
