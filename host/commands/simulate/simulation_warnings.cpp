#include "commands/simulate/simulation_warnings.h"

#include <utility>

#include "cli/contact_warnings.h"

namespace jawari::host {

std::vector<StringResolution> resolutions_at_start(const SceneDescription& scene, const SceneModel& model,
                                                   const SceneState& start) {
    std::vector<StringResolution> resolutions;
    for (std::size_t s = 0; s < model.strings.size(); ++s)
        resolutions.push_back(describe_resolution(scene.strings[s], model.strings[s], start.strings[s]));
    return resolutions;
}

std::vector<std::string> simulation_warnings(const SimulationStats& stats,
                                             std::vector<StringResolution> resolutions) {
    std::vector<NamedCounters> strings;
    for (std::size_t s = 0; s < stats.strings.size(); ++s) {
        const StringStats& string = stats.strings[s];
        strings.push_back({string.name, string.counters});
        // What truncated solves let through is not the contact rate's doing.
        if (string.counters.truncated_solves == 0) resolutions[s].impulses = string.counters.impulses;
        resolutions[s].penetration_m = string.counters.worst_penetration_m;
    }
    auto lines = contact_warnings(stats.scene, "string", strings);
    if (auto line = resolution_warning(stats.scene, stats.settings, resolutions))
        lines.push_back(std::move(*line));
    return lines;
}

}  // namespace jawari::host
