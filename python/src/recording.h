// A scene simulated from t = 0 to its end, with everything in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "commands/simulate/options.h"
#include "commands/simulate/row_renderer.h"
#include "commands/simulate/stats.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/scene.h"

namespace jawari::python {

/// What a string holds besides its rows.
struct StringFacts {
    std::string name;
    double length_m = 0;
    double linear_density_kg_per_m = 0;
    std::vector<double> contact_position_m, contact_height_m, contact_restitution;  ///< as described
    std::vector<std::string> contact_side;
    std::vector<double> contact_takes_part;  ///< 0: dropped by compile()
    std::vector<double> frequency_hz, decay_per_s;
    std::vector<double> final_displacement, final_velocity;  ///< modal, backward velocity
};

struct Recording {
    host::SimulationStats stats;
    std::vector<host::ProbeLabel> labels;
    std::vector<std::vector<double>> probes;  ///< per probe, one value a row
    std::vector<host::StringRows> rows;       ///< per string; empty unless asked for
    std::vector<StringFacts> strings;
    std::vector<std::string> warnings;
};

struct RecordOptions {
    host::Overrides overrides;
    Skipping skipping;
    bool meter_steps = false;
    bool with_contacts = true;
};

/// Asked every few hundredths of a second; an error ends the simulation.
using Poll = std::function<host::MaybeError()>;

host::Outcome<Recording> record(host::Scene scene, const RecordOptions& options, const Poll& poll);

/// A duration that is not in the scene file's range is refused here; the engine knows none.
host::MaybeError check_duration(double duration_s);

}  // namespace jawari::python
