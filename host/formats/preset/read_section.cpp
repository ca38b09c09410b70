#include "formats/preset/read_section.h"

#include <algorithm>
#include <array>

#include "formats/json/path.h"

namespace jawari::host::preset {

namespace {

constexpr std::array<std::string_view, 3> origins{"measured", "published", "chosen"};

void check_provenance(const json::Object& object, const json::Value& provenance, const std::string& path,
                      json::Problems& problems) {
    const auto* entries = std::get_if<json::Object>(&provenance.content);
    if (entries == nullptr) {
        problems.add(path, json::describe(provenance), "an object");
        return;
    }
    for (const json::Member& entry : *entries) {
        const std::string place = json::member(path, entry.key);
        if (json::find(object, entry.key) == nullptr) {
            problems.add(place, "not a key of this object", "keys of the object that holds the provenance");
        }
        const auto* text = std::get_if<std::string>(&entry.value.content);
        const bool known = text != nullptr && std::any_of(origins.begin(), origins.end(), [&](auto origin) {
                               return text->rfind(origin, 0) == 0;
                           });
        if (!known)
            problems.add(place, json::describe(entry.value),
                         "a text that begins with measured, published or chosen");
    }
}

std::vector<std::string_view> with_provenance(std::initializer_list<std::string_view> allowed) {
    std::vector<std::string_view> keys(allowed);
    keys.emplace_back("provenance");
    return keys;
}

}  // namespace

Section::Section(const json::Value& value, const std::string& path,
                 std::initializer_list<std::string_view> allowed, json::Problems& problems)
    : ObjectReader(value, path, with_provenance(allowed), problems) {
    const auto* object = std::get_if<json::Object>(&value.content);
    const json::Value* provenance = find("provenance");
    if (object != nullptr && provenance != nullptr)
        check_provenance(*object, *provenance, path_of("provenance"), problems);
}

bool Section::flag_or(std::string_view key, bool fallback) {
    const json::Value* value = find(key);
    if (value == nullptr) return fallback;
    if (const auto* flag = std::get_if<bool>(&value->content)) return *flag;
    problems().add(path_of(key), json::describe(*value), "true or false");
    return fallback;
}

std::vector<std::size_t> Section::indices_or_empty(std::string_view key, std::size_t longest) {
    std::vector<std::size_t> indices;
    if (!has(key)) return indices;
    const std::vector<double> values = numbers(key, longest);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] >= 0 && values[i] <= 1e6) ||
            values[i] != static_cast<double>(static_cast<std::size_t>(values[i]))) {
            const auto* array = std::get_if<json::Array>(&find(key)->content);
            problems().add(json::indexed(path_of(key), i), json::describe((*array)[i]),
                           "a whole number from 0");
            return indices;
        }
        indices.push_back(static_cast<std::size_t>(values[i]));
    }
    return indices;
}

std::pair<double, double> Section::pair_or(std::string_view key, std::pair<double, double> fallback) {
    if (!has(key)) return fallback;
    const std::vector<double> values = numbers(key, 2);
    if (values.size() == 2) return {values[0], values[1]};
    problems().add(path_of(key), std::to_string(values.size()) + " numbers", "two numbers");
    return fallback;
}

StringPlace Section::place() {
    StringPlace place;
    if (has("position_from_bridge_m") == has("position_share")) {
        const bool both = has("position_share");
        problems().add(path_of("position_from_bridge_m"), both ? "given beside position_share" : "missing",
                       "either position_from_bridge_m or position_share");
        return place;
    }
    if (has("position_share")) {
        place.share = number("position_share", {1e-6, 1 - 1e-6});
    } else {
        place.from_bridge_m = number("position_from_bridge_m");
    }
    return place;
}

StringPlace read_place(const json::Value& value, const std::string& path, json::Problems& problems) {
    Section reader(value, path, {"position_from_bridge_m", "position_share"}, problems);
    return reader.place();
}

}  // namespace jawari::host::preset
