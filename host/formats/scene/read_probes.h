// "probes" of a string.
#pragma once

#include <vector>

#include "formats/json/object_reader.h"
#include "formats/scene/system.h"
#include "jawari/scene/description.h"

namespace jawari::host {

std::vector<ProbeDescription> read_probes(json::ObjectReader& reader, System& system);

}  // namespace jawari::host
