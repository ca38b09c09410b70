#include "base/builtin.h"

#include <cstddef>
#include <span>

namespace jawari::host {

// Written by host/embed_presets.cmake from presets/.
extern const BuiltinFile builtin_table[];
extern const std::size_t builtin_table_size;

std::vector<BuiltinFile> builtin_files(std::string_view kind) {
    std::vector<BuiltinFile> files;
    for (const BuiltinFile& file : std::span(builtin_table, builtin_table_size))
        if (file.kind == kind) files.push_back(file);
    return files;
}

const BuiltinFile* find_builtin(std::string_view kind, std::string_view name) {
    for (const BuiltinFile& file : std::span(builtin_table, builtin_table_size))
        if (file.kind == kind && file.name == name) return &file;
    return nullptr;
}

}  // namespace jawari::host
