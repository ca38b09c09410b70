// What a simulation did and what it cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

namespace jawari::host {

struct StringStats {
    std::string name;
    Start start = Start::Exact;
    std::size_t modes = 0;
    std::size_t contacts = 0;  ///< that take part; compile() drops those on the string's ends
    Counters counters;
    double initial_energy_J = 0;
    double final_energy_J = 0;
    double highest_energy_J = 0;
};

struct SimulationStats {
    std::string scene;
    SceneDescription settings;  ///< rates, scheme, theta and law as used; its strings are empty
    double duration_s = 0;      ///< as asked for
    Metering metering = Metering::Frame;
    std::uint64_t rows = 0;
    double sound_s = 0;  ///< time of the last row
    double cpu_compile_s = 0;
    double cpu_render_s = 0;
    double cpu_output_s = 0;
    double worst_frame_multiply_adds = 0;  ///< worst_frame_cost(): every contact pressed on in every step
    std::vector<StringStats> strings;
};

/// Times are left at zero.
SimulationStats collect_stats(const Scene& scene, const SceneModel& model, const SceneState& state,
                              Metering metering, std::uint64_t rows);

/// Counters of all strings: sums, and the worst of residuals and penetrations.
Counters total_counters(const SimulationStats& stats);

/// Seconds of sound per CPU second of rendering; empty if no time was measured.
std::optional<double> real_time_factor(const SimulationStats& stats);

/// H max/H0 of one string; empty if it starts without energy.
std::optional<double> energy_max_over_initial(const StringStats& string);

/// The largest of all strings; empty if none starts with energy.
std::optional<double> energy_max_over_initial(const SimulationStats& stats);

/// docs/commands/simulate.md, section "Statistics". Ends with a newline.
std::string stats_json(const SimulationStats& stats);

/// A few lines for a person.
std::string stats_summary(const SimulationStats& stats);

}  // namespace jawari::host
