// The JSON schema and the reader know the same keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/preset/read_preset.h"

namespace jawari::host {
namespace {

using Json = nlohmann::json;

Json load_schema() {
    std::ifstream file(JAWARI_SOURCE_DIR "/presets/preset.schema.json");
    return Json::parse(file);
}

const Json& resolved(const Json& schema, const Json& node) {
    if (!node.is_object() || !node.contains("$ref")) return node;
    return schema.at(Json::json_pointer(node["$ref"].get<std::string>().substr(1)));
}

const std::string everything = R"({
  "schema": "jawari.preset/2", "name": "x", "gain": 1, "contact_rate_min_hz": 200000, "mode_limit_hz": 9000,
  "studio": {"contact_rate_min_hz": 200000, "mode_limit_hz": 9000},
  "frets": {"height_m": [-0.01]},
  "obstacles": [{"name": "a", "origin": "nut", "parabola": {"length_m": 0.1, "drop_m": 0.01}, "points": 3}],
  "soft_touches": [{"name": "a", "position_share": 0.1, "damping_kg_per_s": 1}],
  "hand": {"palm_place": {"position_share": 0.1}, "release_places": [{"position_share": 0.1}, {"position_share": 0.2}]},
  "exciters": [{"name": "f", "kind": "finger", "position_share": 0.1, "full_height_m": 0.001}],
  "pickups": [{"position_share": 0.1}],
  "body": [{"frequency_hz": 100, "t60_s": 1, "gain_left": 1}],
  "strings": [{"name": "E", "open_note": 28, "open_frequency_hz": 41.2, "length_m": 0.86,
               "linear_density_kg_per_m": 0.03, "damping": {"model": "none"}, "exciter_place": {"position_share": 0.1},
               "frets": {"count": 0}}]
})";

struct Section {
    const char* in_schema;
    const char* in_preset;
};

/// The message about a preset that is `everything` with one more key in one section.
std::string message_with(const Section& section, const std::string& key, Json preset) {
    Json& at = preset[Json::json_pointer(section.in_preset)];
    if (!at.contains(key)) at[key] = "?";
    const auto read = read_preset(preset.dump(), "p");
    return read ? std::string() : read.error().message;
}

/// The reader's own list of keys, as it prints it for a key that it does not know.
std::set<std::string> keys_of_reader(const Section& section, const Json& preset) {
    const std::string refusal = message_with(section, "no_such_key", preset);
    EXPECT_NE(refusal.find("unknown key"), std::string::npos) << section.in_preset;
    std::set<std::string> keys;
    std::size_t begin = refusal.find("allowed: ") + 9;
    while (begin < refusal.size()) {
        const std::size_t end = std::min(refusal.find_first_of(",)", begin), refusal.size());
        keys.insert(refusal.substr(begin, end - begin));
        begin = end + 2;
    }
    return keys;
}

std::set<std::string> keys_of_schema(const Section& section) {
    const Json schema = load_schema();
    const Json& object = resolved(schema, schema.at(Json::json_pointer(section.in_schema)));
    std::set<std::string> keys;
    for (const auto& [key, value] : object["properties"].items()) keys.insert(key);
    keys.erase("comment");  // allowed everywhere, in no list
    return keys;
}

TEST(PresetSchema, KnowsTheKeysThatTheReaderKnows) {
    const auto whole = read_preset(everything, "p");
    ASSERT_TRUE(whole) << whole.error().message;
    for (const Section& section :
         {Section{"", ""}, Section{"/properties/studio", "/studio"}, Section{"/properties/frets", "/frets"},
          Section{"/properties/obstacles/items", "/obstacles/0"},
          Section{"/properties/obstacles/items/properties/parabola", "/obstacles/0/parabola"},
          Section{"/properties/soft_touches/items", "/soft_touches/0"}, Section{"/properties/hand", "/hand"},
          Section{"/properties/hand/properties/palm_place", "/hand/palm_place"},
          Section{"/properties/pickups/items", "/pickups/0"}, Section{"/properties/body/items", "/body/0"},
          Section{"/properties/strings/items", "/strings/0"},
          Section{"/properties/strings/items/properties/frets", "/strings/0/frets"}}) {
        EXPECT_EQ(keys_of_reader(section, Json::parse(everything)), keys_of_schema(section))
            << section.in_preset;
    }
}

/// Each kind of exciter has keys of its own; the schema lists them all.
TEST(PresetSchema, KnowsTheKeysOfEveryKindOfExciter) {
    const Section section{"/properties/exciters/items", "/exciters/0"};
    std::set<std::string> keys;
    for (const char* kind : {"finger", "hammer", "tangent"}) {
        Json preset = Json::parse(everything);
        preset["exciters"][0] = Json{{"name", "e"}, {"kind", kind}};
        keys.merge(keys_of_reader(section, preset));
    }
    EXPECT_EQ(keys, keys_of_schema(section));
}

}  // namespace
}  // namespace jawari::host
