// `exciters` and `hand` of a preset.
#pragma once

#include <string>

#include "formats/json/object_reader.h"
#include "jawari/instrument/description.h"

namespace jawari::host::preset {

ExciterDescription read_exciter(const json::Value& value, const std::string& path, json::Problems& problems);
HandDescription read_hand(const json::Value& value, const std::string& path, json::Problems& problems);

}  // namespace jawari::host::preset
