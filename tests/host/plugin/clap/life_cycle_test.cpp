// An instance from its making to its end, as hosts of all kinds lead it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

#include "base/cpu_clock.h"
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

/// Processor time, of which compiling the preset takes most.
TEST(Clap, AScanTakesAFractionOfAnActivation) {
    test::clap_factory();  // loading the file is the system's affair
    const double begin = thread_cpu_s();
    ClapInstance scanned;
    clap_param_info_t info{};
    for (std::uint32_t i = 0; i < scanned.params().count(scanned.plugin); ++i)
        ASSERT_TRUE(scanned.params().get_info(scanned.plugin, i, &info));
    EXPECT_GT(scanned.save().size(), 1000U);
    const double before_activation = thread_cpu_s();
    ASSERT_TRUE(scanned.activate(48000));
    EXPECT_LT(5 * (before_activation - begin), thread_cpu_s() - before_activation);
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

class ClapRates : public testing::TestWithParam<double> {};

/// The first partial of the open A string is at 55 Hz whatever the rate: counted by the sign of its sound.
TEST_P(ClapRates, ANoteHasItsPitch) {
    const double rate_hz = GetParam();
    ClapInstance one;
    ASSERT_TRUE(one.load(small_state()));
    ASSERT_TRUE(one.activate(rate_hz));
    one.events.note_on(0, 33, 0.5);
    one.render(static_cast<std::size_t>(rate_hz), 441);
    // Sum over one second against sine and cosine at 55 Hz and a semitone beside it.
    const auto strength = [&](double hz) {
        double real = 0, imaginary = 0;
        for (std::size_t n = 0; n < one.left.size(); ++n) {
            const double turn = 6.283185307179586 * hz * static_cast<double>(n) / rate_hz;
            real += static_cast<double>(one.left[n]) * std::cos(turn);
            imaginary += static_cast<double>(one.left[n]) * std::sin(turn);
        }
        return std::hypot(real, imaginary) / rate_hz;
    };
    EXPECT_GT(strength(55), 4 * strength(58.27));
    EXPECT_GT(strength(55), 4 * strength(51.91));
    EXPECT_GT(loudest(one.left), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Hz, ClapRates, testing::Values(8000.0, 44100.0, 44123.45, 96000.0, 192000.0),
                         [](const auto& rate) { return std::to_string(static_cast<int>(rate.param)); });

TEST(Clap, RatesThatItCannotHaveAreRefused) {
    ClapInstance one;
    for (const double rate : {0.0, -1.0, 7999.0, 384001.0, std::nan("")}) {
        EXPECT_FALSE(one.activate(rate)) << rate;
        EXPECT_NE(one.log.find("sample rate"), std::string::npos);
    }
    EXPECT_TRUE(one.load(small_state()));
    EXPECT_TRUE(one.activate(8000));
}

TEST(Clap, ActivatedAgainAtAnotherRateItSoundsAsANewOneThere) {
    ClapInstance moved, fresh;
    for (ClapInstance* each : {&moved, &fresh}) ASSERT_TRUE(each->load(small_state()));
    ASSERT_TRUE(moved.activate(44100));
    moved.events.note_on(3, 40, 0.8);
    moved.render(2000);
    moved.deactivate();
    moved.left.clear();
    ASSERT_TRUE(moved.activate(88200));
    ASSERT_TRUE(fresh.activate(88200));
    for (ClapInstance* each : {&moved, &fresh}) {
        each->events.note_on(5, 33, 0.7);
        each->render(4000);
    }
    EXPECT_EQ(moved.left, fresh.left);
    EXPECT_GT(loudest(fresh.left), 1e-3);
}

TEST(Clap, AHundredCyclesLeaveItAsItWas) {
    ClapInstance one;
    ASSERT_TRUE(one.load(small_state()));
    std::vector<float> first;
    for (int cycle = 0; cycle < 100; ++cycle) {
        ASSERT_TRUE(one.activate(48000)) << cycle;
        one.left.clear();
        one.events.note_on(1, 40, 0.9, cycle);
        one.render(600, 100);
        one.deactivate();
        if (cycle == 0) first = one.left;
        ASSERT_EQ(one.left, first) << cycle;
    }
    EXPECT_GT(loudest(first), 1e-3);
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

TEST(Clap, SingleStringsComeOutByThemselves) {
    ClapInstance one;
    one.strings_wanted = 16;
    ASSERT_TRUE(one.load(small_state()));  // E1, A1, D2, G2
    ASSERT_TRUE(one.activate());
    one.events.note_on(0, 33, 0.8);
    one.render(2000);
    std::set<std::size_t> sounding;
    for (std::size_t s = 0; s < 16; ++s)
        if (loudest(one.strings[s]) > 1e-4) sounding.insert(s);
    EXPECT_EQ(sounding, std::set<std::size_t>{1});
    one.events.note_on(0, 43, 0.8);
    one.render(2000);
    EXPECT_GT(loudest(one.strings[3]), 1e-4);
    EXPECT_EQ(loudest(one.strings[0]), 0);
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

TEST(Clap, TwoInstancesOnTwoThreadsDoNotKnowEachOther) {
    std::vector<float> alone;
    std::array<std::vector<float>, 2> together;
    const auto play = [](std::vector<float>& sound) {
        ClapInstance one;
        ASSERT_TRUE(one.load(small_state()));
        for (int cycle = 0; cycle < 3; ++cycle) {
            ASSERT_TRUE(one.activate());
            one.events.note_on(0, 33, 0.8);
            one.events.note_on(100, 45, 0.8);
            one.render(5000, 64);
            one.deactivate();
        }
        sound = one.left;
    };
    play(alone);
    std::thread first(play, std::ref(together[0])), second(play, std::ref(together[1]));
    first.join();
    second.join();
    for (const auto& sound : together) EXPECT_EQ(sound, alone);
    EXPECT_GT(loudest(alone), 1e-3);
}

}  // namespace
}  // namespace jawari::host
