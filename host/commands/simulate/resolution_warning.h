// Whether the contact rate of a simulation is far too low for what its strings did.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/scene/description.h"

namespace jawari::host {

/// What a string is and did, as far as its contact rate is concerned.
struct StringResolution {
    std::string name;
    double motion_m = 0;  ///< size of the motion at t = 0, 0 for a string at rest
    double fundamental_hz = 0;
    double highest_hz = 0;  ///< of its modes
    std::uint64_t impulses = 0;
    double penetration_m = 0;        ///< the deepest
    double energy_J = 0;             ///< discrete, at t = 0
    double true_energy_J = 0;        ///< of the motion that the description gives
    double fastest_decay_per_s = 0;  ///< sigma, of the modes that move at t = 0
};

/// All but impulses and penetration. `start`: the state at t = 0. The motion's size is the amplitude that a
/// single mode of the same mean square would have: sqrt(2/L sum_k (q_k^2 + (v_k/omega_k)^2)).
StringResolution describe_resolution(const StringDescription& string, const StringModel& model,
                                     const StringState& start);

/// A line that starts with `warning:` if the answer is probably wrong by tens of percent; it names the string
/// that needs the highest rate, and that rate. The rule is in docs/commands/simulate.md, section "Warnings".
/// `settings`: rates, scheme and law in use.
std::optional<std::string> resolution_warning(const std::string& subject, const SceneDescription& settings,
                                              const std::vector<StringResolution>& strings);

}  // namespace jawari::host
