#include "commands/play/completion.h"

#include <algorithm>

#include "formats/words/parameter_words.h"

namespace jawari::host {

namespace {

std::vector<std::string> verb_words() {
    std::vector<std::string> words;
    for (const Verb& verb : verb_table()) words.emplace_back(verb.name);
    return words;
}

std::vector<std::string> words_of(ArgumentKind kind, const PresetNames& presets) {
    switch (kind) {
        case ArgumentKind::Preset:
            return presets();
        case ArgumentKind::Parameter:
            return parameter_keys();
        case ArgumentKind::OnOff:
            return {"on", "off"};
        case ArgumentKind::StartStop:
            return {"start", "stop"};
        case ArgumentKind::VerbName:
            return verb_words();
        default:
            return {};
    }
}

}  // namespace

std::string_view last_word(std::string_view line) {
    const std::size_t blank = line.find_last_of(" \t");
    return blank == std::string_view::npos ? line : line.substr(blank + 1);
}

std::vector<std::string> completions(std::string_view line, const PresetNames& presets) {
    const std::string_view typed = last_word(line);
    const auto before = split_words(line.substr(0, line.size() - typed.size()));
    if (!before) return {};
    std::vector<std::string> words;
    if (before.value().empty()) {
        words = verb_words();
    } else if (const Verb* verb = find_verb(before.value().front())) {
        const auto rules = arguments_of(*verb);
        const std::size_t argument = before.value().size() - 1;
        if (argument < rules.size()) words = words_of(rules[argument].kind, presets);
    }
    std::erase_if(words, [&](const std::string& word) { return !word.starts_with(typed); });
    std::sort(words.begin(), words.end());
    return words;
}

std::string common_start(const std::vector<std::string>& words) {
    if (words.empty()) return {};
    std::string start = words.front();
    for (const std::string& word : words) {
        const auto [end, other] = std::mismatch(start.begin(), start.end(), word.begin(), word.end());
        start.erase(end, start.end());
    }
    return start;
}

}  // namespace jawari::host
