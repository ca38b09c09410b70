#include "formats/json/value.h"

#include "base/text.h"

namespace jawari::host::json {

namespace {

struct Describe {
    std::string operator()(Null) const { return "null"; }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(double value) const { return shortest(value); }
    std::string operator()(const std::string& value) const { return in_quotes(value); }
    std::string operator()(const Array& value) const {
        return value.empty() ? "an empty array" : "an array of " + std::to_string(value.size());
    }
    std::string operator()(const Object&) const { return "an object"; }
};

}  // namespace

const Value* find(const Object& object, std::string_view key) {
    for (const Member& member : object)
        if (member.key == key) return &member.value;
    return nullptr;
}

std::string describe(const Value& value) {
    return std::visit(Describe{}, value.content);
}

}  // namespace jawari::host::json
