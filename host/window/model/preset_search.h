// The presets that a search finds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jawari::host::window {

struct ListedPreset {
    std::string name;         ///< by which it is loaded
    std::string title;        ///< for people
    std::string description;  ///< one paragraph, may be empty
};

/// All presets that the library finds, in its order; what is no preset is left out. Reads files. Threads:
/// any.
std::vector<ListedPreset> list_presets();

/// Indices of those in which every word of `query` occurs, in name, title or description, whatever the case;
/// where it occurs in name or title of one, that one comes first. Threads: any.
std::vector<std::size_t> search_presets(const std::vector<ListedPreset>& presets, std::string_view query);

}  // namespace jawari::host::window
