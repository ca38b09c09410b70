// What the command line of `jawari simulate` says.
#pragma once

#include <optional>
#include <string>

#include "jawari/scene/description.h"
#include "jawari/scene/resolution.h"
#include "jawari/scene/skipping.h"

namespace jawari::host {

/// Settings that replace those of the scene file.
struct Overrides {
    std::optional<double> output_rate_hz;
    std::optional<double> contact_rate_hz;
    std::optional<double> duration_s;
    std::optional<Scheme> scheme;
    std::optional<double> theta;
    std::optional<ImpactLaw> law;
    std::optional<Quality> quality;     ///< sets the modes, and the contact rate unless that is given too
    std::optional<double> restitution;  ///< of every contact
    std::optional<Start> start;         ///< of every string
};

struct SimulateOptions {
    std::string scene;  ///< a file or a built-in name
    Overrides overrides;
    Skipping skipping;
    bool meter_steps = false;  ///< the energy balance of each contact step
    bool strict = false;       ///< warnings are an error
    std::string out;           ///< empty: none; `-`: CSV on standard output
    std::string stats;         ///< empty: none; `-`: standard output
    std::string plot;          ///< empty: none
    std::string save_state;    ///< empty: none
    std::string resume;        ///< a saved state; empty: from t = 0
    bool overwrite = false;    ///< replaces files of other kinds too
};

}  // namespace jawari::host
