// What every format of the plugin must do, in a host of each: same claims, same events, same bits.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

#include "support/clap_host.h"
#ifdef JAWARI_LV2
#include "support/lv2_host.h"
#endif
#include "support/vst3_host.h"

namespace jawari::host {
namespace {

using test::small_state;

double loudest_of(const std::vector<float>& sound, std::size_t from = 0) {
    double most = 0;
    for (std::size_t n = from; n < sound.size(); ++n) most = std::max<double>(most, std::abs(sound[n]));
    return most;
}

template <class Instance>
class EveryFormat : public testing::Test {};

#ifdef JAWARI_LV2
using Formats = testing::Types<test::ClapInstance, test::Vst3Instance, test::Lv2Instance>;
#else
using Formats = testing::Types<test::ClapInstance, test::Vst3Instance>;
#endif
TYPED_TEST_SUITE(EveryFormat, Formats, test::FormatNames);

constexpr std::size_t piece_frames = 6000;

/// Notes, a controller, a bend and pressures at their frames. Velocities are MIDI's, so that all formats can
/// say them.
template <class Instance>
void play_piece(Instance& one, const std::vector<std::uint32_t>& blocks) {
    std::size_t done = 0;
    for (std::size_t n = 0; done < piece_frames; ++n) {
        const auto frames =
            static_cast<std::uint32_t>(std::min<std::size_t>(blocks[n % blocks.size()], piece_frames - done));
        const auto at = [&](std::size_t frame, auto add) {
            if (frame >= done && frame < done + frames) add(static_cast<std::uint32_t>(frame - done));
        };
        at(10, [&](auto time) { one.events.midi(time, 0x90, 33, 114); });
        at(1003, [&](auto time) { one.events.note_on(time, 45, 76 / 127.0, 2); });
        at(1500, [&](auto time) { one.events.midi(time, 0xE0, 33, 80); });
        at(2222, [&](auto time) { one.events.midi(time, 0xD0, 60, 0); });
        at(3001, [&](auto time) { one.events.midi(time, 0xB0, 10, 20); });
        at(4000, [&](auto time) { one.events.midi(time, 0x80, 33, 50); });
        one.process(frames);
        done += frames;
    }
}

/// A new instance in which nothing has a value that another format could not have.
template <class Instance>
void prepare(Instance& one) {
    ASSERT_TRUE(one.load(small_state()));
    ASSERT_TRUE(one.activate(48000, 64));
    one.events.parameter(0, 6, 0.25);
}

/// Blocks of another size at each call, of no frame, and larger than announced.
TYPED_TEST(EveryFormat, TheSoundDoesNotDependOnBlocks) {
    std::vector<float> first;
    for (const std::vector<std::uint32_t>& blocks :
         {std::vector<std::uint32_t>{6000}, {1}, {0, 64, 0, 0, 512}, {7, 1999, 1}, {256}, {300, 0, 900}}) {
        TypeParam one;
        prepare(one);
        play_piece(one, blocks);
        if (first.empty()) first = one.left;
        EXPECT_EQ(one.left, first) << blocks.front();
    }
    EXPECT_GT(loudest_of(first, 4000), 1e-3);
}

TYPED_TEST(EveryFormat, SoundsAsTheOthers) {
    TypeParam one;
    test::ClapInstance other;
    prepare(one);
    prepare(other);
    play_piece(one, {256});
    play_piece(other, {100});
    EXPECT_EQ(one.left, other.left);
    EXPECT_EQ(one.right, other.right);
    EXPECT_GT(loudest_of(one.left), 1e-3);
}

/// The first partial of the open A string is at 55 Hz whatever the rate.
TYPED_TEST(EveryFormat, ANoteHasItsPitchAtEveryRate) {
    for (const double rate_hz : {8000.0, 44123.45, 192000.0}) {
        TypeParam one;
        ASSERT_TRUE(one.load(small_state()));
        ASSERT_TRUE(one.activate(rate_hz));
        one.events.note_on(0, 33, 64 / 127.0);
        one.render(static_cast<std::size_t>(rate_hz), 441);
        const auto strength = [&](double hz) {
            double real = 0, imaginary = 0;
            for (std::size_t n = 0; n < one.left.size(); ++n) {
                const double turn = 6.283185307179586 * hz * static_cast<double>(n) / rate_hz;
                real += static_cast<double>(one.left[n]) * std::cos(turn);
                imaginary += static_cast<double>(one.left[n]) * std::sin(turn);
            }
            return std::hypot(real, imaginary) / rate_hz;
        };
        EXPECT_GT(strength(55), 4 * strength(58.27)) << rate_hz;
        EXPECT_GT(strength(55), 4 * strength(51.91)) << rate_hz;
        EXPECT_GT(loudest_of(one.left), 1e-3);
    }
}

TYPED_TEST(EveryFormat, ActivatedAgainAtAnotherRateItSoundsAsANewOneThere) {
    TypeParam moved, fresh;
    for (TypeParam* each : {&moved, &fresh}) ASSERT_TRUE(each->load(small_state()));
    ASSERT_TRUE(moved.activate(44100));
    moved.events.note_on(3, 40, 100 / 127.0);
    moved.render(2000);
    moved.deactivate();
    moved.left.clear();
    ASSERT_TRUE(moved.activate(88200));
    ASSERT_TRUE(fresh.activate(88200));
    for (TypeParam* each : {&moved, &fresh}) {
        each->events.note_on(5, 33, 90 / 127.0);
        each->render(4000);
    }
    EXPECT_EQ(moved.left, fresh.left);
    EXPECT_GT(loudest_of(fresh.left), 1e-3);
}

TYPED_TEST(EveryFormat, AHundredCyclesLeaveItAsItWas) {
    TypeParam one;
    ASSERT_TRUE(one.load(small_state()));
    std::vector<float> first;
    for (int cycle = 0; cycle < 100; ++cycle) {
        ASSERT_TRUE(one.activate(48000)) << cycle;
        one.left.clear();
        one.events.note_on(1, 40, 110 / 127.0, cycle);
        one.render(600, 100);
        one.deactivate();
        if (cycle == 0) first = one.left;
        ASSERT_EQ(one.left, first) << cycle;
    }
    EXPECT_GT(loudest_of(first), 1e-3);
}

TYPED_TEST(EveryFormat, ResetGivesTheSoundOfANewInstance) {
    TypeParam one, fresh;
    for (TypeParam* each : {&one, &fresh}) prepare(*each);
    one.events.midi(0, 0xB0, 64, 127);
    one.events.midi(0, 0xE0, 0, 100);
    one.events.midi(0, 0xB0, 10, 100);
    one.events.note_on(3, 33, 1, 5);
    one.render(3000);
    one.reset();
    one.left.clear();
    for (TypeParam* each : {&one, &fresh}) {
        each->render(500);
        EXPECT_EQ(loudest_of(each->left), 0);
        each->events.note_on(3, 40, 90 / 127.0);
        each->render(3000);
    }
    EXPECT_EQ(one.left, fresh.left);
    EXPECT_GT(loudest_of(one.left), 1e-3);
}

/// A state is the same text after any number of rounds, through streams of any grain, and the sound with it.
TYPED_TEST(EveryFormat, StatesGoRoundExactly) {
    TypeParam one, again;
    prepare(one);
    one.process(0);
    const std::string saved = one.save();
    EXPECT_EQ(one.save(17), saved);
    EXPECT_NE(saved.find("0.25"), std::string::npos);
    ASSERT_TRUE(again.load(saved, 17));
    EXPECT_EQ(again.save(), saved);
    ASSERT_TRUE(again.activate(48000, 64));
    again.events.parameter(0, 6, 0.25);
    play_piece(one, {256});
    play_piece(again, {256});
    EXPECT_EQ(one.left, again.left);
    EXPECT_EQ(again.save(), saved);
}

/// Whole or not at all.
TYPED_TEST(EveryFormat, HostileStatesChangeNeitherStateNorSound) {
    TypeParam one, plain;
    for (TypeParam* each : {&one, &plain}) {
        prepare(*each);
        each->process(0);
    }
    const std::string saved = one.save();
    std::vector<std::string> states{"",
                                    "{",
                                    "null",
                                    "[]",
                                    "{}",
                                    std::string(100000, '['),
                                    "\xff\xfe",
                                    R"({"schema": "jawari.plugin/9", "preset": {"name": "", "text": ""}})",
                                    R"({"schema": "jawari.plugin/1", "preset": {"name": "x", "text": "{}"}})",
                                    saved + "x"};
    for (std::size_t cut = 1; cut < saved.size(); cut += saved.size() / 23)
        states.push_back(saved.substr(0, cut));
    std::size_t played = 0;
    for (const std::string& state : states) {
        EXPECT_FALSE(one.load(state)) << state.substr(0, 60);
        EXPECT_EQ(one.save(), saved);
        for (TypeParam* each : {&one, &plain}) {
            if (played == 0) each->events.note_on(0, 40, 1);
            each->process(100);
        }
        played += 100;
    }
    EXPECT_EQ(one.left, plain.left);
    EXPECT_GT(loudest_of(one.left), 1e-3);
}

/// The old instrument rings out beside the new one: no step in the sound is larger than those of the note
/// itself.
TYPED_TEST(EveryFormat, APresetChangedWhileItSoundsRingsOut) {
    TypeParam one;
    prepare(one);
    one.events.note_on(0, 40, 1);
    one.render(9600);
    double step_before = 0, step_after = 0;
    for (std::size_t n = 4800; n < 9600; ++n)
        step_before = std::max<double>(step_before, std::abs(one.left[n] - one.left[n - 1]));
    ASSERT_TRUE(one.load(small_state("guitar-steel")));
    one.render(9600);
    for (std::size_t n = 9600; n < 19200; ++n)
        step_after = std::max<double>(step_after, std::abs(one.left[n] - one.left[n - 1]));
    EXPECT_LE(step_after, step_before);
    EXPECT_GT(loudest_of(one.left, 9700), 1e-4);
    one.left.clear();
    one.events.note_on(0, 64, 1);  // no string of the bass has it
    one.render(4800);
    EXPECT_GT(loudest_of(one.left), 1e-3);
}

TYPED_TEST(EveryFormat, SingleStringsComeOutByThemselves) {
    TypeParam one;
    one.strings_wanted = 16;
    prepare(one);  // E1, A1, D2, G2
    one.events.note_on(0, 33, 100 / 127.0);
    one.render(2000);
    std::set<std::size_t> sounding;
    for (std::size_t s = 0; s < 16; ++s)
        if (loudest_of(one.strings[s]) > 1e-4) sounding.insert(s);
    EXPECT_EQ(sounding, std::set<std::size_t>{1});
    one.events.note_on(0, 43, 100 / 127.0);
    one.render(2000);
    EXPECT_GT(loudest_of(one.strings[3]), 1e-4);
    EXPECT_EQ(loudest_of(one.strings[0]), 0);
}

TYPED_TEST(EveryFormat, TwoInstancesOnTwoThreadsDoNotKnowEachOther) {
    std::vector<float> alone;
    std::array<std::vector<float>, 2> together;
    const auto play = [](std::vector<float>& sound) {
        TypeParam one;
        ASSERT_TRUE(one.load(small_state()));
        for (int cycle = 0; cycle < 3; ++cycle) {
            ASSERT_TRUE(one.activate());
            one.events.note_on(0, 33, 100 / 127.0);
            one.events.note_on(100, 45, 100 / 127.0);
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
    EXPECT_GT(loudest_of(alone), 1e-3);
}

/// The host's other thread loads and saves while the audio thread plays.
TYPED_TEST(EveryFormat, StatesComeAndGoWhileItPlays) {
    TypeParam one;
    prepare(one);
    const std::array<std::string, 2> states{small_state("bass-fretted"), small_state("sitar")};
    std::thread control([&] {
        for (int n = 0; n < 12; ++n) {
            one.load(states[static_cast<std::size_t>(n) % 2]);
            EXPECT_GT(one.save().size(), 1000U);
        }
    });
    for (int block = 0; block < 400; ++block) {
        if (block % 20 == 0) one.events.note_on(0, 40 + block % 12, 1);
        one.process(64);
    }
    control.join();
    for (const float sample : one.left) ASSERT_TRUE(std::isfinite(sample));
    EXPECT_GT(loudest_of(one.left), 1e-3);
}

}  // namespace
}  // namespace jawari::host
