// The JSON schema and the reader know the same keys.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/preset/read_preset.h"
#include "support/schema_keys.h"

namespace jawari::host {
namespace {

using Json = nlohmann::json;

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

std::set<std::string> keys_of_reader(const Section& section, Json preset) {
    preset[Json::json_pointer(section.in_preset)]["no_such_key"] = "?";
    const auto read = read_preset(preset.dump(), "p");
    return test::keys_of_refusal(read ? std::string() : read.error().message);
}

std::set<std::string> keys_of_schema(const Section& section) {
    return test::keys_of_schema(test::load_schema("preset.schema.json"), section.in_schema);
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
