#include "plugin/core/parameter_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"

namespace jawari::host {

namespace {

/// How the numbers of a parameter are shown.
struct Display {
    double factor = 1;  ///< shown number / value
    int decimals = 2;
    std::string_view unit;
};

bool is_share(const ParameterDeclaration& parameter) {
    return parameter.unit == "1" && parameter.curve != Curve::Exponential;
}

Display display_of(const ParameterDeclaration& parameter) {
    if (parameter.unit == "m") return {1000, 2, "mm"};
    if (parameter.unit == "s") return {1000, 0, "ms"};
    if (parameter.unit == "Hz") return {1, 2, "Hz"};
    if (parameter.unit == "semitones") return {1, 2, "st"};
    if (is_share(parameter)) return {100, 0, "%"};
    return {1, 2, "x"};
}

std::string stepped_text(ParameterId parameter, int step) {
    const std::string number = std::to_string(step);
    switch (parameter) {
        case ParameterId::Harmonic:
            return step == 1 ? "off" : "1/" + number + " of the string";
        case ParameterId::Articulation:
            return step == 0 ? "by the preset" : "exciter " + number;
        default:
            return step == 0 ? "off" : "on";
    }
}

std::string_view without_spaces(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> stepped_value(const ParameterDeclaration& parameter, const std::string& text) {
    for (int step = static_cast<int>(parameter.low); step <= static_cast<int>(parameter.high); ++step)
        if (lower_case(stepped_text(parameter.id, step)) == text) return step;
    const auto number = parse_number(text);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    return std::clamp(std::round(*number), parameter.low, parameter.high);
}

/// Left and right by their letters; nothing for other texts.
std::optional<double> pan_value(std::string_view text) {
    if (text == "centre" || text == "center") return 0;
    if (text.empty() || (text.front() != 'l' && text.front() != 'r')) return std::nullopt;
    const auto number = parse_number(without_spaces(text.substr(1)));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    return std::clamp(*number / 100, 0.0, 1.0) * (text.front() == 'l' ? -1 : 1);
}

}  // namespace

std::string parameter_text(ParameterId parameter, double value) {
    const ParameterDeclaration& declared = declaration_of(parameter);
    if (declared.curve == Curve::Stepped)
        return stepped_text(parameter, static_cast<int>(std::lround(value)));
    const Display display = display_of(declared);
    const double shown = value * display.factor;
    if (parameter == ParameterId::Pan) {
        const int percent = static_cast<int>(std::lround(shown));
        if (percent == 0) return "centre";
        return (percent < 0 ? "L " : "R ") + std::to_string(std::abs(percent));
    }
    std::string number = formatted("%.*f", display.decimals, shown);
    if (parse_number(number) == 0.0 && number.front() == '-') number.erase(0, 1);
    return number + " " + std::string(display.unit);
}

std::optional<double> parameter_from_text(ParameterId parameter, std::string_view text) {
    const ParameterDeclaration& declared = declaration_of(parameter);
    std::string words = lower_case(without_spaces(text));
    if (declared.curve == Curve::Stepped) return stepped_value(declared, words);
    if (parameter == ParameterId::Pan)
        if (const auto side = pan_value(words)) return side;
    const Display display = display_of(declared);
    const std::string unit = lower_case(display.unit);
    if (words.ends_with(unit)) words.resize(words.size() - unit.size());
    const auto number = parse_number(without_spaces(words));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    return std::clamp(*number / display.factor, declared.low, declared.high);
}

const std::vector<std::string_view>& parameter_groups() {
    static const std::vector<std::string_view> groups = [] {
        std::vector<std::string_view> names;
        for (const ParameterDeclaration& parameter : parameter_table())
            if (std::find(names.begin(), names.end(), parameter.group) == names.end())
                names.push_back(parameter.group);
        return names;
    }();
    return groups;
}

}  // namespace jawari::host
