// Notes with ids, their expressions and their ends.
#include <gtest/gtest.h>

#include <cmath>

#include "support/clap_host.h"

namespace jawari::host {
namespace {

using test::ClapInstance;
using test::small_state;

struct Fixture : ClapInstance {
    explicit Fixture(const char* preset = "bass-fretted") {
        EXPECT_TRUE(load(small_state(preset)));
        EXPECT_TRUE(activate());
    }
    /// Ids of the notes that have ended since this was asked before.
    std::vector<int> ends() {
        std::vector<int> ids;
        for (const clap_event_note_t& event : ended) ids.push_back(event.note_id);
        ended.clear();
        return ids;
    }
};

double loudest(const std::vector<float>& sound, std::size_t from = 0) {
    double most = 0;
    for (std::size_t n = from; n < sound.size(); ++n) most = std::max<double>(most, std::abs(sound[n]));
    return most;
}

/// Of the sound from `from` on, at a frequency, over half a second.
double strength(const std::vector<float>& sound, std::size_t from, double hz) {
    double real = 0, imaginary = 0;
    for (std::size_t n = 0; n < 24000; ++n) {
        const double turn = 6.283185307179586 * hz * static_cast<double>(n) / 48000;
        real += static_cast<double>(sound[from + n]) * std::cos(turn);
        imaginary += static_cast<double>(sound[from + n]) * std::sin(turn);
    }
    return std::hypot(real, imaginary);
}

TEST(ClapNotes, EachEndIsReportedOnceWithTheHostsAddress) {
    Fixture one;
    one.events.note(CLAP_EVENT_NOTE_ON, 5, 33, 0.8, 101, 3, 0);
    one.events.note(CLAP_EVENT_NOTE_ON, 5, 38, 0.8, 102, 4, 0);
    one.render(4800);
    EXPECT_TRUE(one.ended.empty());
    one.events.note(CLAP_EVENT_NOTE_OFF, 0, 33, 0.5, 101, 3, 0);
    one.render(48000);
    ASSERT_EQ(one.ended.size(), 1U);
    EXPECT_EQ(one.ended[0].note_id, 101);
    EXPECT_EQ(one.ended[0].port_index, 0);
    EXPECT_EQ(one.ended[0].channel, 3);
    EXPECT_EQ(one.ended[0].key, 33);
    one.ended.clear();
    one.events.note(CLAP_EVENT_NOTE_OFF, 0, -1, 0.5, 102, -1, -1);  // by its id alone
    one.render(96000);
    EXPECT_EQ(one.ends(), std::vector<int>{102});
    EXPECT_EQ(one.process(10), CLAP_PROCESS_SLEEP);
}

TEST(ClapNotes, ANoteThatNoStringHasEndsAtOnce) {
    Fixture one;
    one.events.note_on(0, 5, 0.8, 1);
    one.process(100);
    EXPECT_EQ(one.ends(), std::vector<int>{1});
    EXPECT_EQ(loudest(one.left), 0);
}

TEST(ClapNotes, ANoteOnAHeldKeyEndsTheOneBefore) {
    Fixture one;
    one.events.note_on(0, 33, 0.8, 1);
    one.process(2000);
    one.events.note_on(0, 33, 0.8, 2);
    one.process(2000);
    EXPECT_EQ(one.ends(), std::vector<int>{1});
    one.events.note_off(0, 33, 1);  // of the first: the second goes on
    one.render(24000);
    EXPECT_TRUE(one.ends().empty());
    EXPECT_GT(loudest(one.left, 20000), 1e-4);
    one.events.note_off(0, 33, 2);
    one.render(96000);
    EXPECT_EQ(one.ends(), std::vector<int>{2});
}

TEST(ClapNotes, WithoutIdsEachNoteOffEndsTheOldestOfItsKey) {
    Fixture clap, midi;
    for (Fixture* each : {&clap, &midi}) {
        const bool notes = each == &clap;
        const auto on = [&] {
            notes ? each->events.note_on(0, 33, 100 / 127.0) : each->events.midi(0, 0x90, 33, 100);
        };
        const auto off = [&] {
            notes ? each->events.note(CLAP_EVENT_NOTE_OFF, 0, 33, 64 / 127.0)
                  : each->events.midi(0, 0x80, 33, 64);
        };
        on();
        each->render(1000);
        on();
        each->render(1000);
        off();
        each->render(2000);
        off();
        each->render(2000);
    }
    EXPECT_EQ(clap.left, midi.left);
}

TEST(ClapNotes, AnEndForAnyIdEndsAllNotesOfItsKey) {
    Fixture one;
    one.events.note_on(0, 33, 0.8, 1);
    one.events.note_on(1, 33, 0.8, 2);
    one.process(1000);
    one.events.note(CLAP_EVENT_NOTE_OFF, 0, 33, 0.5, -1);
    one.render(96000);
    EXPECT_EQ(one.ends(), (std::vector<int>{1, 2}));
}

TEST(ClapNotes, ThePedalHoldsANoteAndItsEnd) {
    Fixture one;
    one.events.midi(0, 0xB0, 64, 127);
    one.events.note_on(0, 33, 0.8, 1);
    one.process(1000);
    one.events.note_off(0, 33, 1);
    one.render(48000);
    EXPECT_TRUE(one.ends().empty());
    one.events.midi(0, 0xB0, 64, 0);
    one.render(96000);
    EXPECT_EQ(one.ends(), std::vector<int>{1});
}

TEST(ClapNotes, AChokeOfAllStopsTheSound) {
    Fixture one;
    one.events.note_on(0, 33, 0.9, 1);
    one.events.note_on(0, 45, 0.9, 2);
    one.process(2000);
    one.events.note(CLAP_EVENT_NOTE_CHOKE, 0, -1, 0, -1, -1, -1);
    one.process(4800);
    EXPECT_EQ(one.ends().size(), 2U);
    EXPECT_EQ(loudest(one.left, 6000), 0);
}

TEST(ClapNotes, VelocityHasMoreThanSevenBits) {
    const auto peak = [](double velocity) {
        Fixture one;
        one.events.note_on(0, 33, velocity);
        one.process(4000);
        return loudest(one.left);
    };
    EXPECT_LT(peak(64.0 / 127), peak(64.3 / 127));
    EXPECT_LT(peak(64.3 / 127), peak(65.0 / 127));
    EXPECT_GT(peak(0), 0);  // in CLAP a note of velocity 0 is one
}

TEST(ClapNotes, AsMidiAndAsClapItIsTheSameNote) {
    Fixture midi, clap;
    midi.events.midi(7, 0x90, 40, 93);
    clap.events.note_on(7, 40, 93 / 127.0);
    for (Fixture* each : {&midi, &clap}) each->render(2000);
    midi.events.midi(7, 0x80, 40, 64);
    clap.events.note(CLAP_EVENT_NOTE_OFF, 7, 40, 64 / 127.0);
    for (Fixture* each : {&midi, &clap}) each->render(4000);
    EXPECT_EQ(midi.left, clap.left);
    EXPECT_GT(loudest(clap.left), 1e-3);
}

TEST(ClapExpressions, TuningIsOfOneNoteAndAddsToTheWheel) {
    Fixture one;
    one.events.note_on(0, 33, 0.8, 1);  // 55 Hz
    one.events.note_on(0, 43, 0.8, 2);  // 98 Hz
    one.events.expression(0, CLAP_NOTE_EXPRESSION_TUNING, 33, 1, 1);
    one.render(9600);
    one.render(24000);
    EXPECT_GT(strength(one.left, 9600, 58.27), 3 * strength(one.left, 9600, 55));
    EXPECT_GT(strength(one.left, 9600, 98), 3 * strength(one.left, 9600, 103.83));
    one.events.midi(0, 0xE0, 0, 0);  // two semitones down: the tuned note one
    one.render(9600);
    one.render(24000);
    EXPECT_GT(strength(one.left, 43200, 51.91), 3 * strength(one.left, 43200, 58.27));
    EXPECT_GT(strength(one.left, 43200, 87.31), 3 * strength(one.left, 43200, 98));
}

TEST(ClapExpressions, BackAtZeroTheNoteFollowsTheWheelAsBefore) {
    Fixture tuned, plain;
    for (Fixture* each : {&tuned, &plain}) each->events.note_on(0, 33, 0.8, 1);
    tuned.events.expression(0, CLAP_NOTE_EXPRESSION_TUNING, 33, 3, 1);
    tuned.events.expression(0, CLAP_NOTE_EXPRESSION_TUNING, 33, 0, 1);
    for (Fixture* each : {&tuned, &plain}) {
        each->render(1000);
        each->events.midi(0, 0xE0, 0, 100);
        each->render(5000);
    }
    EXPECT_EQ(tuned.left, plain.left);
}

TEST(ClapExpressions, PressureIsThatOfTheKey) {
    Fixture expressed, pressed, plain;
    for (Fixture* each : {&expressed, &pressed, &plain}) {
        each->events.note_on(0, 33, 0.8, 1);
        each->events.note_on(0, 43, 0.8, 2);
    }
    expressed.events.expression(10, CLAP_NOTE_EXPRESSION_PRESSURE, 33, 100 / 127.0, 1);
    pressed.events.midi(10, 0xA0, 33, 100);
    for (Fixture* each : {&expressed, &pressed, &plain}) each->render(6000);
    EXPECT_EQ(expressed.left, pressed.left);
    EXPECT_NE(expressed.left, plain.left);
}

TEST(ClapExpressions, BrightnessIsThatOfTheNextPlucks) {
    Fixture bright, timbre, plain;
    for (Fixture* each : {&bright, &timbre, &plain}) each->events.note_on(0, 33, 0.8, 1);
    bright.events.expression(10, CLAP_NOTE_EXPRESSION_BRIGHTNESS, 33, 1.0, 1);
    timbre.events.midi(10, 0xB0, 74, 127);
    for (Fixture* each : {&bright, &timbre, &plain}) {
        each->events.note_on(200, 43, 0.8, 2);
        each->render(4000);
    }
    EXPECT_EQ(bright.left, timbre.left);
    EXPECT_NE(bright.left, plain.left);
}

TEST(ClapExpressions, OfNotesThatItDoesNotKnowAreLeftAlone) {
    Fixture odd, plain;
    for (Fixture* each : {&odd, &plain}) each->events.note_on(0, 33, 0.8, 1);
    odd.events.expression(1, CLAP_NOTE_EXPRESSION_TUNING, 33, 5, 9);
    odd.events.expression(1, CLAP_NOTE_EXPRESSION_TUNING, 34, 5);
    odd.events.expression(1, CLAP_NOTE_EXPRESSION_TUNING, 33, std::nan(""), 1);
    odd.events.expression(1, 77, 33, 5, 1);
    for (Fixture* each : {&odd, &plain}) each->render(2000);
    EXPECT_EQ(odd.left, plain.left);
}

/// Channel 2 is an ordinary channel until a message makes it one of a zone: its wheel spans 2 semitones,
/// not 48.
/// Of one note of two, by its id: half as loud, and on the left alone.
TEST(ClapExpressions, VolumeAndPanAreTheNotesOwn) {
    ClapInstance plain, expressed;
    for (ClapInstance* each : {&plain, &expressed}) {
        each->strings_wanted = 0;
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 33, 0.8, 1);
        each->process(0);
    }
    expressed.events.expression(0, CLAP_NOTE_EXPRESSION_VOLUME, 33, 0.5, 1);
    expressed.events.expression(0, CLAP_NOTE_EXPRESSION_PAN, 33, 0, 1);
    expressed.events.expression(0, CLAP_NOTE_EXPRESSION_VOLUME, 33, 0.1, 7);  // of no note
    for (ClapInstance* each : {&plain, &expressed}) each->render(9600);
    double whole = 0, left = 0, right = 0;
    for (std::size_t n = 4800; n < 9600; ++n) {
        whole += std::pow(plain.left[n], 2) + std::pow(plain.right[n], 2);
        left += std::pow(expressed.left[n], 2);
        right += std::pow(expressed.right[n], 2);
    }
    ASSERT_GT(whole, 0);
    EXPECT_NEAR(left + right, 0.25 * whole, 1e-3 * whole);
    EXPECT_LT(right, 1e-6 * whole);
}

TEST(ClapMpe, MessagesForAZoneDoNoHarmWithoutOne) {
    Fixture one;
    one.events.midi(0, 0x91, 33, 100);
    one.events.midi(0, 0xE1, 0, 0);
    one.render(9600);
    one.render(24000);
    EXPECT_GT(strength(one.left, 9600, 49), 3 * strength(one.left, 9600, 55));
}

TEST(ClapMpe, AZoneHasWideBendsOfSingleNotes) {
    Fixture one;
    for (const auto& [controller, value] : {std::pair{101, 0}, {100, 6}, {6, 15}})
        one.events.midi(0, 0xB0, static_cast<std::uint8_t>(controller), static_cast<std::uint8_t>(value));
    one.events.midi(0, 0x91, 33, 100);
    one.events.midi(0, 0x92, 43, 100);
    one.events.midi(0, 0xE1, 0x00, 0x50);  // a quarter of 48 semitones: an octave up
    one.render(9600);
    one.render(24000);
    EXPECT_GT(strength(one.left, 9600, 98), 3 * strength(one.left, 9600, 103.83));
    EXPECT_GT(strength(one.left, 9600, 110), strength(one.left, 9600, 55));
}

}  // namespace
}  // namespace jawari::host
