// What LV2 has beside the other formats: ports, a state of one property, freewheeling, work for another
// thread.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin/lv2/turtle.h"
#include "support/clap_host.h"
#include "support/lv2_host.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using test::Lv2Instance;
using test::small_state;

double loudest_sample(const std::vector<float>& sound) {
    double most = 0;
    for (const float sample : sound) most = std::max<double>(most, std::abs(sample));
    return most;
}

TEST(Lv2, WithoutNumbersForNamesThereIsNoInstance) {
    const LV2_Feature* const none = nullptr;
    EXPECT_EQ(test::lv2_plugin().instantiate(&test::lv2_plugin(), 48000, "", &none), nullptr);
    EXPECT_EQ(test::lv2_plugin().instantiate(&test::lv2_plugin(), 48000, "", nullptr), nullptr);
    EXPECT_STREQ(test::lv2_plugin().URI, "urn:jawari:instrument");
    EXPECT_EQ(test::lv2_plugin().extension_data("urn:something:else"), nullptr);
}

TEST(Lv2, RatesThatItCannotHaveAreLoggedAndSilent) {
    Lv2Instance one(4000);
    EXPECT_FALSE(one.activate(4000));
    EXPECT_NE(one.log.find("sample rate"), std::string::npos);
    one.process(100);
    EXPECT_EQ(one.left, std::vector<float>(100, 0.0F));
}

TEST(Lv2, StatesOfAnotherTypeAreRefusedAndMissingOnesChangeNothing) {
    Lv2Instance one;
    ASSERT_TRUE(one.load(small_state()));
    const std::string saved = one.save();
    EXPECT_EQ(one.load_as(small_state("sitar"), LV2_ATOM__Int), LV2_STATE_ERR_BAD_TYPE);
    EXPECT_EQ(one.save(), saved);
    const auto& state =
        *static_cast<const LV2_State_Interface*>(test::lv2_plugin().extension_data(LV2_STATE__interface));
    const auto nothing = [](LV2_State_Handle, std::uint32_t, std::size_t*, std::uint32_t*,
                            std::uint32_t*) -> const void* { return nullptr; };
    EXPECT_EQ(state.restore(one.handle, nothing, nullptr, 0, nullptr), LV2_STATE_SUCCESS);
    EXPECT_EQ(one.save(), saved);
    EXPECT_FALSE(one.load("{}"));
    EXPECT_NE(one.log.find("jawari: "), std::string::npos);
}

/// A value has more digits in a state than in a port: the port alone does not round it.
TEST(Lv2, PortsThatSayTheSameLeaveAStateAsItIs) {
    Lv2Instance one;
    auto state = nlohmann::ordered_json::parse(small_state());
    state["parameters"] = {{"palm_mute", 0.1}};
    ASSERT_TRUE(one.load(state.dump()));
    ASSERT_TRUE(one.activate());
    one.events.parameter(0, 6, 0.1);
    one.process(10);
    EXPECT_EQ(nlohmann::json::parse(one.save())["parameters"]["palm_mute"], 0.1);
    one.events.parameter(0, 6, 0.7);
    one.process(10);
    EXPECT_EQ(nlohmann::json::parse(one.save())["parameters"]["palm_mute"], static_cast<double>(0.7F));
}

TEST(Lv2, ValuesOutOfRangeAndNotFiniteAreKeptInside) {
    Lv2Instance one;
    ASSERT_TRUE(one.load(small_state()));
    ASSERT_TRUE(one.activate());
    one.events.parameter(0, 6, 1e30);
    one.events.parameter(0, 2, std::nan(""));
    one.events.midi(0, 0x90, 33, 127);
    one.render(3000);
    const auto saved = nlohmann::json::parse(one.save());
    EXPECT_EQ(saved["parameters"]["palm_mute"], 1);
    EXPECT_EQ(saved["parameters"]["pan"], 0);
    for (const float sample : one.left) ASSERT_TRUE(std::isfinite(sample));
}

TEST(Lv2, UnconnectedPortsAndForeignEventsAreLeftAlone) {
    Lv2Instance one, plain;
    for (Lv2Instance* each : {&one, &plain}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
    }
    one.events.add(0, LV2_ATOM__Int, {0x90, 33, 127});
    one.events.add(0, LV2_MIDI__MidiEvent, {});
    one.events.add(0, LV2_MIDI__MidiEvent, {0xF0, 1, 2, 3, 4, 5, 6, 0xF7});
    one.events.add(0, LV2_MIDI__MidiEvent, {0x33, 33, 127});
    for (Lv2Instance* each : {&one, &plain}) {
        each->events.midi(5, 0x90, 40, 127);
        each->process(2000);
    }
    EXPECT_EQ(one.left, plain.left);
    EXPECT_GT(loudest_sample(one.left), 1e-3);
    for (std::uint32_t port = 0; port < lv2::port_count + 3; ++port)
        test::lv2_plugin().connect_port(one.handle, port, nullptr);
    test::lv2_plugin().run(one.handle, 512);
}

std::string state_with_studio() {
    auto preset = nlohmann::ordered_json::parse(test::small_preset_text("bass-fretted"));
    preset["studio"] = {{"contact_rate_min_hz", 192000}, {"mode_limit_hz", 6000}};
    return nlohmann::ordered_json{{"schema", "jawari.plugin/1"},
                                  {"preset", {{"name", "small"}, {"text", preset.dump()}}}}
        .dump();
}

