#include "midi/read_midi_map.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace jawari::host {
namespace {

std::string document(const std::string& bindings) {
    return R"({"schema": "jawari.midi-map/1", "comment": "x", "bindings": [)" + bindings + "]}";
}

MidiMap map_of(const std::string& bindings) {
    auto map = read_midi_map(document(bindings), "m.json");
    EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().message);
    return map.ok() ? map.value() : MidiMap{};
}

const MidiBinding* find(const MidiMap& map, MidiSource source, int number) {
    for (std::size_t i = 0; i < map.count; ++i)
        if (map.bindings[i].source == source && map.bindings[i].number == number) return &map.bindings[i];
    return nullptr;
}

TEST(ReadMidiMap, BindingsOfEveryKind) {
    const MidiMap map = map_of(
        R"({"controller": 71, "parameter": "pluck_hardness"},
           {"controller": 16, "bits": 14, "parameter": "palm_mute", "from": 0.5, "to": 0, "curve": "squared"},
           {"nrpn": 1234, "channel": 16, "parameter": "body_mix"},
           {"pressure": "channel", "parameter": "vibrato_depth", "to": 0.5, "curve": "linear"})");
    EXPECT_EQ(map.count, 9U);
    const MidiBinding* plain = find(map, MidiSource::Controller, 71);
    ASSERT_NE(plain, nullptr);
    EXPECT_EQ(plain->parameter, ParameterId::PluckHardness);
    EXPECT_EQ(bound_value(*plain, 0), declaration_of(ParameterId::PluckHardness).low);
    EXPECT_EQ(plain->channel, -1);
    const MidiBinding* pair = find(map, MidiSource::Controller14, 16);
    ASSERT_NE(pair, nullptr);
    EXPECT_EQ(bound_value(*pair, 0), 0.5);
    EXPECT_EQ(bound_value(*pair, 0.5), 0.375);
    EXPECT_EQ(bound_value(*pair, 1), 0.0);
    EXPECT_EQ(find(map, MidiSource::Nrpn, 1234)->channel, 15);
    EXPECT_EQ(find(map, MidiSource::ChannelPressure, 0)->high, 0.5);
}

TEST(ReadMidiMap, TheFileReplacesDefaultsOfItsControls) {
    const MidiMap map = map_of(R"({"controller": 1, "parameter": "palm_mute"},
                                  {"controller": 1, "parameter": "body_mix"},
                                  {"controller": 7, "parameter": "none"},
                                  {"controller": 10, "bits": 14, "parameter": "pan"})");
    EXPECT_EQ(find(map, MidiSource::Controller, 1)->parameter, ParameterId::PalmMute);
    EXPECT_EQ(find(map, MidiSource::Controller, 7), nullptr);
    EXPECT_EQ(find(map, MidiSource::Controller, 10), nullptr);
    EXPECT_NE(find(map, MidiSource::Controller14, 10), nullptr);
    EXPECT_NE(find(map, MidiSource::Controller, 11), nullptr);
    EXPECT_EQ(map.count, 5U);
}

TEST(ReadMidiMap, EachFaultIsNamedWithItsPath) {
    const std::vector<std::pair<std::string, std::string>> faults{
        {R"({"parameter": "pan"})", "m.json: bindings[0]: 0 controls (allowed: one of controller"},
        {R"({"controller": 1, "nrpn": 2, "parameter": "pan"})", "bindings[0]: 2 controls"},
        {R"({"controller": 64, "parameter": "pan"})",
         "bindings[0].controller: 64 (allowed: 0 to 119 without"},
        {R"({"controller": 120, "parameter": "pan"})", "bindings[0].controller: 120"},
        {R"({"controller": 40, "bits": 14, "parameter": "pan"})", "bindings[0].controller: 40"},
        {R"({"controller": 2, "bits": 8, "parameter": "pan"})", "bindings[0].bits: 8 (allowed: 7 or 14"},
        {R"({"nrpn": 2, "bits": 14, "parameter": "pan"})", "bindings[0].bits"},
        {R"({"nrpn": 16383, "parameter": "pan"})", "bindings[0].nrpn: 16383"},
        {R"({"pressure": "poly", "parameter": "pan"})", "bindings[0].pressure: \"poly\""},
        {R"({"controller": 2})", "bindings[0].parameter: missing"},
        {R"({"controller": 2, "parameter": "pam"})",
         "bindings[0].parameter: \"pam\"; did you mean \"pan\"? (allowed: volume, "},
        {R"({"controller": 2, "parameter": "pan", "to": 2})", "bindings[0].to: 2 (allowed: a number from -1"},
        {R"({"controller": 2, "parameter": "pan", "curve": "exponential"})", "bindings[0].curve"},
        {R"({"controller": 2, "parameter": "pan", "channel": 0})", "bindings[0].channel: 0"},
        {R"({"controller": 2, "parameter": "pan", "low": 0})", "bindings[0].low: unknown key"},
        {"7", "bindings[0]: 7 (allowed: an object"}};
    for (const auto& [binding, message] : faults) {
        const auto map = read_midi_map(document(binding), "m.json");
        ASSERT_FALSE(map.ok()) << binding;
        EXPECT_EQ(map.error().kind, ErrorKind::InvalidInput);
        EXPECT_NE(map.error().message.find(message), std::string::npos)
            << map.error().message << "\nexpected: " << message;
    }
    EXPECT_NE(read_midi_map(R"({"schema": "jawari.midi-map/2", "bindings": []})", "m.json")
                  .error()
                  .message.find("schema: \"jawari.midi-map/2\""),
              std::string::npos);
    EXPECT_FALSE(read_midi_map("{", "m.json").ok());
}

TEST(ReadMidiMap, BindingsOfOneControlAreBounded) {
    std::string five;
    for (int i = 0; i < 5; ++i)
        five += std::string(i > 0 ? "," : "") + R"({"controller": 2, "bits": )" + (i % 2 == 0 ? "7" : "14") +
                R"(, "parameter": "pan"})";
    EXPECT_NE(read_midi_map(document(five), "m.json").error().message.find("bindings[4]: one more"),
              std::string::npos);
}

TEST(ReadMidiMap, TheDefaultMapNamesEachControlOnce) {
    const MidiMap map = default_midi_map();
    for (std::size_t i = 0; i < map.count; ++i) EXPECT_FALSE(is_reserved_controller(map.bindings[i].number));
    EXPECT_EQ(map_of("").count, map.count);
}

}  // namespace
}  // namespace jawari::host
