#include "window/model/preset_search.h"

#include <algorithm>

#include "base/text.h"
#include "instrument/preset_library.h"
#include "plugin/core/preset_facts.h"

namespace jawari::host::window {

namespace {

std::vector<std::string> words_of(std::string_view query) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : lower_case(std::string(query)) + " ") {
        if (c != ' ') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(word);
            word.clear();
        }
    }
    return words;
}

bool all_in(const std::vector<std::string>& words, const std::string& text) {
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

std::string one_paragraph(std::string lines) {
    std::replace(lines.begin(), lines.end(), '\n', ' ');
    return lines;
}

}  // namespace

std::vector<ListedPreset> list_presets() {
    std::vector<ListedPreset> presets;
    for (const NamedPreset& named : named_presets()) {
        const auto text = preset_text(named.name);
        if (!text) continue;
        const auto facts = preset_facts(text.value(), named.name);
        if (!facts) continue;
        presets.push_back({named.name, facts->name, one_paragraph(facts->comment)});
    }
    return presets;
}

std::vector<std::size_t> search_presets(const std::vector<ListedPreset>& presets, std::string_view query) {
    const std::vector<std::string> words = words_of(query);
    std::vector<std::size_t> named;
    std::vector<std::size_t> described;
    for (std::size_t i = 0; i < presets.size(); ++i) {
        const std::string title = lower_case(presets[i].name + " " + presets[i].title);
        if (all_in(words, title))
            named.push_back(i);
        else if (all_in(words, title + " " + lower_case(presets[i].description)))
            described.push_back(i);
    }
    named.insert(named.end(), described.begin(), described.end());
    return named;
}

}  // namespace jawari::host::window
