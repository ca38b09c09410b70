// Notes, bends, pressure, programs, MPE and guitar mode. Expected values are those of the specifications:
// MIDI 1.0 Detailed Specification 4.2, CA-031, MPE M1-100-UM v1.0.
#include "midi/interpreter.h"

#include <gtest/gtest.h>

#include "support/interpret.h"

namespace jawari::host {
namespace {

using test::Player;
using test::value_of;
using Type = InstrumentEventType;

TEST(Interpreter, NotesWithVelocities) {
    Player player;
    const auto on = player.send(0x93, 60, 127);
    ASSERT_EQ(on.size(), 1U);
    EXPECT_EQ(on[0].type, Type::NoteOn);
    EXPECT_EQ(on[0].channel, 3);
    EXPECT_EQ(on[0].key, 60);
    EXPECT_EQ(on[0].value, 1.0);
    EXPECT_EQ(on[0].string, -1);
    const auto off = player.send(0x83, 60, 127);
    EXPECT_EQ(off[0].type, Type::NoteOff);
    EXPECT_EQ(off[0].value, 1.0);
    const auto silent = player.send(0x93, 60, 0);  // velocity 0 is a note-off of medium velocity
    EXPECT_EQ(silent[0].type, Type::NoteOff);
    EXPECT_EQ(silent[0].value, 0.5);
}

TEST(Interpreter, TheHighResolutionVelocityPrefixHoldsForOneNote) {
    Player player;
    EXPECT_TRUE(player.control(1, 88, 127).empty());
    EXPECT_EQ(player.send(0x90, 60, 127)[0].value, 1.0);
    player.control(1, 88, 0);
    EXPECT_NEAR(player.send(0x90, 60, 64)[0].value, 8192 / 16383.0, 1e-15);
    EXPECT_NEAR(player.send(0x90, 60, 64)[0].value, 64 / 127.0, 1e-15);
}

TEST(Interpreter, PitchBendCoversItsRange) {
    Player player;
    EXPECT_EQ(value_of(player.bend(1, 16383), Type::Bend, 0), 2.0);
    EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -2.0);
    EXPECT_EQ(value_of(player.bend(1, 8192), Type::Bend, 0), 0.0);
    EXPECT_EQ(value_of(player.bend(1, 4096), Type::Bend, 0), -1.0);
    EXPECT_EQ(player.bend(1, 0)[0].key, -1);
    const auto moved = player.rpn(1, 0, 12);  // a new range moves a wheel that is held
    EXPECT_EQ(value_of(moved, Type::Bend, 0), -12.0);
    EXPECT_EQ(value_of(player.control(1, 38, 50), Type::Bend, 0), -12.5);
    EXPECT_EQ(value_of(player.bend(2, 0), Type::Bend, 1), -2.0);  // other channels keep theirs
    player.rpn(2, 0, 127);
    EXPECT_EQ(value_of(player.bend(2, 0), Type::Bend, 1), -96.0);
}

TEST(Interpreter, Pressure) {
    Player player;
    const auto channel = player.send(0xD4, 127);
    ASSERT_EQ(channel.size(), 1U);
    EXPECT_EQ(channel[0].type, Type::Pressure);
    EXPECT_EQ(channel[0].key, -1);
    EXPECT_EQ(channel[0].value, 1.0);
    const auto poly = player.send(0xA4, 61, 127);
    EXPECT_EQ(poly[0].type, Type::Pressure);
    EXPECT_EQ(poly[0].channel, 4);
    EXPECT_EQ(poly[0].key, 61);
}

TEST(Interpreter, ProgramsWithTheirBank) {
    Player player;
    EXPECT_TRUE(player.send(0xC2, 24).empty());
    EXPECT_TRUE(player.actions.program.asked);
    EXPECT_EQ(player.actions.program.channel, 2);
    EXPECT_EQ(player.actions.program.program, 24);
    EXPECT_EQ(player.actions.program.bank, 0);
    player.control(3, 0, 2);
    EXPECT_FALSE(player.actions.program.asked);
    player.control(3, 32, 5);
    player.send(0xC2, 7);
    EXPECT_EQ(player.actions.program.bank, 2 * 128 + 5);
    player.send(0xC1, 7);
    EXPECT_EQ(player.actions.program.bank, 0);
}

TEST(Interpreter, MonoEndsTheNoteBefore) {
    Player player;
    player.control(1, 126, 1);
    EXPECT_EQ(player.send(0x90, 60, 100).size(), 1U);
    const auto second = player.send(0x90, 62, 100);
    ASSERT_EQ(second.size(), 2U);
    EXPECT_EQ(second[0].type, Type::NoteOn);
    EXPECT_EQ(second[1].type, Type::NoteOff);
    EXPECT_EQ(second[1].key, 60);
    player.send(0x80, 62, 64);
    EXPECT_EQ(player.send(0x90, 64, 100).size(), 1U);
    EXPECT_EQ(player.send(0x91, 60, 100).size() + player.send(0x91, 62, 100).size(), 2U);  // channel 2: poly
    player.control(1, 127, 0);
    EXPECT_EQ(player.send(0x90, 65, 100).size() + player.send(0x90, 66, 100).size(), 2U);
}

TEST(Interpreter, MessagesOutOfRangeComeToNothing) {
    Player player;
    for (const auto& bytes :
         {std::array{0x70, 1, 1}, std::array{0xF0, 1, 1}, std::array{0x90, 128, 1}, std::array{0x90, 1, 255}})
        EXPECT_TRUE(player.send(bytes[0], bytes[1], bytes[2]).empty());
}

// ------------------------------------------------------------------------------------------------- MPE

TEST(InterpreterMpe, DefaultRangesAndTheSumOfBends) {
    Player player;
    player.rpn(1, 6, 7);
    EXPECT_EQ(value_of(player.bend(3, 16383), Type::Bend, 2), 48.0);
    const auto all = player.bend(1, 0);
    EXPECT_EQ(value_of(all, Type::Bend, 0), -2.0);
    EXPECT_EQ(value_of(all, Type::Bend, 1), -2.0);
    EXPECT_EQ(value_of(all, Type::Bend, 2), 46.0);
    EXPECT_EQ(value_of(all, Type::Bend, 7), -2.0);
    EXPECT_FALSE(value_of(all, Type::Bend, 8));
    EXPECT_EQ(value_of(player.bend(9, 16383), Type::Bend, 8), 2.0);  // outside the zone
}

TEST(InterpreterMpe, AMembersBendRangeIsThatOfAllMembers) {
    Player player;
    player.rpn(16, 6, 3);
    player.rpn(14, 0, 24);
    EXPECT_EQ(value_of(player.bend(13, 0), Type::Bend, 12), -24.0);
    EXPECT_EQ(value_of(player.bend(15, 0), Type::Bend, 14), -24.0);
    EXPECT_EQ(value_of(player.bend(16, 16383), Type::Bend, 15), 2.0);
    EXPECT_EQ(value_of(player.bend(12, 0), Type::Bend, 11), -2.0);
}

TEST(InterpreterMpe, ZoneMessagesReachAllMembers) {
    Player player;
    player.rpn(1, 6, 2);
    const auto pedal = player.control(1, 64, 127);
    EXPECT_EQ(pedal.size(), 3U);
    EXPECT_EQ(value_of(pedal, Type::Sustain, 2), 1.0);
    EXPECT_EQ(player.control(1, 7, 127).size(), 3U);
    EXPECT_EQ(player.control(1, 120, 0).size(), 3U);
    EXPECT_TRUE(player.control(2, 64, 127).empty());  // not on members
    EXPECT_TRUE(player.control(2, 7, 0).empty());
    player.send(0xC1, 5);
    EXPECT_FALSE(player.actions.program.asked);
    EXPECT_TRUE(player.send(0xA1, 60, 100).empty());  // no polyphonic pressure on members
    EXPECT_FALSE(player.send(0xA0, 60, 100).empty());
    EXPECT_EQ(part_channel(player.interpreter, 2), 0);
    EXPECT_EQ(part_channel(player.interpreter, 3), 3);
}

TEST(InterpreterMpe, PressureAndTimbreOfNoteAndZone) {
    Player player;
    player.rpn(1, 6, 2);
    EXPECT_EQ(value_of(player.send(0xD1, 127), Type::Pressure, 1), 1.0);
    const auto pressed = player.send(0xD0, 64);
    EXPECT_EQ(value_of(pressed, Type::Pressure, 1), 1.0);
    EXPECT_EQ(value_of(pressed, Type::Pressure, 2), 64 / 127.0);
    EXPECT_EQ(value_of(player.control(2, 74, 127), Type::Timbre, 1), 1.0);
    EXPECT_EQ(value_of(player.control(2, 74, 64), Type::Timbre, 1), 0.5);
    const auto moved = player.control(1, 74, 32);
    EXPECT_EQ(value_of(moved, Type::Timbre, 0), 0.25);
    EXPECT_EQ(value_of(moved, Type::Timbre, 1), 0.25);
}

TEST(InterpreterMpe, AConfigurationStartsItsChannelsAnew) {
    Player player;
    player.rpn(1, 6, 3);
    player.bend(2, 0);
    const auto again = player.rpn(1, 6, 5);
    for (int channel = 0; channel <= 5; ++channel) {
        EXPECT_TRUE(value_of(again, Type::AllNotesOff, channel)) << channel;
        EXPECT_TRUE(value_of(again, Type::ResetControllers, channel)) << channel;
    }
    EXPECT_FALSE(value_of(again, Type::AllNotesOff, 6));
    EXPECT_EQ(value_of(player.bend(1, 16383), Type::Bend, 1), 2.0);  // channel 2's bend is forgotten
    const auto off = player.rpn(1, 6, 0);
    EXPECT_TRUE(value_of(off, Type::AllNotesOff, 5));
    EXPECT_EQ(value_of(player.bend(2, 16383), Type::Bend, 1), 2.0);  // an ordinary channel again
}

TEST(InterpreterMpe, OtherChannelsCannotConfigure) {
    Player player;
    EXPECT_TRUE(player.rpn(5, 6, 5).empty());
    EXPECT_TRUE(player.rpn(1, 6, 16).empty());
    EXPECT_EQ(manager_of(player.interpreter.zones, 1), -1);
}

TEST(InterpreterMpe, TheLargestAnswersFit) {
    InterpreterSettings settings;
    settings.map = {};
    for (const int controller : {1, 11})
        for (std::size_t i = 0; i < most_bindings_per_source; ++i)
            settings.map.bindings[settings.map.count++] =
                whole_range(MidiSource::Controller, controller, ParameterId::PalmMute);
    Player player(settings);
    player.rpn(1, 6, 15);
    player.control(1, 74, 0);
    player.control(1, 6, 15);
    player.control(1, 74, 1);
    for (int channel = 1; channel <= 16; ++channel) {
        player.rpn(channel, 1, 0);
        player.bend(channel, 0);
    }
    const auto reset = player.control(1, 121, 0);
    EXPECT_EQ(reset.size(), 16U * (1 + 1 + 8 + 1));
    EXPECT_LT(reset.size(), player.actions.events.size());
}

// --------------------------------------------------------------------------------------------- guitar mode

TEST(InterpreterGuitar, OneStringAChannel) {
    InterpreterSettings settings;
    settings.guitar_channel = 10;
    settings.guitar_strings = 4;
    settings.guitar_string = {3, 2, 1, 0};
    Player player(settings);
    EXPECT_EQ(player.send(0x9A, 60, 100)[0].string, 3);
    EXPECT_EQ(player.send(0x9D, 60, 100)[0].string, 0);
    EXPECT_EQ(player.send(0x9E, 60, 100)[0].string, -1);
    EXPECT_EQ(player.send(0x99, 60, 100)[0].string, -1);
    const auto next = player.send(0x9A, 62, 100);  // mono
    ASSERT_EQ(next.size(), 2U);
    EXPECT_EQ(next[1].key, 60);
    EXPECT_EQ(part_channel(player.interpreter, 13), 10);
    EXPECT_EQ(part_channel(player.interpreter, 14), 14);
}

}  // namespace
}  // namespace jawari::host
