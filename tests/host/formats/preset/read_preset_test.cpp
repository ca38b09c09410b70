// Preset files: every key arrives, every fault is named with its place, and the built-in presets compile and
// play.
#include "formats/preset/read_preset.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "instrument/preset_library.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

const std::string valid_preset = R"({
  "schema": "jawari.preset/2", "comment": "allowed", "name": "one string", "gain": 0.5,
  "contact_rate_min_hz": 200000, "mode_limit_hz": 9000, "law": "passive", "play": "guitar", "contacts": false,
  "studio": {"contact_rate_min_hz": 400000, "mode_limit_hz": 18000},
  "provenance": {"gain": "chosen by ear"},
  "exciters": [
    {"name": "finger", "kind": "finger", "position_from_bridge_m": 0.15, "width_m": 0.01, "velocity_range": [0, 0.5],
     "string_range": [0, 3], "time_exponent": 0.5, "rise_s": 0.003, "release_s": 0.001, "full_height_m": 0.002,
     "height_exponent": 1.5, "damping_kg_per_s": 0.25, "roughness": 0.125},
    {"name": "hammer", "kind": "hammer", "position_share": 0.125, "mass_kg": 0.005, "stiffness_N_per_m_p": 1e9,
     "exponent": 2.5, "loss_s_per_m": 0.01, "full_speed_m_per_s": 3, "speed_exponent": 1.25,
     "side": "above"},
    {"name": "tangent", "kind": "tangent", "rise_s": 0.002, "full_height_m": 0.001, "height_exponent": 0.75}],
  "hand": {"damps": false, "release_places": [{"position_share": 0.2}, {"position_from_bridge_m": 0.3}], "release_t60_s": 0.2,
           "release_spread": 3, "release_noise_N": 0.375, "release_noise_s": 0.0625, "palm_place": {"position_share": 0.05}, "palm_t60_s": 0.3, "dead_t60_s": 0.04,
           "harmonic_t60_s": 0.05, "harmonic_touch_s": 0.25, "legato_level": 0.5, "pressure_semitones": 0.75,
           "course_delay_s": 0.002},
  "frets": {"height_m": [-0.001, -0.002], "restitution": 0.25, "comment": ["also", "allowed"]},
  "obstacles": [{"name": "bridge", "origin": "bridge", "parabola": {"length_m": 0.02, "drop_m": 0.001, "height_m": -0.0001}, "points": 5},
                {"name": "rattle", "origin": "nut", "side": "above", "profile_m": [[0.3, 0.002], [0.4, 0.003]], "restitution": 0.5, "strings": [0]}],
  "soft_touches": [{"name": "cotton", "position_share": 0.1, "width_m": 0.01, "damping_kg_per_s": 0.125, "stiffness_N_per_m": 100, "strings": [0]}],
  "pickups": [{"position_from_bridge_m": 0.1, "width_m": 0.02, "level": -2, "magnet_distance_m": 0.003, "resonance_hz": 3000, "quality_factor": 2.5},
              {"quantity": "bridge_force", "level": 0.01}],
  "body": [{"frequency_hz": 100, "t60_s": 0.5, "gain_left": 2, "gain_right": 3},
           {"frequency_hz": 200, "quality_factor": 30, "gain_left": 4}],
  "strings": [{"name": "E", "open_note": 28, "open_frequency_hz": 41.2, "length_m": 0.86, "linear_density_kg_per_m": 0.03,
               "inharmonicity": 1e-4, "level": 0.75, "excitation": 1.5, "pan": -0.5, "course": 0, "exciter_place": {"position_share": 0.2}, "release_t60_s": 0.3,
               "damping": {"model": "t60", "points": [{"frequency_hz": 41, "t60_s": 10}, {"frequency_hz": 5000, "t60_s": 1}]}}]
})";

