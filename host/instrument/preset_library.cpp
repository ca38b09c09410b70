#include "instrument/preset_library.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>

#include "base/builtin.h"
#include "base/input_file.h"
#include "base/platform.h"
#include "base/suggestion.h"
#include "base/text.h"

namespace jawari::host {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_preset_bytes = std::size_t{4} << 20U;
constexpr std::string_view extension = ".json";

bool is_folder(const std::string& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

/// Names have no slash, so that a path that does not exist is not looked for elsewhere.
bool is_name(const std::string& argument) {
    return !argument.empty() && argument.find('/') == std::string::npos;
}

std::optional<std::string> find_in_folders(const std::string& name) {
    for (const PresetFolder& folder : preset_folders()) {
        const std::string path = folder.path + "/" + name + std::string(extension);
        if (path_exists(path) && !is_folder(path)) return path;
    }
    return std::nullopt;
}

void add_folder(const PresetFolder& folder, std::set<std::string>& seen, std::vector<NamedPreset>& presets) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder.path, failed)) {
        const fs::path& path = entry.path();
        std::error_code ignored;
        if (path.extension() != extension || entry.is_directory(ignored)) continue;
        if (seen.insert(path.stem().string()).second)
            presets.push_back({path.stem().string(), folder.origin, path.string()});
    }
}

}  // namespace

std::vector<PresetFolder> preset_folders() {
    constexpr const char* below = "/jawari/presets";
    std::vector<PresetFolder> folders;
    const auto add = [&](PresetOrigin origin, const std::string& base) {
        if (!base.empty()) folders.push_back({origin, base + below});
    };
    add(PresetOrigin::UserConfig, platform::user_folder(platform::UserFolder::Configuration));
    add(PresetOrigin::UserData, platform::user_folder(platform::UserFolder::Data));
    for (const std::string& base : platform::system_data_folders()) add(PresetOrigin::System, base);
    return folders;
}

std::vector<NamedPreset> named_presets() {
    std::set<std::string> seen;
    std::vector<NamedPreset> presets;
    for (const PresetFolder& folder : preset_folders()) add_folder(folder, seen, presets);
    for (const std::string& name : builtin_preset_names())
        if (seen.insert(name).second) presets.push_back({name, PresetOrigin::BuiltIn, ""});
    std::sort(presets.begin(), presets.end(),
              [](const NamedPreset& a, const NamedPreset& b) { return a.name < b.name; });
    return presets;
}

std::optional<std::string> preset_path(const std::string& argument) {
    if (path_exists(argument) && !is_folder(argument)) return argument;
    return is_name(argument) ? find_in_folders(argument) : std::nullopt;
}

Outcome<std::string> preset_text(const std::string& argument) {
    if (const auto path = preset_path(argument)) return read_file(*path, longest_preset_bytes);
    if (is_name(argument)) {
        const BuiltinFile* builtin = find_builtin("instruments", argument);
        if (builtin != nullptr) return std::string(builtin->text);
    }
    std::vector<std::string> names;
    for (const NamedPreset& preset : named_presets()) names.push_back(preset.name);
    return Error{ErrorKind::File, printable(argument) + ": no such file, and no preset of that name" +
                                      did_you_mean(argument, names) + " (presets: " + join(names) + ")"};
}

Outcome<Preset> load_preset(const std::string& argument) {
    const auto text = preset_text(argument);
    if (!text) return text.error();
    return read_preset(text.value(), preset_path(argument).value_or(argument));
}

bool preset_exists(const std::string& name) {
    return is_name(name) && (find_in_folders(name) || find_builtin("instruments", name) != nullptr);
}

std::string origin_text(PresetOrigin origin) {
    switch (origin) {
        case PresetOrigin::UserConfig:
            return "user configuration";
        case PresetOrigin::UserData:
            return "user data";
        case PresetOrigin::System:
            return "system data";
        case PresetOrigin::BuiltIn:
            break;
    }
    return "built in";
}

}  // namespace jawari::host
