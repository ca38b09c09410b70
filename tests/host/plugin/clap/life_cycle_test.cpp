// An instance from its making to its end, where CLAP has more than the other formats (plugin/formats).
#include <gtest/gtest.h>

#include <cmath>

#include "support/clap_host.h"

namespace jawari::host {
namespace {

using test::ClapInstance;
using test::small_state;

double loudest(const std::vector<float>& sound, std::size_t from = 0) {
    double most = 0;
    for (std::size_t n = from; n < sound.size(); ++n) most = std::max<double>(most, std::abs(sound[n]));
    return most;
}

TEST(Clap, TheFileOffersOnePluginByItsExactId) {
    const clap_plugin_factory_t& factory = test::clap_factory();
    ASSERT_EQ(factory.get_plugin_count(&factory), 1U);
    EXPECT_STREQ(factory.get_plugin_descriptor(&factory, 0)->id, "jawari.jawari");
    EXPECT_EQ(factory.get_plugin_descriptor(&factory, 1), nullptr);
    const clap_host_t host{};
    for (const char* id : {"jawari.jawari2", "jawari.jawar", "", "JAWARI.JAWARI"})
        EXPECT_EQ(factory.create_plugin(&factory, &host, id), nullptr) << id;
    EXPECT_EQ(test::clap_entry_of_file().get_factory("clap.plugin-factory/9"), nullptr);
}

TEST(Clap, LatencyAndTailCanBeAskedForBeforeActivation) {
    ClapInstance one;
    EXPECT_EQ(one.get<clap_plugin_latency_t>(CLAP_EXT_LATENCY).get(one.plugin), 0U);
    EXPECT_EQ(one.get<clap::PluginTail>(clap::tail_id).get(one.plugin), 60U * 48000U);
    ASSERT_TRUE(one.load(small_state()));
    ASSERT_TRUE(one.activate(96000));
    EXPECT_EQ(one.get<clap::PluginTail>(clap::tail_id).get(one.plugin), 60U * 96000U);
}

TEST(Clap, PortsAreStereoAndSingleStrings) {
    ClapInstance one;
    const auto& ports = one.get<clap_plugin_audio_ports_t>(CLAP_EXT_AUDIO_PORTS);
    EXPECT_EQ(ports.count(one.plugin, true), 0U);
    ASSERT_EQ(ports.count(one.plugin, false), 2U);
    clap_audio_port_info_t main{}, strings{};
    ASSERT_TRUE(ports.get(one.plugin, 0, false, &main));
    ASSERT_TRUE(ports.get(one.plugin, 1, false, &strings));
    EXPECT_FALSE(ports.get(one.plugin, 2, false, &main));
    EXPECT_EQ(main.channel_count, 2U);
    EXPECT_TRUE(main.flags & CLAP_AUDIO_PORT_IS_MAIN);
    EXPECT_EQ(strings.channel_count, 16U);
    EXPECT_FALSE(strings.flags & CLAP_AUDIO_PORT_IS_MAIN);
    const auto& notes = one.get<clap_plugin_note_ports_t>(CLAP_EXT_NOTE_PORTS);
    clap_note_port_info_t port{};
    ASSERT_EQ(notes.count(one.plugin, true), 1U);
    EXPECT_EQ(notes.count(one.plugin, false), 0U);
    ASSERT_TRUE(notes.get(one.plugin, 0, true, &port));
    EXPECT_EQ(port.supported_dialects,
              std::uint32_t{CLAP_NOTE_DIALECT_CLAP | CLAP_NOTE_DIALECT_MIDI | CLAP_NOTE_DIALECT_MIDI_MPE});
}

TEST(Clap, RatesThatItCannotHaveAreRefused) {
    ClapInstance one;
    for (const double rate : {0.0, -1.0, 7999.0, 384001.0, std::nan("")}) {
        EXPECT_FALSE(one.activate(rate)) << rate;
        EXPECT_NE(one.log.find("sample rate"), std::string::npos);
    }
    EXPECT_TRUE(one.load(small_state()));
    EXPECT_TRUE(one.activate(8000));
}

/// Blocks of other sizes at each call, of no frame, and larger than announced: the sound is the same.
TEST(Clap, TheSoundDoesNotDependOnBlocks) {
    std::vector<std::vector<float>> sounds;
    for (const std::vector<std::uint32_t>& sizes :
         {std::vector<std::uint32_t>{6000}, {1}, {0, 64, 0, 0, 512}, {7, 1999, 1}, {256}, {300, 0, 900}}) {
        ClapInstance one;
        ASSERT_TRUE(one.load(small_state()));
        ASSERT_TRUE(one.activate(48000, 64));
        const auto send = [&](std::size_t begin, std::size_t end) {
            const auto at = [&](std::size_t frame, auto add) {
                if (frame >= begin && frame < end) add(static_cast<std::uint32_t>(frame - begin));
            };
            at(10, [&](auto time) { one.events.note_on(time, 33, 0.9, 1); });
            at(1003, [&](auto time) { one.events.parameter(time, 6, 0.5); });
            at(1003, [&](auto time) { one.events.note_on(time, 45, 0.6, 2); });
            at(2222,
               [&](auto time) { one.events.expression(time, CLAP_NOTE_EXPRESSION_TUNING, 45, 0.37, 2); });
            at(3001, [&](auto time) { one.events.midi(time, 0xB0, 10, 20); });
            at(4000, [&](auto time) { one.events.note_off(time, 33, 1); });
        };
        std::size_t done = 0;
        for (std::size_t n = 0; done < 6000; ++n) {
            const auto frames =
                static_cast<std::uint32_t>(std::min<std::size_t>(sizes[n % sizes.size()], 6000 - done));
            send(done, done + frames);
            one.process(frames);
            done += frames;
        }
        sounds.push_back(one.left);
    }
    for (const auto& sound : sounds) EXPECT_EQ(sound, sounds.front());
    EXPECT_GT(loudest(sounds.front(), 4000), 1e-3);
}

TEST(Clap, EventsOfABlockWithoutFramesCountForTheNextOne) {
    ClapInstance in_no_frame, in_first;
    for (ClapInstance* each : {&in_no_frame, &in_first}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 40, 0.8);
    }
    in_no_frame.process(0);
    in_no_frame.process(1000);
    in_first.process(1000);
    EXPECT_EQ(in_no_frame.left, in_first.left);
    EXPECT_GT(loudest(in_first.left), 1e-3);
}

TEST(Clap, MoreEventsThanItHasRoomForAreAllTaken) {
    ClapInstance crowded, plain;
    for (ClapInstance* each : {&crowded, &plain}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
    }
    for (int n = 0; n < 40000; ++n) crowded.events.parameter(100, 1, (n % 100) / 100.0);
    for (auto* each : {&crowded, &plain}) {
        each->events.parameter(100, 1, 0.75);
        each->events.note_on(200, 40, 0.8);
        each->process(3000);
        EXPECT_EQ(each->value(1), 0.75);
    }
    EXPECT_EQ(crowded.left, plain.left);
    EXPECT_GT(loudest(plain.left), 1e-3);
}

TEST(Clap, EventsThatAreNotItsOwnAreLeftAlone) {
    ClapInstance odd, plain;
    for (ClapInstance* each : {&odd, &plain}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
    }
    clap_event_param_value_t value{};
    value.note_id = value.port_index = value.channel = value.key = -1;
    value.value = 0.1;
    odd.events.add(value, CLAP_EVENT_PARAM_VALUE, 0, 7);                             // of another namespace
    odd.events.add(value, CLAP_EVENT_PARAM_VALUE, 0, CLAP_CORE_EVENT_SPACE_ID, 16);  // too short
    value.param_id = 20;
    odd.events.add(value, CLAP_EVENT_PARAM_VALUE, 0);  // unknown
    value.param_id = 0;
    value.key = 60;
    odd.events.add(value, CLAP_EVENT_PARAM_VALUE, 0);  // for a single note
    odd.events.add(value, 999, 0);
    odd.events.note(CLAP_EVENT_NOTE_ON, 0, 300, 1);
    odd.events.note(CLAP_EVENT_NOTE_ON, 0, 40, 1, -1, 16);
    odd.events.note(CLAP_EVENT_NOTE_ON, 0, -1, 1);
    odd.events.midi(0, 0xF8, 1, 2);
    odd.events.midi(0, 0x90, 200, 255);
    for (auto* each : {&odd, &plain}) {
        each->events.note_on(50, 40, 0.8);
        each->process(2000);
        EXPECT_EQ(each->value(0), 1.0);
    }
    EXPECT_EQ(odd.left, plain.left);
}

TEST(Clap, ResetGivesTheSoundOfANewInstance) {
    ClapInstance one, fresh;
    for (ClapInstance* each : {&one, &fresh}) {
        ASSERT_TRUE(each->load(small_state()));
        each->events.parameter(0, 6, 0.4);
        each->params().flush(each->plugin, each->events.list(), nullptr);
        each->events.clear();
        ASSERT_TRUE(each->activate());
    }
    one.events.midi(0, 0xB0, 64, 127);
    one.events.midi(0, 0xE0, 0, 100);
    one.events.midi(0, 0xB0, 10, 100);
    one.events.note_on(3, 33, 1, 5);
    one.render(3000);
    one.plugin->reset(one.plugin);
    one.left.clear();
    for (ClapInstance* each : {&one, &fresh}) {
        each->render(500);
        EXPECT_EQ(loudest(each->left), 0);
        EXPECT_EQ(each->value(6), 0.4);
        each->events.note_on(3, 40, 0.7);
        each->render(3000);
    }
    EXPECT_EQ(one.left, fresh.left);
    EXPECT_GT(loudest(one.left), 1e-3);
}

TEST(Clap, AnIdleInstanceSleepsAndWakesWhereTheClockIs) {
    ClapInstance sleeper, awake;
    for (ClapInstance* each : {&sleeper, &awake}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.parameter(0, 13, 1.0);  // vibrato: its phase tells the time
        EXPECT_EQ(each->process(100, 0), CLAP_PROCESS_SLEEP);
    }
    for (int n = 0; n < 50; ++n) awake.process(77, 100 + 77 * n);
    const std::int64_t now = 100 + 77 * 50;
    sleeper.left.clear();
    awake.left.clear();
    for (ClapInstance* each : {&sleeper, &awake}) {
        each->events.note_on(0, 40, 0.8);
        EXPECT_EQ(each->process(4000, now), CLAP_PROCESS_CONTINUE);
    }
    EXPECT_EQ(sleeper.left, awake.left);
    EXPECT_GT(loudest(awake.left), 1e-3);
}

TEST(Clap, DoublesAreTheFloatsBeforeRounding) {
    ClapInstance one, other;
    for (ClapInstance* each : {&one, &other}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 33, 0.8);
    }
    one.process(1500);
    std::vector<double> left(1500), right(1500);
    std::array<double*, 2> places{left.data(), right.data()};
    clap_audio_buffer_t buffer{nullptr, places.data(), 2, 0, 0};
    clap_process_t block{};
    block.steady_time = -1;
    block.frames_count = 1500;
    block.audio_outputs = &buffer;
    block.audio_outputs_count = 1;
    block.in_events = other.events.list();
    other.plugin->process(other.plugin, &block);
    for (std::size_t n = 0; n < 1500; ++n) ASSERT_EQ(one.left[n], static_cast<float>(left[n]));
    EXPECT_GT(loudest(one.left), 1e-3);
}

}  // namespace
}  // namespace jawari::host
