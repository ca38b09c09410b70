// What hosts show of a preset before it is loaded.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace jawari::host {

struct PresetFacts {
    std::string name;     ///< for people
    std::string comment;  ///< lines, may be empty
};

/// What a preset's text says of itself, nothing if it is none. Nothing is compiled. `file`: for messages.
/// Threads: any.
std::optional<PresetFacts> preset_facts(std::string_view text, const std::string& file);

}  // namespace jawari::host
