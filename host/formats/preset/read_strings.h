// `strings` and `frets` of a preset.
#pragma once

#include <string>

#include "formats/json/object_reader.h"
#include "jawari/instrument/description.h"

namespace jawari::host::preset {

FretsDescription read_frets(const json::Value& value, const std::string& path, json::Problems& problems);
InstrumentStringDescription read_string(const json::Value& value, const std::string& path,
                                        json::Problems& problems);

}  // namespace jawari::host::preset
