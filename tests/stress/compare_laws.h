// The impact laws side by side on the same hostile strings, left to themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari::stress {

struct LawRecord {
    ImpactLaw law{};
    std::size_t scenes = 0;
    std::uint64_t impulses = 0;
    std::size_t rose = 0;      ///< scenes in which H came to exceed its start by a millionth
    std::size_t exploded = 0;  ///< by more than 1e100
    double largest_gain = 0;   ///< largest H/H at the start
    double deepest = 0;        ///< penetration, in typical heights of the scene's obstacles
};

/// Strings that strike, of `seeds` seeds: obstacles at rest, no forces. `of_tables`: strings whose modes come
/// from tables, instead of those from physics.
std::vector<LawRecord> compare_laws(std::uint64_t seeds, bool of_tables);

}  // namespace jawari::stress
