// Checks of command-line values whose messages read like those of files: `--theta: 3 (allowed: 0.5 to 1)`.
// Includes CLI11: only for the sources that register options.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/suggestion.h"
#include "base/text.h"
#include "formats/words/parameter_words.h"

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

/// `what`: follows "a whole number" in the message, " of hertz".
inline CLI::Validator whole_between(double lowest, double highest, const std::string& what) {
    const auto check = [=](const std::string& text) {
        const auto value = parse_number(text);
        const bool whole = value && *value == std::floor(*value);
        if (whole && *value >= lowest && *value <= highest) return std::string();
        return refusal(text, "a whole number" + what + ", " + shortest(lowest) + " to " + shortest(highest));
    };
    return {check, ""};
}

inline CLI::Validator some_name() {
    return {[](const std::string& text) { return text.empty() ? refusal(text, "a name") : std::string(); },
            ""};
}

/// `palm_mute=0.3`
inline CLI::Validator parameter_setting() {
    const auto check = [](const std::string& text) {
        const std::size_t equals = text.find('=');
        const ParameterDeclaration* parameter = find_parameter(text.substr(0, equals));
        if (parameter == nullptr)
            return refusal(text + did_you_mean(text.substr(0, equals), parameter_keys()),
                           "PARAMETER=VALUE, one of " + join(parameter_keys()));
        const auto value = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
        if (value && *value >= parameter->low && *value <= parameter->high) return std::string();
        return refusal(text, std::string(parameter->key) + "=" + parameter_range(*parameter));
    };
    return {check, ""};
}

/// --set, of which each has passed parameter_setting().
inline void add_parameter_settings(CLI::App& app, std::vector<std::pair<ParameterId, double>>& target) {
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&target](const std::vector<std::string>& settings) {
               for (const std::string& text : settings) {
                   const std::size_t equals = text.find('=');
                   target.emplace_back(find_parameter(text.substr(0, equals))->id,
                                       *parse_number(text.substr(equals + 1)));
               }
           },
           "A parameter at the start, in its unit; may be repeated; jawari info lists them")
        ->type_name("PARAMETER=VALUE")
        ->allow_extra_args(false)
        ->check(parameter_setting());
}

/// `what`: as of whole_between().
template <class T>
CLI::Option* add_whole(CLI::App& app, const std::string& name, std::optional<T>& target, double lowest,
                       double highest, const std::string& what, const std::string& help) {
    return app
        .add_option_function<std::string>(
            name, [&target](const std::string& text) { target = static_cast<T>(*parse_number(text)); }, help)
        ->check(whole_between(lowest, highest, what));
}

/// A flag that says `value`.
inline void add_flag(CLI::App& app, const std::string& name, std::optional<bool>& target, bool value,
                     const std::string& help) {
    app.add_flag_callback(
        name, [&target, value] { target = value; }, help);
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
        return words.count(word) > 0 ? std::string()
                                     : refusal(word + did_you_mean(word, allowed), join(allowed));
    };
    return option->type_name(join(allowed, "|"))->check(CLI::Validator(check, ""));
}

}  // namespace jawari::host
