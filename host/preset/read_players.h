// `exciters` and `hand` of a preset.
#pragma once

#include <string>

#include "jawari/instrument_description.h"
#include "json/object_reader.h"

namespace jawari::host::preset {

ExciterDescription read_exciter(const json::Value& value, const std::string& path, json::Problems& problems);
HandDescription read_hand(const json::Value& value, const std::string& path, json::Problems& problems);

}  // namespace jawari::host::preset
