// One entry of a scene's "strings" -> StringDescription.
#pragma once

#include <string>

#include "formats/json/object_reader.h"
#include "formats/scene/scene.h"
#include "jawari/scene/description.h"

namespace jawari::host {

/// Forces and motions have no values yet: `tables` gets what they follow.
StringDescription read_string(const json::Value& value, const std::string& path, ContactSources& sources,
                              DrivenTables& tables, json::Problems& problems);

}  // namespace jawari::host
