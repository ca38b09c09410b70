// The JSON schema and the reader know the same keys.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/scene/read_scene.h"
#include "support/run_program.h"
#include "support/schema_keys.h"

namespace jawari::host {
namespace {

using Json = nlohmann::json;

const char* const schema_file = "scene.schema.json";

const std::string scene_start = R"({"schema": "jawari.scene/1", "duration_s": 0.1, "strings": [)";
const std::string everything = scene_start + R"({
  "length_m": 0.6, "linear_density_kg_per_m": 0.01, "modes": {"count": 4, "tension_N": 50},
  "initial": {"profile": {"position_m": [0, 0.6], "displacement_m": [0, 0]}},
  "contacts": [{"position_m": 0.1, "height_m": -0.1, "compliance": {"stiffness": 1}},
               {"position_m": 0.1, "motion": {"time_s": [0], "height_m": [0]}}],
  "frets": {"count": 1, "height_m": -0.1}, "neck": {"grid_points": 1, "profile_m": [[0, -0.1]]},
  "springs": [{"position_m": 0.1, "stiffness_N_per_m": 1}],
  "hammers": [{"position_m": 0.1, "mass_kg": 1, "velocity_m_per_s": 1, "stiffness": 1}],
  "forces": [{"position_m": 0.1, "time_s": [0], "force_N": [1]}],
  "plucks": [{"position_m": 0.1, "time_s": 1, "height_m": 0.001}]}]})";
const std::string bar_scene = scene_start + R"({"modes": {"bar": {"length_m": 1, "linear_density_kg_per_m": 1,
  "bending_stiffness_N_m2": 1, "ends": ["free", "free"], "count": 4}}}]})";
const std::string plate_scene =
    scene_start + R"({"modes": {"plate": {"size_m": [1, 1], "thickness_m": 0.01, "density_kg_per_m3": 1,
  "youngs_modulus_Pa": 1, "poissons_ratio": 0.3, "count": 4}}}]})";
const std::string tabled_scene =
    scene_start + R"({"modes": {"frequency_hz": [0], "decay_per_s": [0], "modal_mass_kg": [1],
  "points": [[1]]}, "contacts": [{"point": 0, "height_m": -1}]}]})";

struct Section {
    const std::string& scene;
    const char* in_schema;
    const char* in_scene;
    std::set<std::string> others = {};  ///< keys of the schema that other kinds of system have here
};

std::set<std::string> keys_of_reader(const Section& section) {
    Json scene = Json::parse(section.scene);
    scene[Json::json_pointer(section.in_scene)]["no_such_key"] = "?";
    const auto read = read_scene(scene.dump(), "s");
    return test::keys_of_refusal(read ? std::string() : read.error().message);
}

std::set<std::string> keys_of_schema(const Section& section) {
    std::set<std::string> keys = test::keys_of_schema(test::load_schema(schema_file), section.in_schema);
    for (const std::string& other : section.others) keys.erase(other);
    return keys;
}

TEST(SceneSchema, KnowsTheKeysThatTheReaderKnows) {
    const std::string in_string = "/properties/strings/items/properties";
    const auto at = [&](const std::string& place) { return in_string + place; };
    const std::string paths[] = {at("/initial"),
                                 at("/initial/properties/profile"),
                                 at("/contacts/items"),
                                 at("/contacts/items/properties/motion"),
                                 at("/frets"),
                                 at("/neck"),
                                 at("/springs/items"),
                                 at("/hammers/items"),
                                 at("/forces/items"),
                                 at("/plucks/items"),
                                 at("/modes/oneOf/0"),
                                 at("/modes/oneOf/2"),
                                 at("/modes/oneOf/3/properties/bar"),
                                 at("/modes/oneOf/4/properties/plate")};
    for (const std::string& scene : {everything, bar_scene, plate_scene, tabled_scene}) {
        const auto read = read_scene(scene, "s");
        ASSERT_TRUE(read) << read.error().message;
    }
    const std::set<std::string> points{"point"};
    for (const Section& section : {
             Section{everything, "", ""},
             Section{everything, "/properties/strings/items", "/strings/0"},
             Section{everything, paths[0].c_str(), "/strings/0/initial"},
             Section{everything, paths[1].c_str(), "/strings/0/initial/profile"},
             Section{everything, paths[2].c_str(), "/strings/0/contacts/0", points},
             Section{everything, "/$defs/compliance", "/strings/0/contacts/0/compliance"},
             Section{everything, paths[3].c_str(), "/strings/0/contacts/1/motion"},
             Section{everything, paths[4].c_str(), "/strings/0/frets"},
             Section{everything, paths[5].c_str(), "/strings/0/neck"},
             Section{everything, paths[6].c_str(), "/strings/0/springs/0", points},
             Section{everything, paths[7].c_str(), "/strings/0/hammers/0", points},
             Section{everything, paths[8].c_str(), "/strings/0/forces/0", points},
             Section{everything, paths[9].c_str(), "/strings/0/plucks/0", points},
             Section{everything, paths[10].c_str(), "/strings/0/modes"},
             Section{tabled_scene, paths[11].c_str(), "/strings/0/modes"},
             Section{bar_scene, paths[12].c_str(), "/strings/0/modes/bar"},
             Section{plate_scene, paths[13].c_str(), "/strings/0/modes/plate"},
             Section{tabled_scene, paths[2].c_str(), "/strings/0/contacts/0", {"position_m"}},
         }) {
        EXPECT_EQ(keys_of_reader(section), keys_of_schema(section)) << section.in_scene;
    }
}

TEST(SceneSchema, IsPrintedByTheProgram) {
    const auto ran = test::jawari({"info", "--schema", "scene"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(Json::parse(ran.out), test::load_schema(schema_file));
    EXPECT_EQ(Json::parse(test::jawari({"info", "--schema", "preset"}).out)["title"], "jawari.preset/3");
    EXPECT_EQ(test::jawari({"info"}).exit_code, 2);
    EXPECT_EQ(test::jawari({"info", "--schema", "song"}).exit_code, 2);
}

}  // namespace
}  // namespace jawari::host
