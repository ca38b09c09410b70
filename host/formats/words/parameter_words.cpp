#include "formats/words/parameter_words.h"

#include "base/text.h"

namespace jawari::host {

const ParameterDeclaration* find_parameter(std::string_view key) {
    for (const ParameterDeclaration& each : parameter_table())
        if (each.key == key) return &each;
    return nullptr;
}

std::vector<std::string> parameter_keys() {
    std::vector<std::string> keys;
    for (const ParameterDeclaration& each : parameter_table()) keys.emplace_back(each.key);
    return keys;
}

std::string parameter_range(const ParameterDeclaration& parameter) {
    const std::string unit = parameter.unit == "1" ? "" : " " + std::string(parameter.unit);
    return shortest(parameter.low) + " to " + shortest(parameter.high) + unit;
}

}  // namespace jawari::host
