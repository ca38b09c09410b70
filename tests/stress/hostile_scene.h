// Scenes at the edges of what compile() accepts, each named by a seed.
#pragma once

#include <cstdint>
#include <string>

#include "jawari/detail/string_state.h"
#include "jawari/scene/description.h"
#include "jawari/scene/skipping.h"

namespace jawari::stress {

struct HostileScene {
    std::string kind;  ///< what is hostile about it: statistics group by it
    SceneDescription description;
    Metering metering = Metering::Off;
    Skipping skipping;
    bool forces = false;     ///< external forces are switched at random
    bool moves = false;      ///< obstacles move; metered at every step
    bool denormals = false;  ///< left on, as embedders may; else off, as when jawari plays and renders
    double height_m = 0;     ///< of obstacles and forces
};

/// From this seed on scenes also have what laboratories have: compliant contacts, springs, hammers. A seed
/// below it means what it has meant before there were any.
inline constexpr std::uint64_t first_laboratory_seed = 200000;

HostileScene make_hostile_scene(std::uint64_t seed);

}  // namespace jawari::stress
