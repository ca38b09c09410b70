// Files of presets/ that are part of the program, so that their names work from any directory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jawari::host {

/// presets/scenes/lab/bass.json has the kind "scenes" and the name "lab/bass".
struct BuiltinFile {
    std::string_view kind;
    std::string_view name;
    std::string_view text;
};

/// All of one kind, sorted by name.
std::vector<BuiltinFile> builtin_files(std::string_view kind);

/// Null if there is none of that name.
const BuiltinFile* find_builtin(std::string_view kind, std::string_view name);

}  // namespace jawari::host
