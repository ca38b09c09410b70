// Preset files: every key arrives, every fault is named with its place, and the built-in presets compile and
// play.
#include "preset/read_preset.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "jawari/instrument_render.h"
#include "temporary_folder.h"

namespace jawari::host {
namespace {

const std::string valid_preset = R"({
  "schema": "jawari.preset/1", "comment": "allowed", "name": "one string", "gain": 0.5,
  "contact_rate_min_hz": 200000, "mode_limit_hz": 9000, "law": "passive", "release_t60_s": 0.2,
  "pluck": {"position_from_bridge_m": 0.15, "rise_s": 0.003, "release_s": 0.001, "full_height_m": 0.002, "height_exponent": 1.5},
  "frets": {"height_m": [-0.001, -0.002], "restitution": 0.25, "comment": ["also", "allowed"]},
  "pickups": [{"position_from_bridge_m": 0.1, "width_m": 0.02, "level": -2}],
  "strings": [{"name": "E", "open_note": 28, "open_frequency_hz": 41.2, "length_m": 0.86, "linear_density_kg_per_m": 0.03,
               "inharmonicity": 1e-4, "level": 0.75,
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
        EXPECT_EQ(preset.error().code, ExitCode::InvalidInput);
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
    EXPECT_EQ(i.contact_rate_min_hz, 200000);
    EXPECT_EQ(i.mode_limit_hz, 9000);
    EXPECT_EQ(i.law, ImpactLaw::Passive);
    EXPECT_EQ(i.release_t60_s, 0.2);
    EXPECT_EQ(i.pluck.position_from_bridge_m, 0.15);
    EXPECT_EQ(i.pluck.rise_s, 0.003);
    EXPECT_EQ(i.pluck.release_s, 0.001);
    EXPECT_EQ(i.pluck.full_height_m, 0.002);
    EXPECT_EQ(i.pluck.height_exponent, 1.5);
    EXPECT_EQ(i.frets.height_m, (std::vector{-0.001, -0.002}));
    EXPECT_EQ(i.frets.restitution, 0.25);
    ASSERT_EQ(i.pickups.size(), 1U);
    EXPECT_EQ(i.pickups[0].position_from_bridge_m, 0.1);
    EXPECT_EQ(i.pickups[0].width_m, 0.02);
    EXPECT_EQ(i.pickups[0].level, -2);
    ASSERT_EQ(i.strings.size(), 1U);
    const InstrumentStringDescription& s = i.strings[0];
    EXPECT_EQ(s.name, "E");
    EXPECT_EQ(s.open_note, 28);
    EXPECT_EQ(s.open_frequency_hz, 41.2);
    EXPECT_EQ(s.length_m, 0.86);
    EXPECT_EQ(s.linear_density_kg_per_m, 0.03);
    EXPECT_EQ(s.inharmonicity, 1e-4);
    EXPECT_EQ(s.level, 0.75);
    EXPECT_EQ(std::get<DecayTimePoints>(s.damping).points[1].t60_s, 1);
    EXPECT_EQ(message_of(valid_preset), "accepted");
}

TEST(ReadPreset, EveryFaultIsNamedWithItsPlace) {
    struct Fault {
        std::string from, to, place;
    };
    const std::vector<Fault> faults{
        {"jawari.preset/1", "jawari.scene/1", "schema: "},
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
        {"\"full_height_m\": 0.002", "\"full_height_m\": 2", "pluck.full_height_m: 2"},
        {"\"width_m\": 0.02", "\"width_m\": 5", "pickups[0].width_m: 5"},
        {"\"model\": \"t60\"", "\"model\": \"felt\"", "strings[0].damping.model: "},
        {"\"t60_s\": 1}", "\"t60_s\": -1}", "strings[0]."}};
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
    EXPECT_EQ(load_preset(folder.file("absent")).error().code, ExitCode::File);
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
            const InstrumentEvent event{0, InstrumentEventType::NoteOn, 0, model.value().strings[0].open_note,
                                        0.8};
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
            const InstrumentEvent event{0, InstrumentEventType::NoteOn, 0,
                                        string.open_note + static_cast<int>(fret), 30 / 127.0};
            std::vector<double> output(9600);
            render_instrument(model.value(), state, {&event, 1}, output.data(), output.size());
            EXPECT_EQ(contact_counters(state).impulses, 0U) << string.name << " fret " << fret;
        }
    }
}

}  // namespace
}  // namespace jawari::host
