#include "formats/scene/read_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "jawari/scene/compile.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"
#include "support/test_names.h"

namespace jawari::host {
namespace {

using test::replaced;
using test::valid_scene;

Scene read_valid(const std::string& text) {
    auto scene = read_scene(text, "f.json");
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    return scene ? std::move(scene.value()) : Scene{};
}

StringDescription first_string(const std::string& text) {
    return read_valid(text).description.strings.at(0);
}

TEST(ReadScene, EveryKeyArrives) {
    const Scene scene = read_valid(valid_scene);
    EXPECT_EQ(scene.duration_s, 0.01);
    EXPECT_EQ(scene.description.output_rate_hz, 8000);
    EXPECT_EQ(scene.description.contact_rate_hz, 80000);
    EXPECT_EQ(scene.description.scheme, Scheme::Exact);
    EXPECT_EQ(scene.description.law, ImpactLaw::Newton);
    const StringDescription& string = scene.description.strings.at(0);
    EXPECT_EQ(string.name, "test");
    EXPECT_EQ(string.length_m, 0.8);
    EXPECT_EQ(string.linear_density_kg_per_m, 0.005);
    const auto& modes = std::get<PhysicalModes>(string.modes);
    EXPECT_EQ(modes.count, 20U);
    EXPECT_EQ(modes.tension_N, 100);
    EXPECT_EQ(modes.inharmonicity, 1e-5);
    const auto& decay = std::get<DecayTimePoints>(modes.damping);
    EXPECT_EQ(decay.points[0].frequency_hz, 100);
    EXPECT_EQ(decay.points[1].t60_s, 1);
    const auto& pluck = std::get<Pluck>(string.initial.shape);
    EXPECT_EQ(pluck.position_m, 0.3);
    EXPECT_EQ(pluck.height_m, 0.002);
    EXPECT_EQ(string.initial.start, Start::Exact);
    ASSERT_EQ(string.contacts.size(), 2U);
    EXPECT_EQ(string.contacts[0].restitution, 0.5);
    EXPECT_EQ(string.contacts[1].restitution, 0);
    EXPECT_EQ(string.contacts[1].side, Side::Above);
    EXPECT_EQ(string.contacts[1].height_m, 0.004);
    ASSERT_EQ(string.probes.size(), 4U);
    EXPECT_EQ(string.probes[1].quantity, Quantity::Velocity);
    EXPECT_EQ(string.probes[2].contact, 0U);
    EXPECT_EQ(string.probes[3].quantity, Quantity::Energy);
}

TEST(ReadScene, Defaults) {
    const Scene scene = read_valid(
        R"({"schema": "jawari.scene/1", "duration_s": 1, "strings": [{"length_m": 1, "linear_density_kg_per_m": 0.01,
            "modes": {"count": 3, "tension_N": 50}}]})");
    EXPECT_EQ(scene.description.output_rate_hz, 48000);
    EXPECT_EQ(scene.description.contact_rate_hz, 2016000);
    EXPECT_EQ(scene.description.scheme, Scheme::Exact);
    EXPECT_EQ(scene.description.law, ImpactLaw::Signorini);
    const StringDescription& string = scene.description.strings.at(0);
    EXPECT_EQ(string.name, "string0");
    const auto& modes = std::get<PhysicalModes>(string.modes);
    EXPECT_EQ(modes.inharmonicity, 0);
    EXPECT_EQ(modes.inharmonicity_law, InharmonicityLaw::SquareRoot);
    EXPECT_TRUE(std::holds_alternative<NoLoss>(modes.damping));
    EXPECT_TRUE(std::holds_alternative<AtRest>(string.initial.shape));
    EXPECT_EQ(string.initial.start, Start::Exact);
}

TEST(ReadScene, ContactRateRoundsUpFromTwoMegahertz) {
    const std::string text = replaced(valid_scene, "\"contact_rate_hz\": 80000,", "");
    EXPECT_EQ(read_valid(replaced(text, "8000", "44100")).description.contact_rate_hz, 2028600);
    EXPECT_EQ(read_valid(replaced(text, "8000", "3000000")).description.contact_rate_hz, 3000000);
}

