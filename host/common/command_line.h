// Checks of command-line values whose messages read like those of files: `--theta: 3 (allowed: 0.5 to 1)`.
// Includes CLI11: only for the sources that register options.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "common/text.h"

namespace jawari::host {

/// What a check returns for a value it refuses; CLI11 puts the option's name before it.
inline std::string refusal(const std::string& value, const std::string& allowed) {
    return value + " (allowed: " + allowed + ")";
}

inline CLI::Validator number_between(double lowest, double highest) {
    const auto check = [lowest, highest](const std::string& text) {
        const auto value = parse_number(text);
        if (value && std::isfinite(*value) && *value >= lowest && *value <= highest) return std::string();
        return refusal(text, shortest(lowest) + " to " + shortest(highest));
    };
    return {check, ""};
}

/// An option that takes one of some words.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::optional<T>& target,
                        const std::map<std::string, T>& words, const std::string& help) {
    std::vector<std::string> allowed;
    for (const auto& [word, value] : words) allowed.push_back(word);
    CLI::Option* option = app.add_option_function<std::string>(
        name, [&target, &words](const std::string& word) { target = words.at(word); }, help);
    const auto check = [&words, allowed](const std::string& word) {
        return words.count(word) > 0 ? std::string() : refusal(word, join(allowed));
    };
    return option->type_name(join(allowed, "|"))->check(CLI::Validator(check, ""));
}

}  // namespace jawari::host
