// The state's text: exact, of all versions so far, and refused whole.
#include "plugin/core/plugin_state.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/builtin.h"
#include "plugin/core/compile_state.h"
#include "plugin/core/utf8.h"

namespace jawari::host {
namespace {

using nlohmann::ordered_json;

ordered_json written() {
    return ordered_json::parse(write_plugin_state(new_plugin_state()));
}

std::string problem(const ordered_json& state) {
    const auto read = read_plugin_state(state.dump());
    return read ? "none" : read.error().message;
}

TEST(PluginState, AnyStateReadsBackBitForBit) {
    std::mt19937_64 random(5);
    for (int n = 0; n < 50; ++n) {
        PluginState state = new_plugin_state();
        for (const ParameterDeclaration& parameter : parameter_table()) {
            const double travel = static_cast<double>(random() >> 11U) * 0x1p-53;
            state.parameters[static_cast<std::size_t>(parameter.id)] = parameter_value(parameter, travel);
        }
        state.preset_name = "with \"quotes\" \x01 and \xC3\xA9";
        state.scale_text = "! x.scl\n\n2\n3/2\n2/1\n";
        state.keyboard_text = n % 2 == 0 ? "" : "\t\\";
        state.tun_text = n % 5 == 0 ? "[Tuning]" : "";
        state.move_frets = n % 3 == 0;
        state.midi_map_text = "{}";
        state.guitar_channel = n % 17;
        state.quality = static_cast<Quality>(n % 3);
        state.offline_quality = static_cast<Quality>((n + 1) % 3);
        const auto read = read_plugin_state(write_plugin_state(state));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read.value(), state);
        EXPECT_EQ(write_plugin_state(read.value()), write_plugin_state(state));
    }
}

/// What version 1 first held: a session of then opens for ever.
TEST(PluginState, AFrozenTextOfVersionOneIsRead) {
    const auto read = read_plugin_state(
        R"({"schema": "jawari.plugin/1", "quality": "studio", "offline_quality": "reference",
            "guitar_channel": 3, "parameters": {"volume": 0.5, "pan": -0.25, "action": 0.001},
            "tuning": {"scale": "S", "keyboard_map": "K", "move_frets": true}, "midi_map": "M",
            "preset": {"name": "N", "text": "T"}})");
    ASSERT_TRUE(read) << read.error().message;
    PluginState expected;
    expected.preset_name = "N";
    expected.preset_text = "T";
    expected.scale_text = "S";
    expected.keyboard_text = "K";
    expected.move_frets = true;
    expected.midi_map_text = "M";
    expected.guitar_channel = 3;
    expected.quality = Quality::Studio;
    expected.offline_quality = Quality::Reference;
    expected.parameters[0] = 0.5;
    expected.parameters[2] = -0.25;
    expected.parameters[19] = 0.001;
    EXPECT_EQ(read.value(), expected);
}

TEST(PluginState, WhatAnOlderStateLacksIsAsInANewInstance) {
    const auto read = read_plugin_state(R"({"schema": "jawari.plugin/1", "preset": {"text": "T"}})");
    ASSERT_TRUE(read) << read.error().message;
    PluginState expected;
    expected.preset_text = "T";
    EXPECT_EQ(read.value(), expected);
}

TEST(PluginState, EveryProblemNamesItsPlace) {
    ordered_json state = written();
    state["schema"] = "jawari.plugin/2";
    EXPECT_EQ(problem(state), "plugin state: schema: \"jawari.plugin/2\" (allowed: \"jawari.plugin/1\")");
    state = written();
    state["parameters"]["volume"] = 1.5;
    EXPECT_EQ(problem(state).substr(0, 36), "plugin state: parameters.volume: 1.5");
    state = written();
    state["parameters"]["loudness"] = 1;
    EXPECT_NE(problem(state).find("parameters.loudness"), std::string::npos);
    state = written();
    state["quality"] = "best";
    EXPECT_NE(problem(state).find("quality: \"best\""), std::string::npos);
    state = written();
    state["guitar_channel"] = 17;
    EXPECT_NE(problem(state).find("guitar_channel: 17"), std::string::npos);
    state = written();
    state.erase("preset");
    EXPECT_NE(problem(state).find("preset"), std::string::npos);
    state = written();
    state["extra"] = 1;
    EXPECT_NE(problem(state).find("extra"), std::string::npos);
}

TEST(PluginState, GarbageIsRefused) {
    for (const std::string& text : {std::string(), std::string("{}"), std::string("null"), std::string("[1]"),
                                    std::string("\0\0\0\0", 4), std::string("{\"schema\": 1}"),
                                    std::string(longest_state_bytes + 1, ' ')})
        EXPECT_FALSE(read_plugin_state(text)) << text.substr(0, 20);
    const std::string whole = write_plugin_state(new_plugin_state());
    for (std::size_t length = 0; length + 2 < whole.size(); length += 997)
        EXPECT_FALSE(read_plugin_state(whole.substr(0, length))) << length;
}

TEST(CompileState, TextsInsideAreReadAndNamedWhenTheyAreWrong) {
    PluginState state = new_plugin_state();
    state.preset_text = "{\"schema\": \"jawari.preset/2\"}";
    const auto bad_preset = compile_state(state, Quality::Live, 48000);
    ASSERT_FALSE(bad_preset);
    EXPECT_EQ(bad_preset.error().message.substr(0, 13), "guitar-steel:");
    state = new_plugin_state();
    state.scale_text = "x";
    const auto bad_scale = compile_state(state, Quality::Live, 48000);
    ASSERT_FALSE(bad_scale);
    EXPECT_EQ(bad_scale.error().message.substr(0, 6), "scale:");
    state = new_plugin_state();
    state.midi_map_text = "[]";
    const auto bad_map = compile_state(state, Quality::Live, 48000);
    ASSERT_FALSE(bad_map);
    EXPECT_EQ(bad_map.error().message.substr(0, 9), "MIDI map:");
}

TEST(AsUtf8, KeepsUtf8AndTakesOtherBytesForLatin1) {
    EXPECT_EQ(as_utf8("plain"), "plain");
    EXPECT_EQ(as_utf8("caf\xC3\xA9"), "caf\xC3\xA9");
    EXPECT_EQ(as_utf8("caf\xE9 2/1"), "caf\xC3\xA9 2/1");
    EXPECT_EQ(as_utf8("\xC0\x80"), "\xC3\x80\xC2\x80");
}

}  // namespace
}  // namespace jawari::host
