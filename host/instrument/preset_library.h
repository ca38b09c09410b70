// Where presets are found: files, the user's and the system's folders, and those built into the program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/preset/read_preset.h"

namespace jawari::host {

/// Of a preset that has a name.
enum class PresetOrigin { UserConfig, UserData, System, BuiltIn };

struct NamedPreset {
    std::string name;
    PresetOrigin origin = PresetOrigin::BuiltIn;
    std::string path;  ///< empty if built in
};

struct PresetFolder {
    PresetOrigin origin;
    std::string path;
};

/// In the order of search (XDG Base Directory Specification 0.8): $XDG_CONFIG_HOME (or ~/.config),
/// $XDG_DATA_HOME (or ~/.local/share), each of $XDG_DATA_DIRS (or /usr/local/share:/usr/share), each with
/// /jawari/presets. Relative paths in these variables are ignored, as the specification asks.
std::vector<PresetFolder> preset_folders();

/// Every name once, sorted: the one that load_preset() takes.
std::vector<NamedPreset> named_presets();

/// `argument`: a file; else NAME.json in the first folder that has it; else a built-in name. A name without a
/// preset is an error of kind File.
Outcome<Preset> load_preset(const std::string& argument);

/// The text that load_preset() would read, with the same errors.
Outcome<std::string> preset_text(const std::string& argument);

/// The file that load_preset() would read; nothing for what is built in and for what it would not find.
std::optional<std::string> preset_path(const std::string& argument);

/// Whether load_preset() would find a preset of that name.
bool preset_exists(const std::string& name);

/// `user configuration`, `user data`, `system data`, `built in`.
std::string origin_text(PresetOrigin origin);

}  // namespace jawari::host
