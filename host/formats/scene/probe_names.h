// Names of probes: columns of a CSV file, channels, datasets.
#pragma once

#include <string>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari::host {

struct ProbeLabel {
    std::string
        name;  ///< `displacement_m@0.0863`, `contact_force_N@contact3`, `energy_J`; unique in the scene
    std::string unit;  ///< `m`, `m/s`, ...
    Quantity quantity = Quantity::Displacement;
    std::size_t string = 0;  ///< index of the string it belongs to
};

/// In the order of render()'s outputs. With several strings each name starts with `STRING:`; the second of
/// two equal names gets `#2`.
std::vector<ProbeLabel> probe_labels(const SceneDescription& scene);

}  // namespace jawari::host
