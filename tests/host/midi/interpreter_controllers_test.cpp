// Controllers, data entry and modes: MIDI 1.0 Detailed Specification 4.2, RP-015, RP-018.
#include "midi/interpreter_controllers.h"

#include <gtest/gtest.h>

#include "support/interpret.h"

namespace jawari::host {
namespace {

using test::Player;
using test::value_of;
using Type = InstrumentEventType;

double parameter(const std::vector<InstrumentEvent>& events, ParameterId id) {
    return value_of(events, Type::SetParameter, 0, id).value_or(-99);
}

TEST(Controllers, VolumeExpressionPanAndModulation) {
    Player player;
    EXPECT_EQ(parameter(player.control(1, 7, 127), ParameterId::Volume), 1.0);
    EXPECT_EQ(parameter(player.control(1, 7, 64), ParameterId::Volume), 0.25);  // General MIDI 2: 40 log10(v)
    EXPECT_EQ(parameter(player.control(1, 11, 0), ParameterId::Expression), 0.0);
    EXPECT_EQ(parameter(player.control(1, 10, 0), ParameterId::Pan), -1.0);
    EXPECT_EQ(parameter(player.control(1, 10, 64), ParameterId::Pan), 0.0);
    EXPECT_EQ(parameter(player.control(1, 10, 127), ParameterId::Pan), 1.0);
    EXPECT_EQ(parameter(player.control(1, 1, 0), ParameterId::VibratoDepth), 0.0);
    EXPECT_EQ(parameter(player.control(1, 1, 127), ParameterId::VibratoDepth),
              0.5);  // a left hand's, not a siren's
    EXPECT_TRUE(player.control(1, 3, 100).empty());
    EXPECT_TRUE(player.control(1, 39, 100).empty());  // the fine half of an unpaired binding
}

TEST(Controllers, PedalsAndTimbre) {
    Player player;
    EXPECT_EQ(value_of(player.control(1, 64, 127), Type::Sustain, 0), 1.0);
    EXPECT_LT(value_of(player.control(1, 64, 63), Type::Sustain, 0), 0.5);  // 64 and up is on
    EXPECT_GE(value_of(player.control(1, 64, 64), Type::Sustain, 0), 0.5);
    EXPECT_EQ(value_of(player.control(1, 67, 127), Type::SoftPedal, 0), 1.0);
    EXPECT_EQ(value_of(player.control(1, 74, 64), Type::Timbre, 0), 0.5);
    EXPECT_EQ(value_of(player.control(1, 74, 127), Type::Timbre, 0), 1.0);
}

TEST(Controllers, DataGoesNowhereWithoutASelection) {
    Player player;
    player.control(1, 6, 24);
    player.rpn(1, 0, 12);
    player.control(1, 101, 127);
    player.control(1, 100, 127);  // the null number
    player.control(1, 6, 24);
    EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -12.0);
    player.control(1, 99, 0);  // a non-registered 0 is not the bend range
    player.control(1, 98, 0);
    player.control(1, 6, 24);
    EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -12.0);
    player.control(1, 101, 0);
    player.control(1, 100, 5);  // a registered number that nothing here has
    player.control(1, 6, 24);
    EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -12.0);
}

TEST(Controllers, IncrementAndDecrement) {
    Player player;
    player.bend(1, 0);
    player.control(1, 101, 0);
    player.control(1, 100, 0);
    EXPECT_NEAR(*value_of(player.control(1, 96, 0), Type::Bend, 0), -2.01, 1e-12);  // RP-018: cents
    EXPECT_NEAR(*value_of(player.control(1, 97, 0), Type::Bend, 0), -2.00, 1e-12);
    EXPECT_NEAR(*value_of(player.control(1, 97, 0), Type::Bend, 0), -1.99, 1e-12);
    player.control(1, 6, 0);
    EXPECT_EQ(value_of(player.control(1, 97, 0), Type::Bend, 0), 0.0);  // not below 0
}

TEST(Controllers, FineTuningIsPartOfTheBend) {
    Player player;
    EXPECT_EQ(value_of(player.rpn(1, 1, 0), Type::Bend, 0), -1.0);  // 00 00 is -100 cents
    EXPECT_EQ(value_of(player.rpn(1, 1, 64), Type::Bend, 0), 0.0);
    player.rpn(1, 1, 96);
    EXPECT_NEAR(*value_of(player.bend(1, 16383), Type::Bend, 0), 2.5, 1e-3);
}

