// Notes with fine velocities and tunings of their own, among MIDI's.
#include "midi/interpreter_expressions.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace jawari::host {
namespace {

using Type = InstrumentEventType;

struct Fixture : testing::Test {
    template <class Function>
    std::vector<InstrumentEvent> after(Function function) {
        actions->count = 0;
        function();
        return {actions->events.begin(),
                actions->events.begin() + static_cast<std::ptrdiff_t>(actions->count)};
    }
    std::vector<InstrumentEvent> start(int key, double velocity, int channel = 0) {
        return after([&] { start_note(*interpreter, channel, key, velocity, *actions); });
    }
    std::vector<InstrumentEvent> release(int key, int channel = 0) {
        return after([&] { release_note(*interpreter, channel, key, 0.25, *actions); });
    }
    std::vector<InstrumentEvent> tune(int key, double semitones, int channel = 0) {
        return after([&] { tune_note(*interpreter, channel, key, semitones, *actions); });
    }
    std::vector<InstrumentEvent> send(std::uint8_t status, std::uint8_t data1, std::uint8_t data2) {
        return after([&] { interpret(*interpreter, {status, data1, data2}, *actions); });
    }
    std::unique_ptr<MidiInterpreter> interpreter = std::make_unique<MidiInterpreter>(make_interpreter({}));
    std::unique_ptr<MidiActions> actions = std::make_unique<MidiActions>();
};

using FineNotes = Fixture;

TEST_F(FineNotes, KeepTheirVelocity) {
    const auto on = start(50, 0.123456789);
    ASSERT_EQ(on.size(), 1U);
    EXPECT_EQ(on[0].type, Type::NoteOn);
    EXPECT_EQ(on[0].value, 0.123456789);
    const auto off = release(50);
    ASSERT_EQ(off.size(), 1U);
    EXPECT_EQ(off[0].type, Type::NoteOff);
    EXPECT_EQ(off[0].value, 0.25);
}

TEST_F(FineNotes, ObeyModesAndPedals) {
    send(0xB0, 126, 1);  // mono
    start(50, 0.5);
    const auto second = start(52, 0.5);
    ASSERT_EQ(second.size(), 2U);
    EXPECT_EQ(second[1].type, Type::NoteOff);
    EXPECT_EQ(second[1].key, 50);
    send(0xB0, 66, 127);  // sostenuto
    EXPECT_TRUE(release(52).empty());
    const auto up = send(0xB0, 66, 0);
    ASSERT_EQ(up.size(), 1U);
    EXPECT_EQ(up[0].key, 52);
}

TEST_F(FineNotes, AreTunedBesideTheirChannelsBend) {
    start(50, 0.5);
    send(0xE0, 0, 0x60);  // one semitone up
    const auto tuned = tune(50, 0.5);
    ASSERT_EQ(tuned.size(), 1U);
    EXPECT_EQ(tuned[0].type, Type::Bend);
    EXPECT_EQ(tuned[0].key, 50);
    EXPECT_NEAR(tuned[0].value, 1.5, 1e-3);
    const auto bent = send(0xE0, 0, 0x40);
    ASSERT_EQ(bent.size(), 2U);  // the channel, and the note on its own
    EXPECT_EQ(bent[0].value, 0);
    EXPECT_EQ(bent[1].key, 50);
    EXPECT_EQ(bent[1].value, 0.5);
    ASSERT_EQ(tune(50, 0).size(), 1U);
    EXPECT_EQ(send(0xE0, 0, 0x60).size(), 2U);  // it has a bend of its own to follow with
}

TEST_F(FineNotes, TuningEndsWithTheNote) {
    EXPECT_TRUE(tune(50, 3).empty());
    start(50, 0.5);
    tune(50, 3);
    release(50);
    EXPECT_TRUE(tune(50, 3).empty());
    const auto again = start(50, 0.5);
    ASSERT_EQ(again.size(), 1U);
    EXPECT_EQ(again[0].type, Type::NoteOn);
    EXPECT_EQ(send(0xE0, 0, 0x60).size(), 1U);
}

TEST_F(FineNotes, ExtremeTuningsStayInTheEnginesRange) {
    start(50, 0.5);
    send(0xE0, 0x7F, 0x7F);
    EXPECT_EQ(tune(50, 96)[0].value, 96);
}

}  // namespace
}  // namespace jawari::host