TEST(ReadScene, LawOfTheThetaSchemeIsNewtonUnlessGiven) {
    const std::string theta =
        replaced(valid_scene, "\"scheme\": \"exact\"", "\"scheme\": \"theta\", \"theta\": 0.75");
    EXPECT_EQ(read_valid(theta).description.theta, 0.75);
    EXPECT_EQ(read_valid(replaced(theta, "\"law\": \"newton\",", "")).description.law, ImpactLaw::Newton);
    EXPECT_EQ(read_valid(replaced(theta, "newton", "passive")).description.law, ImpactLaw::Passive);
}

std::string with_modes(const std::string& modes) {
    std::string text = valid_scene;
    const auto from = text.find("\"modes\"");
    return text.replace(from, text.find("\"initial\"") - from, "\"modes\": " + modes + ",\n");
}

TEST(ReadScene, ModesFromTables) {
    const auto string =
        first_string(with_modes(R"({"frequency_hz": [100, 201.5], "decay_per_s": [1, 2.5]})"));
    const auto& table = std::get<ModeTable>(string.modes);
    EXPECT_EQ(table.frequency_hz, (std::vector<double>{100, 201.5}));
    EXPECT_EQ(table.decay_per_s, (std::vector<double>{1, 2.5}));
}

TEST(ReadScene, ModesWithEveryDampingModel) {
    const auto damping_of = [](const std::string& damping) {
        return std::get<PhysicalModes>(
                   first_string(
                       with_modes(
                           R"({"count": 2, "tension_N": 1, "inharmonicity_law": "first_order", "damping": )" +
                           damping + "}"))
                       .modes)
            .damping;
    };
    EXPECT_TRUE(std::holds_alternative<NoLoss>(damping_of(R"({"model": "none"})")));
    const auto valette = std::get<ValetteLoss>(damping_of(
        R"({"model": "valette", "diameter_m": 0.001, "air_viscosity_Pa_s": 2, "air_density_kg_per_m3": 3,
                       "viscoelastic_loss_angle_rad": 4, "inverse_quality": 5})"));
    EXPECT_EQ(valette.diameter_m, 0.001);
    EXPECT_EQ(valette.air_viscosity_Pa_s, 2);
    EXPECT_EQ(valette.air_density_kg_per_m3, 3);
    EXPECT_EQ(valette.viscoelastic_loss_angle_rad, 4);
    EXPECT_EQ(valette.inverse_quality, 5);
}