TEST(Controllers, ResetAllControllersAsRecommended) {
    Player player;
    player.control(1, 74, 127);
    player.rpn(1, 0, 12);
    player.bend(1, 0);
    player.control(1, 99, 1);
    player.control(1, 98, 2);
    const auto reset = player.control(1, 121, 0);
    EXPECT_TRUE(value_of(reset, Type::ResetControllers, 0));
    EXPECT_EQ(parameter(reset, ParameterId::VibratoDepth), 0.0);
    EXPECT_EQ(parameter(reset, ParameterId::Expression), 1.0);
    EXPECT_EQ(parameter(reset, ParameterId::Volume), -99);  // volume and pan stay
    EXPECT_EQ(parameter(reset, ParameterId::Pan), -99);
    EXPECT_EQ(value_of(reset, Type::Timbre, 0), 1.0);  // 70 to 79 stay, whatever the instrument reset
    EXPECT_FALSE(value_of(reset, Type::Bend, 0));
    EXPECT_EQ(player.interpreter.channels[0].target, DataTarget::None);
    EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -12.0);  // the range stays
}

TEST(Controllers, FineTuningSurvivesAReset) {
    Player player;
    player.rpn(1, 1, 0);
    EXPECT_EQ(value_of(player.control(1, 121, 0), Type::Bend, 0), -1.0);
}

TEST(Controllers, ChannelModes) {
    Player player;
    EXPECT_EQ(player.control(5, 120, 0)[0].type, Type::AllSoundOff);
    EXPECT_EQ(player.control(5, 120, 0)[0].channel, 4);
    EXPECT_TRUE(player.control(5, 122, 0).empty());
    for (int mode = 123; mode <= 127; ++mode) {  // mode changes are all notes off
        const auto events = player.control(5, mode, 1);
        ASSERT_EQ(events.size(), 1U);
        EXPECT_EQ(events[0].type, Type::AllNotesOff);
    }
}

TEST(Controllers, MonoOfSeveralChannels) {
    Player player;
    player.control(3, 126, 2);
    EXPECT_FALSE(player.interpreter.channels[1].mono);
    EXPECT_TRUE(player.interpreter.channels[2].mono);
    EXPECT_TRUE(player.interpreter.channels[3].mono);
    EXPECT_FALSE(player.interpreter.channels[4].mono);
    player.control(9, 126, 0);  // 0 is all channels up to 16
    EXPECT_TRUE(player.interpreter.channels[15].mono);
}

TEST(Controllers, BoundPairsPressureAndNumbers) {
    InterpreterSettings settings;
    MidiMap& map = settings.map;
    map.bindings[map.count++] = whole_range(MidiSource::Controller14, 2, ParameterId::PalmMute);
    map.bindings[map.count++] = whole_range(MidiSource::ChannelPressure, 0, ParameterId::PickupMix);
    map.bindings[map.count++] = whole_range(MidiSource::Nrpn, 3 * 128 + 7, ParameterId::BodyMix);
    MidiBinding wheel = whole_range(MidiSource::Controller, 20, ParameterId::BendRange);
    wheel.channel = 1;
    map.bindings[map.count++] = wheel;
    Player player(settings);
    EXPECT_EQ(parameter(player.control(1, 2, 64), ParameterId::PalmMute), 0.5);
    EXPECT_NEAR(parameter(player.control(1, 34, 64), ParameterId::PalmMute), 0.5 + 0.5 * 64 / 8191, 1e-15);
    player.control(1, 2, 127);
    EXPECT_EQ(parameter(player.control(1, 34, 127), ParameterId::PalmMute), 1.0);
    const auto pressed = player.send(0xD0, 127);
    ASSERT_EQ(pressed.size(), 1U);
    EXPECT_EQ(parameter(pressed, ParameterId::PickupMix), 1.0);
    player.control(1, 99, 3);
    player.control(1, 98, 7);
    EXPECT_EQ(parameter(player.control(1, 6, 64), ParameterId::BodyMix), 1.0);
    EXPECT_TRUE(player.control(1, 20, 64).empty());  // bound on channel 2 only
    player.bend(2, 0);
    EXPECT_EQ(value_of(player.control(2, 20, 127), Type::Bend, 1), -96.0);
}

TEST(Controllers, TravelMeetsItsEndsAndItsCentre) {
    for (const int bits : {7, 14}) {
        const int top = (1 << bits) - 1;
        EXPECT_EQ(control_travel(0, bits), 0.0);
        EXPECT_EQ(control_travel(1 << (bits - 1), bits), 0.5);
        EXPECT_EQ(control_travel(top, bits), 1.0);
        for (int value = 1; value <= top; ++value)
            ASSERT_GT(control_travel(value, bits), control_travel(value - 1, bits));
    }
}

}  // namespace
}  // namespace jawari::host