std::string with(const std::string& from, const std::string& to) {
    std::string text = valid_preset;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

/// The message of reading, or of compiling what was read.
std::string message_of(const std::string& text) {
    const auto preset = read_preset(text, "p.json");
    if (!preset) {
        EXPECT_EQ(preset.error().kind, ErrorKind::InvalidInput);
        return preset.error().message;
    }
    const auto model = compile_instrument(preset.value().instrument, 48000);
    return model ? "accepted" : invalid_input("p.json", model.failure()).message;
}

TEST(ReadPreset, EveryKeyArrives) {
    const auto preset = read_preset(valid_preset, "p.json");
    ASSERT_TRUE(preset) << preset.error().message;
    const InstrumentDescription& i = preset.value().instrument;
    EXPECT_EQ(i.name, "one string");
    EXPECT_EQ(i.gain, 0.5);
    EXPECT_EQ(i.quality.contact_rate_min_hz, 200000);
    EXPECT_EQ(i.quality.mode_limit_hz, 9000);
    ASSERT_TRUE(i.studio);
    EXPECT_EQ(i.studio->contact_rate_min_hz, 400000);
    EXPECT_EQ(i.studio->mode_limit_hz, 18000);
    EXPECT_EQ(i.law, ImpactLaw::Passive);
    EXPECT_EQ(i.play, PlayMode::Guitar);
    EXPECT_FALSE(i.contacts);
    EXPECT_EQ(i.frets.count, 2U);
    EXPECT_EQ(i.frets.height_m, (std::vector{-0.001, -0.002}));
    EXPECT_EQ(i.frets.restitution, 0.25);
    ASSERT_EQ(i.strings.size(), 1U);
    const InstrumentStringDescription& s = i.strings[0];
    EXPECT_EQ(s.name, "E");
    EXPECT_EQ(s.open_note, 28);
    EXPECT_EQ(s.open_frequency_hz, 41.2);
    EXPECT_EQ(s.length_m, 0.86);
    EXPECT_EQ(s.linear_density_kg_per_m, 0.03);
    EXPECT_EQ(s.inharmonicity, 1e-4);
    EXPECT_EQ(s.level, 0.75);
    EXPECT_EQ(s.excitation, 1.5);
    EXPECT_EQ(s.pan, -0.5);
    EXPECT_EQ(s.exciter_place.value().share, 0.2);
    EXPECT_EQ(s.release_t60_s, 0.3);
    EXPECT_EQ(s.course, std::optional<std::size_t>(0));
    EXPECT_EQ(std::get<DecayTimePoints>(s.damping).points[1].t60_s, 1);
    EXPECT_EQ(message_of(valid_preset), "accepted");
}

TEST(ReadPreset, EveryKeyOfThePlayersArrives) {
    const InstrumentDescription i = read_preset(valid_preset, "p.json").value().instrument;
    ASSERT_EQ(i.exciters.size(), 3U);
    const ExciterDescription& e = i.exciters[0];
    EXPECT_EQ(e.name, "finger");
    EXPECT_EQ(e.place.from_bridge_m, 0.15);
    EXPECT_EQ(e.width_m, 0.01);
    EXPECT_EQ(e.lowest_velocity, 0);
    EXPECT_EQ(e.highest_velocity, 0.5);
    EXPECT_EQ(e.first_string, 0U);
    EXPECT_EQ(e.last_string, 3U);
    EXPECT_EQ(e.time_exponent, 0.5);
    const auto& finger = std::get<FingerDescription>(e.body);
    EXPECT_EQ(finger.rise_s, 0.003);
    EXPECT_EQ(finger.release_s, 0.001);
    EXPECT_EQ(finger.full_height_m, 0.002);
    EXPECT_EQ(finger.height_exponent, 1.5);
    EXPECT_EQ(finger.damping_kg_per_s, 0.25);
    EXPECT_EQ(finger.roughness, 0.125);
    EXPECT_EQ(i.exciters[1].place.share, 0.125);
    const auto& hammer = std::get<HammerDescription>(i.exciters[1].body);
    EXPECT_EQ(hammer.mass_kg, 0.005);
    EXPECT_EQ(hammer.stiffness, 1e9);
    EXPECT_EQ(hammer.exponent, 2.5);
    EXPECT_EQ(hammer.loss_s_per_m, 0.01);
    EXPECT_EQ(hammer.full_speed_m_per_s, 3);
    EXPECT_EQ(hammer.speed_exponent, 1.25);
    EXPECT_EQ(hammer.side, Side::Above);
    const auto& tangent = std::get<TangentDescription>(i.exciters[2].body);
    EXPECT_EQ(tangent.rise_s, 0.002);
    EXPECT_EQ(tangent.full_height_m, 0.001);
    EXPECT_EQ(tangent.height_exponent, 0.75);
    EXPECT_FALSE(i.hand.damps);
    EXPECT_EQ(i.hand.release_places[0].share, 0.2);
    EXPECT_EQ(i.hand.release_places[1].from_bridge_m, 0.3);
    EXPECT_EQ(i.hand.release_t60_s, 0.2);
    EXPECT_EQ(i.hand.release_spread, 3);
    EXPECT_EQ(i.hand.release_noise_N, 0.375);
    EXPECT_EQ(i.hand.release_noise_s, 0.0625);
    EXPECT_EQ(i.hand.palm_place.share, 0.05);
    EXPECT_EQ(i.hand.palm_t60_s, 0.3);
    EXPECT_EQ(i.hand.dead_t60_s, 0.04);
    EXPECT_EQ(i.hand.harmonic_t60_s, 0.05);
    EXPECT_EQ(i.hand.harmonic_touch_s, 0.25);
    EXPECT_EQ(i.hand.legato_level, 0.5);
    EXPECT_EQ(i.hand.pressure_semitones, 0.75);
    EXPECT_EQ(i.hand.course_delay_s, 0.002);
}

TEST(ReadPreset, EveryKeyOfObstaclesAndOutputArrives) {
    const InstrumentDescription i = read_preset(valid_preset, "p.json").value().instrument;
    ASSERT_EQ(i.obstacles.size(), 2U);
    EXPECT_EQ(i.obstacles[0].origin, Origin::Bridge);
    EXPECT_EQ(i.obstacles[0].points, 5U);
    const auto& parabola = std::get<ParabolicProfile>(i.obstacles[0].profile);
    EXPECT_EQ(parabola.length_m, 0.02);
    EXPECT_EQ(parabola.drop_m, 0.001);
    EXPECT_EQ(parabola.height_m, -0.0001);
    EXPECT_EQ(i.obstacles[1].side, Side::Above);
    EXPECT_EQ(i.obstacles[1].restitution, 0.5);
    EXPECT_EQ(i.obstacles[1].strings, std::vector<std::size_t>{0});
    EXPECT_EQ(std::get<CornerProfile>(i.obstacles[1].profile)[1], (std::pair{0.4, 0.003}));
    ASSERT_EQ(i.soft_touches.size(), 1U);
    EXPECT_EQ(i.soft_touches[0].place.share, 0.1);
    EXPECT_EQ(i.soft_touches[0].damping_kg_per_s, 0.125);
    EXPECT_EQ(i.soft_touches[0].stiffness_N_per_m, 100);
    ASSERT_EQ(i.pickups.size(), 2U);
    EXPECT_EQ(i.pickups[0].place.from_bridge_m, 0.1);
    EXPECT_EQ(i.pickups[0].width_m, 0.02);
    EXPECT_EQ(i.pickups[0].level, -2);
    EXPECT_EQ(i.pickups[0].magnet_distance_m, 0.003);
    EXPECT_EQ(i.pickups[0].resonance_hz, 3000);
    EXPECT_EQ(i.pickups[0].quality_factor, 2.5);
    EXPECT_EQ(i.pickups[1].quantity, PickupQuantity::BridgeForce);
    ASSERT_EQ(i.body.size(), 2U);
    EXPECT_EQ(i.body[0].t60_s, 0.5);
    EXPECT_EQ(i.body[0].gain_right, 3);
    EXPECT_EQ(i.body[1].gain_right, 4);
    EXPECT_NEAR(i.body[1].t60_s, 2.1988 * 30 / 200, 1e-4);  // 2.2 Q/f, a common rule
}

TEST(ReadPreset, EveryFaultIsNamedWithItsPlace) {
    struct Fault {
        std::string from, to, place;
    };
    const std::vector<Fault> faults{
        {"jawari.preset/2", "jawari.scene/1", "schema: "},
        {"\"gain\": 0.5", "\"gian\": 0.5", "gian: "},
        {"\"gain\": 0.5,", "", "gain: "},
        {"\"gain\": 0.5", "\"gain\": \"loud\"", "gain: "},
        {"\"gain\": 0.5", "\"gain\": -1", "gain: -1"},
        {"\"gain\": 0.5", "\"gain\": 1e999", ""},
        {"\"passive\"", "\"rubber\"", "law: "},
        {"\"open_note\": 28", "\"open_note\": 28.5", "strings[0].open_note: 28.5"},
        {"\"open_note\": 28", "\"open_note\": 126", "strings[0].open_note: 126"},
        {"\"length_m\": 0.86", "\"length_m\": -0.86", "strings[0].length_m: -0.86"},
        {"\"length_m\": 0.86", "\"length\": 0.86", "strings[0].length: "},
        {"-0.002]", "0.002]", "frets.height_m[1]: 0.002"},
        {"-0.002]", "-0.0005]", "frets.height_m[1]: -0.0005"},
        {"-0.002]", "null]", "frets.height_m[1]: "},
        {"\"mode_limit_hz\": 9000", "\"mode_limit_hz\": 1e9", "mode_limit_hz: "},
        {"\"full_height_m\": 0.002", "\"full_height_m\": 2", "exciters[0].full_height_m: 2"},
        {"\"kind\": \"hammer\"", "\"kind\": \"brick\"", "exciters[1].kind: "},
        {"\"mass_kg\": 0.005", "\"mass_kg\": 5", "exciters[1].mass_kg: 5"},
        {"\"position_share\": 0.125,", "", "exciters[1].position_from_bridge_m: missing"},
        {"\"position_share\": 0.125,", "\"position_share\": 0.125, \"position_from_bridge_m\": 0.1,",
         "exciters[1].position_from_bridge_m: given beside"},
        {"\"gain\": \"chosen by ear\"", "\"gain\": \"guessed\"", "provenance.gain: "},
        {"\"gain\": \"chosen by ear\"", "\"gian\": \"chosen\"", "provenance.gian: "},
        {"\"points\": 5", "\"points\": 0", "obstacles[0].points: 0"},
        {"[0.4, 0.003]", "[0.2, 0.003]", "obstacles[1].profile_m[1][0]: 0.2"},
        {"[0.4, 0.003]", "[0.4]", "obstacles[1].profile_m[1]: "},
        {"\"strings\": [0]}]", "\"strings\": [7]}]", "obstacles[1].strings[0]: 7"},
        {"\"quality_factor\": 30", "\"quality_factor\": 0", "body[1].quality_factor: 0"},
        {"\"course\": 0", "\"course\": 3", "strings[0].course: 3"},
        {"\"width_m\": 0.02", "\"width_m\": 5", "pickups[0].width_m: 5"},
        {"\"model\": \"t60\"", "\"model\": \"felt\"", "strings[0].damping.model: "},
        {"\"t60_s\": 1}", "\"t60_s\": -1}", "strings[0]."},
        {"\"schema\": \"jawari.preset/2\", ", "",
         "schema: missing (allowed: \"jawari.preset/3\" or \"jawari.preset/2\")"},
        {"{\"gain\": \"chosen by ear\"}", "7", "provenance: 7 (allowed: an object)"},
        {"\"contacts\": false", "\"contacts\": 0", "contacts: 0 (allowed: true or false)"},
        {"\"strings\": [0]}]", "\"strings\": [0.5]}]",
         "obstacles[1].strings[0]: 0.5 (allowed: a whole number from 0)"},
        {"\"velocity_range\": [0, 0.5]", "\"velocity_range\": [0]",
         "exciters[0].velocity_range: 1 numbers (allowed: two numbers)"},
        {"\"string_range\": [0, 3]", "\"string_range\": [3]", "exciters[0].string_range: 1 numbers"},
        {"\"profile_m\": [[0.3, 0.002], [0.4, 0.003]], ", "", "obstacles[1].profile_m: missing"},
        {"\"points\": 5", "\"points\": 5, \"profile_m\": [[0.1, -0.001]]",
         "obstacles[0].profile_m: given beside parabola"},
        {"\"quality_factor\": 30", "\"quality_factor\": 30, \"t60_s\": 1",
         "body[1].t60_s: given beside quality_factor"},
        {"\"quality_factor\": 30, ", "", "body[1].t60_s: missing"}};
    for (const Fault& fault : faults) {
        const std::string message = message_of(with(fault.from, fault.to));
        EXPECT_EQ(message.rfind("p.json", 0), 0U) << message;
        EXPECT_NE(message.find(fault.place), std::string::npos) << message << "\n  expected: " << fault.place;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    EXPECT_EQ(message_of(valid_preset.substr(0, 300)).rfind("p.json:", 0), 0U);
}

TEST(ReadPreset, FilesAreFoundBeforeBuiltInNames) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(load_preset(folder.write("my.json", valid_preset)).value().instrument.name, "one string");
    EXPECT_EQ(load_preset("bass-fretted").value().file, "bass-fretted");
    EXPECT_EQ(load_preset(folder.file("absent")).error().kind, ErrorKind::File);
}

TEST(FactoryPresets, AllLoadCompileAndSound) {
    const auto names = builtin_preset_names();
    EXPECT_FALSE(names.empty());
    for (const std::string& name : names) {
        const auto preset = load_preset(name);
        ASSERT_TRUE(preset) << preset.error().message;
        for (const double rate_hz : {44100.0, 48000.0, 96000.0}) {
            const auto model = compile_instrument(preset.value().instrument, rate_hz);
            ASSERT_TRUE(model) << name << ": " << model.failure().line();
            InstrumentState state = make_instrument_state(model.value());
            const InstrumentEvent event = note_on(0, model.value().strings[0].stopped[0].key, 0.8);
            std::vector<double> output(4096);
            render_instrument(model.value(), state, {&event, 1}, output.data(), output.size());
            double peak = 0;
            for (const double sample : output) peak = std::max(peak, std::abs(sample));
            EXPECT_GT(peak, 0.01) << name;
            EXPECT_LT(peak, 2) << name;
        }
    }
}

/// Every string alone, at every fret: velocity 30 never touches a fret.
TEST(FactoryPresets, SoftNotesOfTheFrettedBassClearEveryFret) {
    const InstrumentDescription bass = load_preset("bass-fretted").value().instrument;
    for (const InstrumentStringDescription& string : bass.strings) {
        InstrumentDescription alone = bass;
        alone.strings = {string};
        const auto model = compile_instrument(alone, 48000);
        ASSERT_TRUE(model);
        for (std::size_t fret = 0; fret <= bass.frets.height_m.size(); ++fret) {
            InstrumentState state = make_instrument_state(model.value());
            const InstrumentEvent event = note_on(0, string.open_note + static_cast<int>(fret), 30 / 127.0);
            std::vector<double> output(9600);
            render_instrument(model.value(), state, {&event, 1}, output.data(), output.size());
            EXPECT_EQ(contact_counters(state).impulses, 0U) << string.name << " fret " << fret;
        }
    }
}

}  // namespace
}  // namespace jawari::host
