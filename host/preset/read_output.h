// `pickups` and `body` of a preset.
#pragma once

#include <string>

#include "jawari/instrument_description.h"
#include "json/object_reader.h"

namespace jawari::host::preset {

PickupDescription read_pickup(const json::Value& value, const std::string& path, json::Problems& problems);
BodyModeDescription read_body_mode(const json::Value& value, const std::string& path,
                                   json::Problems& problems);

}  // namespace jawari::host::preset
