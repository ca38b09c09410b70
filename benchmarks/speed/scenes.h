// The scenes whose cost is measured.
#pragma once

#include <cstddef>
#include <string>

#include "jawari/description.h"

namespace jawari::benchmarks {

/// A built-in scene at other rates and with another law and restitution of all contacts.
SceneDescription builtin(const std::string& name, double output_rate_hz, double contact_rate_hz,
                         ImpactLaw law, double restitution);

/// Strings of a steel-string guitar in standard tuning, the first `strings` of them counted from the highest:
/// 22 frets each, modes to `highest_mode_hz`, plucked so that they strike. Densities and losses are typical
/// values.
SceneDescription guitar(std::size_t strings, double output_rate_hz, double contact_rate_hz,
                        double highest_mode_hz);

}  // namespace jawari::benchmarks
