// One entry of a scene's "strings" -> StringDescription.
#pragma once

#include <string>

#include "jawari/description.h"
#include "json/object_reader.h"
#include "scene/scene.h"

namespace jawari::host {

StringDescription read_string(const json::Value& value, const std::string& path, ContactSources& sources,
                              json::Problems& problems);

}  // namespace jawari::host