TEST(ReadScene, InitialStateInModes) {
    const std::string text =
        replaced(valid_scene, R"("pluck": {"position_m": 0.3, "height_m": 0.002}, "start": "exact")",
                 R"("modal_velocity": [0.5, 0.25], "start": "backward")");
    const auto string = first_string(text);
    const auto& state = std::get<ModalState>(string.initial.shape);
    EXPECT_TRUE(state.displacement.empty());
    EXPECT_EQ(state.velocity, (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(string.initial.start, Start::Backward);
}

std::string with_obstacles(const std::string& obstacles) {
    return replaced(valid_scene, "\"probes\": [", obstacles + ", \"probes\": [");
}

TEST(ReadScene, ContactsThenFretsThenNeck) {
    const auto string = first_string(with_obstacles(
        R"("neck": {"grid_points": 3, "profile_m": [[0.2, -0.01], [0.6, -0.03]], "restitution": 0.25},
           "frets": {"count": 12, "height_m": -0.001, "restitution": 0.125})"));
    ASSERT_EQ(string.contacts.size(), 2U + 12U + 3U);
    EXPECT_EQ(string.contacts[1].height_m, 0.004);
    // The twelfth fret halves the string.
    EXPECT_NEAR(string.contacts[2 + 11].position_m, 0.4, 1e-15);
    EXPECT_EQ(string.contacts[2].height_m, -0.001);
    EXPECT_EQ(string.contacts[2].restitution, 0.125);
    // Interior points at a quarter, a half and three quarters of 0.8 m; half way along the profile is half
    // way down.
    EXPECT_NEAR(string.contacts[15].position_m, 0.4, 1e-15);
    EXPECT_NEAR(string.contacts[15].height_m, -0.02, 1e-15);
    EXPECT_EQ(string.contacts[16].restitution, 0.25);
}

TEST(ReadScene, FretsWithTheirOwnHeights) {
    const auto string =
        first_string(with_obstacles(R"("frets": {"count": 2, "height_m": [-0.001, -0.002]})"));
    ASSERT_EQ(string.contacts.size(), 4U);
    EXPECT_EQ(string.contacts[2].height_m, -0.001);
    EXPECT_EQ(string.contacts[3].height_m, -0.002);
    EXPECT_EQ(string.contacts[3].restitution, 0);
}

TEST(ReadScene, CommentsAreAllowedInEveryObject) {
    std::string text = valid_scene;
    for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos; ++at)
        text.insert(at + 1, "\"comment\": [\"x\", 1], ");
    EXPECT_TRUE(read_scene(text, "f"));
}

struct Wrong {
    const char* from;
    const char* to;
    const char* message;
};

/// The place that is refused.
std::string name_of(const Wrong& wrong) {
    const std::string_view message = wrong.message;
    return test::as_test_name(std::string(message.substr(0, message.find(':'))));
}

class WrongScene : public testing::TestWithParam<Wrong> {};

TEST_P(WrongScene, IsRefusedWithPathValueAndRange) {
    const Wrong& wrong = GetParam();
    const auto scene = read_scene(replaced(valid_scene, wrong.from, wrong.to), "f.json");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().kind, ErrorKind::InvalidInput);
    EXPECT_EQ(scene.error().message, std::string("f.json: ") + wrong.message);
}

INSTANTIATE_TEST_SUITE_P(
    ReadScene, WrongScene,
    testing::Values(
        Wrong{"\"schema\": \"jawari.scene/1\",", "", "schema: missing (allowed: \"jawari.scene/1\")"},
        Wrong{"jawari.scene/1", "jawari.scene/2", "schema: \"jawari.scene/2\" (allowed: \"jawari.scene/1\")"},
        Wrong{"\"duration_s\": 0.01,", "", "duration_s: missing (allowed: a number from 0 to 86400)"},
        Wrong{"\"duration_s\": 0.01", "\"duration_s\": -1",
              "duration_s: -1 (allowed: a number from 0 to 86400)"},
        Wrong{"duration_s", "duration",
              "duration: unknown key; did you mean \"duration_s\"? (allowed: schema, duration_s, "
              "output_rate_hz, contact_rate_hz, scheme, "
              "theta, law, "
              "strings)"},
        Wrong{": 8000,", ": 0,", "output_rate_hz: 0 (allowed: a number from 1 to 1000000000)"},
        Wrong{"80000", "\"fast\"", "contact_rate_hz: \"fast\" (allowed: a number from 1 to 1000000000)"},
        Wrong{"\"scheme\": \"exact\"", "\"scheme\": \"euler\"",
              "scheme: \"euler\" (allowed: \"exact\", \"theta\")"},
        Wrong{"newton", "hertz",
              "law: \"hertz\" (allowed: \"newton\", \"passive\", \"signorini\", \"paoli-schatzman\")"},
        Wrong{"\"scheme\"", "\"theta\": 0.4, \"scheme\"", "theta: 0.4 (allowed: a number from 0.5 to 1)"},
        Wrong{"\"length_m\": 0.8,", "", "strings[0].length_m: missing (allowed: a finite number)"},
        Wrong{"\"length_m\": 0.8", "\"length_m\": \"long\"",
              "strings[0].length_m: \"long\" (allowed: a finite number)"},
        Wrong{"\"count\": 20", "\"count\": 1000000000",
              "strings[0].modes.count: 1000000000 (allowed: a whole number from 1 to 8192)"},
        Wrong{"\"count\": 20, ", "",
              "strings[0].modes.count: missing (allowed: a whole number from 1 to 8192)"},
        Wrong{"\"count\": 20", "\"count\": 2.5",
              "strings[0].modes.count: 2.5 (allowed: a whole number from 1 to 8192)"},
        Wrong{"square_root", "cubic",
              "strings[0].modes.inharmonicity_law: \"cubic\" (allowed: \"square_root\", \"first_order\")"},
        Wrong{"\"model\": \"t60\"", "\"model\": \"q\"",
              "strings[0].modes.damping.model: \"q\" (allowed: \"none\", \"valette\", \"t60\")"},
        Wrong{"\"model\": \"t60\"", "\"model\": \"none\"",
              "strings[0].modes.damping.points: unknown key (allowed: model)"},
        Wrong{", {\"frequency_hz\": 1000, \"t60_s\": 1}", "",
              "strings[0].modes.damping.points: an array of 1 (allowed: an array of 2)"},
        Wrong{"\"start\": \"exact\"", "\"start\": \"soft\"",
              "strings[0].initial.start: \"soft\" (allowed: \"exact\", \"backward\")"},
        Wrong{"\"start\": \"exact\"", "\"modal_velocity\": [1]",
              "strings[0].initial.pluck: beside a modal state (allowed: either a pluck or a modal state)"},
        Wrong{"\"restitution\": 0.5", "\"restitution\": 1.5",
              "strings[0].contacts[0].restitution: 1.5 (allowed: a number from 0 to 1)"},
        Wrong{"\"side\": \"above\"", "\"side\": \"left\"",
              "strings[0].contacts[1].side: \"left\" (allowed: \"below\", \"above\")"},
        Wrong{"\"contacts\": [", "\"contacts\": [7, ", "strings[0].contacts[0]: 7 (allowed: an object)"},
        Wrong{"{\"quantity\": \"energy\"}", "{\"quantity\": \"energy\", \"contact\": 1}",
              "strings[0].probes[3].contact: unknown key (allowed: quantity)"},
        Wrong{"\"contact\": 0", "\"contact\": -1",
              "strings[0].probes[2].contact: -1 (allowed: a whole number from 0 to 4095)"},
        Wrong{"\"quantity\": \"velocity\"", "\"quantity\": \"speed\"",
              "strings[0].probes[1].quantity: \"speed\" (allowed: \"displacement\", \"velocity\", "
              "\"acceleration\", \"slope\", \"nut_force\", \"bridge_force\", \"mode_displacement\", "
              "\"mode_velocity\", \"mode_energy\", \"contact_force\", \"hammer_force\", "
              "\"hammer_displacement\", \"energy\")"},
        Wrong{"\"probes\": [", "\"frets\": {\"count\": 1000000000, \"height_m\": 0}, \"probes\": [",
              "strings[0].frets.count: 1000000000 (allowed: a whole number from 1 to 4094)"},
        Wrong{"\"probes\": [", "\"frets\": {\"count\": 3, \"height_m\": [0, 0]}, \"probes\": [",
              "strings[0].frets.height_m: an array of 2 (allowed: as many heights as count, 3)"},
        Wrong{"\"probes\": [", "\"neck\": {\"grid_points\": 0, \"profile_m\": [[0, 0]]}, \"probes\": [",
              "strings[0].neck.grid_points: 0 (allowed: a whole number from 1 to 4094)"},
        Wrong{"\"probes\": [", "\"neck\": {\"grid_points\": 4, \"profile_m\": []}, \"probes\": [",
              "strings[0].neck.profile_m: an empty array (allowed: at least one [position, height])"},
        Wrong{
            "\"probes\": [",
            "\"neck\": {\"grid_points\": 4, \"profile_m\": [[0.5, 0], [0.4, 0]]}, \"probes\": [",
            "strings[0].neck.profile_m[1][0]: 0.4 (allowed: positions that do not decrease, here from 0.5)"},
        Wrong{"\"probes\": [", "\"neck\": {\"grid_points\": 4, \"profile_m\": [[0.5]]}, \"probes\": [",
              "strings[0].neck.profile_m[0]: an array of 1 (allowed: [position, height])"}),
    [](const auto& wrong) { return name_of(wrong.param) + "_" + std::to_string(wrong.index); });

/// What only compile() can see, told in the file's terms.
std::string compile_failure(const std::string& text) {
    const Scene scene = read_valid(text);
    const auto model = compile(scene.description);
    return model ? "none" : in_file_terms(scene, model.failure()).place;
}

TEST(InFileTerms, EngineFailuresNameTheKeyOfTheFile) {
    EXPECT_EQ(compile_failure(valid_scene), "none");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "\"length_m\": 0.8", "\"length_m\": -1")),
              "strings[0].length_m");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "\"tension_N\": 100", "\"tension_N\": 0")),
              "strings[0].modes.tension_N");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "\"position_m\": 0.5,", "\"position_m\": 0.9,")),
              "strings[0].contacts[1].position_m");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "\"contact\": 0", "\"contact\": 2")),
              "strings[0].probes[2].contact");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "80000", "80001")), "contact_rate_hz");
    EXPECT_EQ(compile_failure(replaced(valid_scene, "\"position_m\": 0.3", "\"position_m\": 0.8")),
              "strings[0].initial.pluck.position_m");
}

