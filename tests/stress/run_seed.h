// What a seed stands for: a scene, a performance, or a live performance.
#pragma once

#include <cstdint>
#include <string>

#include "hostile_instrument.h"
#include "report.h"

namespace jawari::stress {

enum class SeedKind { Scene, Instrument, Live };

/// Of twelve seeds eight are scenes, three performances and one is played live.
SeedKind kind_of(std::uint64_t seed);

Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget);

/// One line.
std::string describe_seed(const PresetShelf& shelf, std::uint64_t seed);

}  // namespace jawari::stress
