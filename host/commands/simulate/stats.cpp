#include "commands/simulate/stats.h"

#include <algorithm>

#include "jawari/scene/cost.h"
#include "jawari/scene/energy.h"

namespace jawari::host {

namespace {

StringStats collect_string(const StringDescription& described, const StringModel& model,
                           const StringState& state) {
    StringStats stats;
    stats.name = model.shape->name;
    stats.start = described.initial.start;
    stats.modes = model.shape->mode_count;
    stats.contacts = model.shape->contact_count;
    stats.counters = state.counters;
    stats.initial_energy_J = state.energy.initial;
    stats.final_energy_J = energy(model, state);
    stats.highest_energy_J = std::max(state.energy.highest, stats.initial_energy_J);
    return stats;
}

}  // namespace

SimulationStats collect_stats(const Scene& scene, const SceneModel& model, const SceneState& state,
                              Metering metering, std::uint64_t rows) {
    SimulationStats stats;
    stats.scene = scene.file;
    stats.settings = scene.description;
    stats.settings.strings.clear();
    stats.duration_s = scene.duration_s;
    stats.metering = metering;
    stats.rows = rows;
    stats.sound_s = static_cast<double>(rows - 1) / model.output_rate_hz;
    stats.worst_frame_multiply_adds = worst_frame_cost(model);
    for (std::size_t s = 0; s < model.strings.size(); ++s)
        stats.strings.push_back(
            collect_string(scene.description.strings[s], model.strings[s], state.strings[s]));
    return stats;
}

Counters total_counters(const SimulationStats& stats) {
    Counters total;
    for (const StringStats& string : stats.strings) total += string.counters;
    return total;
}

std::optional<double> real_time_factor(const SimulationStats& stats) {
    if (stats.cpu_render_s <= 0 || stats.sound_s <= 0) return std::nullopt;
    return stats.sound_s / stats.cpu_render_s;
}

std::optional<double> energy_max_over_initial(const StringStats& string) {
    if (string.initial_energy_J <= 0) return std::nullopt;
    return string.highest_energy_J / string.initial_energy_J;
}

std::optional<double> energy_max_over_initial(const SimulationStats& stats) {
    std::optional<double> largest;
    for (const StringStats& string : stats.strings)
        if (const auto ratio = energy_max_over_initial(string))
            largest = std::max(largest.value_or(0.0), *ratio);
    return largest;
}

}  // namespace jawari::host