TEST(InFileTerms, ContactsOfFretsAndNeckNameTheirOwnKeys) {
    const Scene scene = read_valid(with_obstacles(
        R"("frets": {"count": 2, "height_m": [0, 0]}, "neck": {"grid_points": 3, "profile_m": [[0, 0]]})"));
    const auto place = [&](const char* engine) { return in_file_terms(scene, {engine, "", ""}).place; };
    EXPECT_EQ(place("strings[0].contacts[1].height_m"), "strings[0].contacts[1].height_m");
    EXPECT_EQ(place("strings[0].contacts[3].height_m"), "strings[0].frets.height_m[1]");
    EXPECT_EQ(place("strings[0].contacts[3].position_m"), "strings[0].frets.count");
    EXPECT_EQ(place("strings[0].contacts[2].restitution"), "strings[0].frets.restitution");
    EXPECT_EQ(place("strings[0].contacts[4].height_m"), "strings[0].neck.profile_m");
    EXPECT_EQ(place("strings[0].contacts[6].position_m"), "strings[0].neck.grid_points");
    EXPECT_EQ(place("strings[0].contacts"), "strings[0].contacts");
    EXPECT_EQ(place("strings[0].length_m"), "strings[0].length_m");
    const Scene even = read_valid(with_obstacles(R"("frets": {"count": 2, "height_m": 0})"));
    EXPECT_EQ(in_file_terms(even, {"strings[0].contacts[3].height_m", "", ""}).place,
              "strings[0].frets.height_m");
}

TEST(LoadScene, BuiltInScenesAreTheFilesOfThePresets) {
    ASSERT_EQ(builtin_scene_names(),
              (std::vector<std::string>{"lab/bar", "lab/bass", "lab/fretless", "lab/one-contact", "lab/plate",
                                        "lab/tanpura", "smooth/bass"}));
    for (const std::string& name : builtin_scene_names()) {
        const auto scene = load_scene(name);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene.value().text,
                  test::read_text(std::string(JAWARI_SOURCE_DIR) + "/presets/scenes/" + name + ".json"));
        EXPECT_TRUE(compile(scene.value().description));
    }
}

TEST(LoadScene, AFileComesBeforeABuiltInScene) {
    const test::TemporaryFolder folder;
    const auto scene = load_scene(folder.write("mine.json", valid_scene));
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene.value().name, "mine");
    EXPECT_EQ(scene.value().file, folder.file("mine.json"));
    const auto unknown = load_scene(folder.file("none.json"));
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::File);
    EXPECT_NE(unknown.error().message.find("lab/bar, lab/bass, lab/fretless, lab/one-contact"),
              std::string::npos);
}

}  // namespace
}  // namespace jawari::host
