// The scenes whose cost is measured.
#pragma once

#include <cstddef>
#include <string>

#include "jawari/scene/description.h"

namespace jawari::benchmarks {

/// A built-in scene at other rates and with another law and restitution of all contacts.
SceneDescription builtin(const std::string& name, double output_rate_hz, double contact_rate_hz,
                         ImpactLaw law, double restitution);

/// Strings of a steel-string guitar in standard tuning, the first `strings` of them counted from the highest:
/// 22 frets each, modes to `highest_mode_hz`, plucked so that they strike. Densities and losses are typical
/// values.
SceneDescription guitar(std::size_t strings, double output_rate_hz, double contact_rate_hz,
                        double highest_mode_hz);

/// How the strings of held_guitar() are held against their frets.
enum class Hold {
    None,
    Pressed,    ///< each by a rigid finger between two frets, a different one on every string
    OnAllFrets  ///< each lies on all of its frets, which stand on an arc above the rest line
};

/// The guitar with its strings held and plucked; resolution as at_quality() sets it.
SceneDescription held_guitar(Hold hold, double output_rate_hz);

}  // namespace jawari::benchmarks
