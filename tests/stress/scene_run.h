// One hostile scene: played with all checks, then again with other block sizes.
#pragma once

#include <cstdint>

#include "report.h"

namespace jawari::stress {

Report run_scene(std::uint64_t seed, const Budget& budget);

}  // namespace jawari::stress
