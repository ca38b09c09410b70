// Parameters that the host sets, and controllers after them.
#include "midi/interpreter_parameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace jawari::host {
namespace {

struct Fixture : testing::Test {
    std::vector<InstrumentEvent> set(ParameterId parameter, double value) {
        actions->count = 0;
        set_parameter(*interpreter, parameter, value, *actions);
        return {actions->events.begin(),
                actions->events.begin() + static_cast<std::ptrdiff_t>(actions->count)};
    }
    std::vector<InstrumentEvent> send(std::uint8_t status, std::uint8_t data1, std::uint8_t data2) {
        interpret(*interpreter, {status, data1, data2}, *actions);
        return {actions->events.begin(),
                actions->events.begin() + static_cast<std::ptrdiff_t>(actions->count)};
    }
    std::unique_ptr<MidiInterpreter> interpreter = std::make_unique<MidiInterpreter>(make_interpreter({}));
    std::unique_ptr<MidiActions> actions = std::make_unique<MidiActions>();
};

using HostParameters = Fixture;

TEST_F(HostParameters, AreOneEventForAllChannels) {
    const auto events = set(ParameterId::PalmMute, 0.3);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].type, InstrumentEventType::SetParameter);
    EXPECT_EQ(events[0].channel, every_channel);
    EXPECT_EQ(events[0].parameter, ParameterId::PalmMute);
    EXPECT_EQ(events[0].value, 0.3);
}

TEST_F(HostParameters, OutOfTheirRangeAreIgnored) {
    EXPECT_TRUE(set(ParameterId::PalmMute, 1.01).empty());
    EXPECT_TRUE(set(ParameterId::PalmMute, std::numeric_limits<double>::quiet_NaN()).empty());
}

TEST_F(HostParameters, TheMasterVolumeMultipliesTheVolume) {
    send(0xF2, 0, 0x40);  // half of 14 bits: a quarter of the level
    const double share = 8192.0 / 16383.0;
    const auto events = set(ParameterId::Volume, 0.8);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_DOUBLE_EQ(events[0].value, 0.8 * share * share);
    const auto after = send(0xF2, 0x7F, 0x7F);  // whole again: the channels come back to the host's value
    ASSERT_FALSE(after.empty());
    EXPECT_EQ(after[0].value, 0.8);
}

TEST_F(HostParameters, TheBendRangeIsTheWheels) {
    const auto events = set(ParameterId::BendRange, 12);
    ASSERT_EQ(events.size(), 1U);  // no wheel is moved
    const auto bend = send(0xE3, 0x7F, 0x7F);
    ASSERT_EQ(bend.size(), 1U);
    EXPECT_DOUBLE_EQ(bend[0].value, 12);
    const auto wider = set(ParameterId::BendRange, 24);  // and a wheel that is moved goes on with it
    ASSERT_EQ(wider.size(), 2U);
    EXPECT_EQ(wider[1].type, InstrumentEventType::Bend);
    EXPECT_EQ(wider[1].channel, 3);
    EXPECT_DOUBLE_EQ(wider[1].value, 24);
}

TEST_F(HostParameters, ChannelsThatSlideStayLegato) {
    send(0xB2, 126, 1);
    send(0xB2, 65, 127);
    const auto events = set(ParameterId::Legato, 0);
    EXPECT_EQ(events.size(), 15U);
    for (const InstrumentEvent& event : events) EXPECT_NE(event.channel, 2);
    const auto after = send(0xB2, 65, 0);  // the slide ends: as the host has it
    ASSERT_FALSE(after.empty());
    EXPECT_EQ(after[0].value, 0);
}

}  // namespace
}  // namespace jawari::host
