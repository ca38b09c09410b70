// Notes, their expressions, and the buffers of blocks.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin/vst3/extensions.h"
#include "support/clap_host.h"
#include "support/vst3_questions.h"

namespace jawari::host {
namespace {

using test::loudest;
using test::ready;
using test::small_state;
using test::Vst3Instance;

/// Expressions of one note by its id, as CLAP has them.
TEST(Vst3Notes, ExpressionsAndTuningsAreThoseOfClap) {
    Vst3Instance one;
    test::ClapInstance other;
    ready({&one});
    ASSERT_TRUE(other.load(small_state()));
    ASSERT_TRUE(other.activate());
    one.events.note_on(0, 33, 1, 7);
    other.events.note_on(0, 33, 1, 7);
    one.events.expression(500, vst3::tuning_type, 7, 0.5 + 1.5 / 240);
    other.events.expression(500, CLAP_NOTE_EXPRESSION_TUNING, 33, 240 * (0.5 + 1.5 / 240 - 0.5), 7);
    one.events.expression(600, vst3::brightness_type, 7, 0.75);
    other.events.expression(600, CLAP_NOTE_EXPRESSION_BRIGHTNESS, 33, 0.75, 7);
    one.events.poly_pressure(700, 33, 0.5, 7);
    other.events.expression(700, CLAP_NOTE_EXPRESSION_PRESSURE, 33, 0.5, 7);
    one.events.expression(800, vst3::volume_type, 7, 0.125);
    other.events.expression(800, CLAP_NOTE_EXPRESSION_VOLUME, 33, 0.5, 7);
    one.events.expression(900, vst3::pan_type, 7, 0.75);
    other.events.expression(900, CLAP_NOTE_EXPRESSION_PAN, 33, 0.75, 7);
    one.events.note_on(2000, 45, 1, 8);
    other.events.note_on(2000, 45, 1, 8);
    one.process(8000);
    other.process(8000);
    EXPECT_EQ(one.left, other.left);
    EXPECT_EQ(one.right, other.right);
    EXPECT_GT(loudest(one.left), 1e-3);
}

/// In cents, as a note's own tuning in semitones after it.
TEST(Vst3Notes, ANoteMayComeWithItsTuning) {
    Vst3Instance one, other, plain;
    ready({&one, &other, &plain});
    one.events.add(0, V3_EVENT_NOTE_ON).note_on = {0, 33, 50.0F, 1.0F, 0, 9};
    other.events.note_on(0, 33, 1, 9);
    other.events.expression(0, vst3::tuning_type, 9, 0.5 + 0.5 / 240);
    plain.events.note_on(0, 33, 1, 9);
    for (Vst3Instance* each : {&one, &other, &plain}) each->process(6000);
    double largest = 0;
    for (std::size_t n = 0; n < 6000; ++n)
        largest = std::max<double>(largest, std::abs(one.left[n] - other.left[n]));
    EXPECT_LT(largest, 1e-9 * loudest(other.left));  // 0.5/240 is rounded
    EXPECT_NE(one.left, plain.left);
}

TEST(Vst3Notes, ExpressionsAreDescribed) {
    Vst3Instance one;
    v3_funknown** expressions = nullptr;
    ASSERT_EQ(v3_cpp_obj_query_interface(one.component, vst3::note_expression_iid, &expressions), V3_OK);
    const auto& table = **reinterpret_cast<vst3::NoteExpressionTable**>(expressions);
    ASSERT_EQ(table.get_count(expressions, 0, 0), 4);
    vst3::NoteExpressionInfo info{};
    ASSERT_EQ(table.get_info(expressions, 0, 0, 0, &info), V3_OK);
    EXPECT_EQ(info.type_id, vst3::tuning_type);
    EXPECT_EQ(info.default_value, 0.5);
    std::array<std::int16_t, 128> text{};
    ASSERT_EQ(table.get_text(expressions, 0, 0, vst3::tuning_type, 0.5 + 2 / 240.0, text.data()), V3_OK);
    EXPECT_EQ(vst3::read_text(text.data()), "2.00");
    double value = 0;
    ASSERT_EQ(table.get_value(expressions, 0, 0, vst3::tuning_type, text.data(), &value), V3_OK);
    EXPECT_NEAR(value, 0.5 + 2 / 240.0, 1e-12);
    ASSERT_EQ(table.get_info(expressions, 0, 0, 2, &info), V3_OK);
    EXPECT_EQ(info.default_value, 0.25);  // 0 dB
    EXPECT_NE(table.get_info(expressions, 0, 0, 4, &info), V3_OK);
    v3_cpp_obj_unref(expressions);
}

TEST(Vst3Notes, SilenceIsFlaggedWhereNothingMoves) {
    Vst3Instance one;
    ready({&one});
    one.process(100);
    EXPECT_EQ(one.silence, 3U);
    for (const float sample : one.left) EXPECT_EQ(sample, 0);
    one.events.note_on(50, 40, 1);
    one.process(100);
    EXPECT_EQ(one.silence, 0U);
}

TEST(Vst3Notes, DoublesAreTheFloatsBeforeRounding) {
    Vst3Instance one, other;
    ready({&one, &other});
    for (Vst3Instance* each : {&one, &other}) each->events.note_on(0, 33, 1);
    one.process(1500);
    std::vector<double> left(1500), right(1500);
    std::array<double*, 2> places{left.data(), right.data()};
    v3_audio_bus_buffers bus{};
    bus.num_channels = 2;
    bus.channel_buffers_64 = places.data();
    v3_process_data data{};
    data.symbolic_sample_size = V3_SAMPLE_64;
    data.nframes = 1500;
    data.num_output_buses = 1;
    data.outputs = &bus;
    data.input_events = other.events.events();
    ASSERT_EQ(v3_cpp_obj(other.processor)->process(other.processor, &data), V3_OK);
    for (std::size_t n = 0; n < 1500; ++n) ASSERT_EQ(one.left[n], static_cast<float>(left[n]));
}

/// Buses and channels that a host leaves out.
TEST(Vst3Notes, BlocksWithoutBuffersPlayOn) {
    Vst3Instance one, whole;
    ready({&one, &whole});
    for (Vst3Instance* each : {&one, &whole}) each->events.note_on(0, 33, 1);
    v3_process_data data{};
    data.nframes = 1000;
    data.input_events = one.events.events();
    ASSERT_EQ(v3_cpp_obj(one.processor)->process(one.processor, &data), V3_OK);
    one.events.clear();
    one.process(1000);
    whole.process(1000);
    whole.left.clear();
    whole.process(1000);
    EXPECT_EQ(one.left, whole.left);
}

/// Offline the preset's studio section is in force, as in a host that renders offline through CLAP.
TEST(Vst3Notes, OfflineTheStudioSectionIsInForce) {
    auto preset = nlohmann::ordered_json::parse(test::small_preset_text("bass-fretted"));
    preset["studio"] = {{"contact_rate_min_hz", 192000}, {"mode_limit_hz", 6000}};
    const std::string state = nlohmann::ordered_json{{"schema", "jawari.plugin/1"},
                                                     {"preset", {{"name", "small"}, {"text", preset.dump()}}}}
                                  .dump();
    std::array<std::vector<float>, 3> sounds;
    for (const std::size_t n : {0U, 1U}) {
        Vst3Instance one;
        ASSERT_TRUE(one.load(state));
        ASSERT_TRUE(one.activate(48000, 256, n == 1));
        one.events.note_on(0, 33, 1);
        one.render(3000);
        sounds[n] = one.left;
    }
    test::ClapInstance other;
    ASSERT_TRUE(other.load(state));
    ASSERT_TRUE(other.get<clap::PluginRender>(clap::render_id).set(other.plugin, clap::render_offline));
    ASSERT_TRUE(other.activate());
    other.events.note_on(0, 33, 1);
    other.render(3000);
    EXPECT_NE(sounds[0], sounds[1]);
    EXPECT_EQ(sounds[1], other.left);
}

}  // namespace
}  // namespace jawari::host
