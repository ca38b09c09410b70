// Presets that compile fast, for tests that need an instrument and not its sound.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/builtin.h"

namespace jawari::test {

/// A factory preset made cheap: few modes, a low contact rate.
inline std::string small_preset_text(const std::string& name) {
    auto preset = nlohmann::ordered_json::parse(host::find_builtin("instruments", name)->text);
    preset["contact_rate_min_hz"] = 96000;
    preset["mode_limit_hz"] = 3000;
    preset.erase("studio");
    preset.erase("provenance");
    return preset.dump();
}

/// A state whose instrument is cheap, and nothing else of it is set.
inline std::string small_state(const std::string& name = "bass-fretted") {
    const nlohmann::ordered_json state{{"schema", "jawari.plugin/1"},
                                       {"preset", {{"name", name}, {"text", small_preset_text(name)}}}};
    return state.dump();
}

}  // namespace jawari::test
