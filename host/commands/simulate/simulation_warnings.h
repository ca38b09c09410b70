// All that makes the numbers of a simulation doubtful: lines for the user.
#pragma once

#include <string>
#include <vector>

#include "commands/simulate/resolution_warning.h"
#include "commands/simulate/stats.h"

namespace jawari::host {

/// One per string, of the state at t = 0.
std::vector<StringResolution> resolutions_at_start(const SceneDescription& scene, const SceneModel& model,
                                                   const SceneState& start);

/// Lines that start with `warning:`. `resolutions`: of the same strings at t = 0.
std::vector<std::string> simulation_warnings(const SimulationStats& stats,
                                             std::vector<StringResolution> resolutions);

}  // namespace jawari::host