/// From the first block on, as in a host that renders offline through CLAP; the way back is the worker's.
TEST(Lv2, WhileItFreewheelsTheStudioSectionIsInForce) {
    test::ClapInstance other;
    ASSERT_TRUE(other.load(state_with_studio()));
    ASSERT_TRUE(other.get<clap::PluginRender>(clap::render_id).set(other.plugin, clap::render_offline));
    ASSERT_TRUE(other.activate());
    other.events.midi(0, 0x90, 33, 100);
    other.render(3000);
    for (const bool with_worker : {true, false}) {
        Lv2Instance one(48000, with_worker), live(48000, with_worker);
        for (Lv2Instance* each : {&one, &live}) {
            ASSERT_TRUE(each->load(state_with_studio()));
            ASSERT_TRUE(each->activate());
            each->freewheel = each == &one ? 1 : 0;
            each->events.midi(0, 0x90, 33, 100);
            each->render(3000);
        }
        EXPECT_EQ(one.left, other.left);
        EXPECT_NE(live.left, other.left);
        one.freewheel = 0;
        one.render(48000);
        EXPECT_EQ(one.worked > 0, with_worker);
        one.deactivate();
        ASSERT_TRUE(one.activate());
        one.left.clear();
        one.events.midi(0, 0x90, 33, 100);
        one.render(3000);
        EXPECT_EQ(one.left, live.left);
    }
}

/// What a new preset has replaced is freed by the host's worker, not kept until the end.
TEST(Lv2, TheWorkerCollects) {
    Lv2Instance one;
    ASSERT_TRUE(one.load(small_state()));
    ASSERT_TRUE(one.activate());
    one.process(64);
    ASSERT_TRUE(one.load(small_state("guitar-steel")));
    one.render(640, 64);
    EXPECT_GT(one.worked, 0);
}

// ------------------------------------------------------------------------------------------ texts

TEST(Lv2Turtle, SymbolsAndIndicesAreFrozen) {
    const std::string text = lv2::plugin_turtle();
    std::size_t at = 0;
    for (const char* symbol :
         {"left", "right", "string_1", "string_16", "events", "freewheel", "volume", "palm_mute", "action"}) {
        const std::size_t found = text.find("lv2:symbol \"" + std::string(symbol) + "\"", at);
        ASSERT_NE(found, std::string::npos) << symbol;
        at = found;
    }
    EXPECT_NE(text.find("lv2:index 18 ;\n        lv2:symbol \"events\""), std::string::npos);
    EXPECT_NE(text.find("lv2:index 19 ;\n        lv2:symbol \"freewheel\""), std::string::npos);
    EXPECT_NE(text.find("lv2:index 26 ;\n        lv2:symbol \"palm_mute\""), std::string::npos);
    EXPECT_NE(text.find("lv2:index 39 ;\n        lv2:symbol \"action\""), std::string::npos);
    EXPECT_NE(text.find("lv2:index 40 ;\n        lv2:symbol \"notify\""), std::string::npos);
    EXPECT_EQ(text.find("lv2:index 41"), std::string::npos);
}

/// RFC 4648, by bits.
std::string decoded(std::string_view text) {
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<bool> bits;
    for (const char letter : text)
        for (int bit = 5; letter != '=' && bit >= 0; --bit) bits.push_back(digits.find(letter) >> bit & 1U);
    std::string bytes;
    for (std::size_t i = 0; i + 8 <= bits.size(); i += 8) {
        unsigned byte = 0;
        for (std::size_t bit = 0; bit < 8; ++bit) byte = 2 * byte + (bits[i + bit] ? 1 : 0);
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

/// Each preset's state is one that the plugin takes.
TEST(Lv2Turtle, StatesOfThePresetsLoad) {
    const std::string text = lv2::presets_turtle();
    const std::string key = "<urn:jawari:instrument#state> \"";
    int loaded = 0;
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at)) {
        at += key.size();
        const auto read = read_plugin_state(decoded(text.substr(at, text.find('"', at) - at)));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(find_builtin("instruments", read.value().preset_name)->text, read.value().preset_text);
        ++loaded;
    }
    EXPECT_EQ(loaded, static_cast<int>(builtin_files("instruments").size()));
}

/// What a person has written into a Turtle file.
TEST(Lv2, AStateMayBeAString) {
    Lv2Instance one, other;
    EXPECT_EQ(one.load_as(small_state("sitar") + std::string(1, '\0'), LV2_ATOM__String), LV2_STATE_SUCCESS);
    ASSERT_TRUE(other.load(small_state("sitar")));
    EXPECT_EQ(one.save(), other.save());
}

#ifndef JAWARI_SANITIZED

/// Other people's readers of bundles.
TEST(Lv2Bundle, LvValidateFindsNothing) {
    if (test::run({"/bin/sh", "-c", "command -v lv2_validate"}).exit_code != 0)
        GTEST_SKIP() << "no lv2_validate (Debian packages lv2-dev and sordi)";
    const auto ran = test::run({"/bin/sh", "-c", "lv2_validate \"$(dirname " JAWARI_LV2 ")\"/*.ttl"});
    const std::string said = ran.out + ran.err;
    EXPECT_NE(said.find("Found 0 errors"), std::string::npos) << said.substr(0, 2000);
}

TEST(Lv2Bundle, LilvSeesPortsAndPresets) {
    if (test::run({"/bin/sh", "-c", "command -v lv2info"}).exit_code != 0)
        GTEST_SKIP() << "no lv2info (Debian package lilv-utils)";
    const auto ran = test::run({"/bin/sh", "-c",
                                "LV2_PATH=\"$(dirname \"$(dirname " JAWARI_LV2
                                ")\")\":/usr/lib/lv2 lv2info urn:jawari:instrument"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    for (const char* line :
         {"Class:             Instrument Plugin", "Port 40:", "Steel-string guitar", "Sitar",
          "Symbol:      palm_mute", "Designation: http://lv2plug.in/ns/lv2core#freeWheeling"})
        EXPECT_NE(ran.out.find(line), std::string::npos) << line;
}

#endif

}  // namespace
}  // namespace jawari::host
