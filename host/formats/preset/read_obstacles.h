// `obstacles` and `soft_touches` of a preset.
#pragma once

#include <string>

#include "formats/json/object_reader.h"
#include "jawari/instrument/description.h"

namespace jawari::host::preset {

ObstacleDescription read_obstacle(const json::Value& value, const std::string& path,
                                  json::Problems& problems);
SoftTouchDescription read_soft_touch(const json::Value& value, const std::string& path,
                                     json::Problems& problems);

}  // namespace jawari::host::preset
