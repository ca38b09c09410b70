// "springs" and "hammers" of a string, and the keys of what gives way.
#pragma once

#include <optional>
#include <vector>

#include "formats/json/object_reader.h"
#include "formats/scene/system.h"
#include "jawari/scene/description.h"

namespace jawari::host {

/// "compliance" of contacts, frets or a neck; none if the key is absent.
std::optional<Compliance> read_compliance(json::ObjectReader& reader);

std::vector<SpringDescription> read_springs(json::ObjectReader& reader, System& system);
std::vector<FlyingHammer> read_hammers(json::ObjectReader& reader, System& system);

}  // namespace jawari::host
