// `obstacles` and `soft_touches` of a preset.
#pragma once

#include <string>

#include "jawari/instrument_description.h"
#include "json/object_reader.h"

namespace jawari::host::preset {

ObstacleDescription read_obstacle(const json::Value& value, const std::string& path,
                                  json::Problems& problems);
SoftTouchDescription read_soft_touch(const json::Value& value, const std::string& path,
                                     json::Problems& problems);

}  // namespace jawari::host::preset
