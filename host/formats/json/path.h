// Paths inside a document, spelled `strings[0].contacts[3].position_m`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/text.h"

namespace jawari::host::json {

/// Keys come from files: a path stays on one line.
inline std::string member(const std::string& parent, std::string_view key) {
    return parent.empty() ? printable(key) : parent + "." + printable(key);
}

inline std::string indexed(const std::string& parent, std::size_t index) {
    return parent + "[" + std::to_string(index) + "]";
}

/// The path itself, or a word for the whole document.
inline std::string whole(const std::string& path) {
    return path.empty() ? "document" : path;
}

}  // namespace jawari::host::json
