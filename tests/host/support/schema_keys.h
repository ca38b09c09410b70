// The keys of a JSON schema in presets/, and those of the reader that it describes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace jawari::test {

inline nlohmann::json load_schema(const std::string& file_name) {
    std::ifstream file(std::string(JAWARI_SOURCE_DIR "/presets/") + file_name);
    return nlohmann::json::parse(file);
}

/// The reader's own list of keys, from its message about a key that it does not know.
inline std::set<std::string> keys_of_refusal(const std::string& refusal) {
    EXPECT_NE(refusal.find("unknown key"), std::string::npos) << refusal;
    std::set<std::string> keys;
    std::size_t begin = refusal.find("allowed: ") + 9;
    while (begin < refusal.size()) {
        const std::size_t end = std::min(refusal.find_first_of(",)", begin), refusal.size());
        keys.insert(refusal.substr(begin, end - begin));
        begin = end + 2;
    }
    return keys;
}

/// The keys of the object at this JSON pointer. Without "comment", which is allowed everywhere and in no
/// list.
inline std::set<std::string> keys_of_schema(const nlohmann::json& schema, const std::string& pointer) {
    const nlohmann::json* object = &schema.at(nlohmann::json::json_pointer(pointer));
    if (object->contains("$ref"))
        object = &schema.at(nlohmann::json::json_pointer((*object)["$ref"].get<std::string>().substr(1)));
    std::set<std::string> keys;
    for (const auto& [key, value] : (*object)["properties"].items())
        if (key != "comment") keys.insert(key);
    return keys;
}

}  // namespace jawari::test
