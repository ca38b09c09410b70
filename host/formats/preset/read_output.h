// `pickups`, `body` and `bridge` of a preset.
#pragma once

#include <string>

#include "formats/json/object_reader.h"
#include "jawari/instrument/description.h"

namespace jawari::host::preset {

PickupDescription read_pickup(const json::Value& value, const std::string& path, json::Problems& problems);
BodyModeDescription read_body_mode(const json::Value& value, const std::string& path,
                                   json::Problems& problems);
BridgeDescription read_bridge(const json::Value& value, const std::string& path, json::Problems& problems);

}  // namespace jawari::host::preset
