// Raw MIDI bytes: "MIDI 1.0 Detailed Specification" 4.2 (running status, real time).
#include "midi/byte_stream.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace jawari::host {
namespace {

std::vector<ChannelMessage> messages(std::initializer_list<int> bytes) {
    MidiByteStream stream;
    std::vector<ChannelMessage> found;
    for (const int byte : bytes)
        if (const auto message = take_byte(stream, static_cast<std::uint8_t>(byte)))
            found.push_back(*message);
    return found;
}

void expect(const ChannelMessage& message, int status, int data1, int data2) {
    EXPECT_EQ(message.status, status);
    EXPECT_EQ(message.data1, data1);
    EXPECT_EQ(message.data2, data2);
}

TEST(MidiByteStream, RunningStatusRepeatsTheStatus) {
    const auto found = messages({0x91, 60, 100, 62, 101, 60, 0});
    ASSERT_EQ(found.size(), 3U);
    expect(found[0], 0x91, 60, 100);
    expect(found[1], 0x91, 62, 101);
    expect(found[2], 0x91, 60, 0);
}

TEST(MidiByteStream, OneByteMessages) {
    const auto found = messages({0xC3, 7, 8, 0xD0, 99});
    ASSERT_EQ(found.size(), 3U);
    expect(found[0], 0xC3, 7, 0);
    expect(found[1], 0xC3, 8, 0);
    expect(found[2], 0xD0, 99, 0);
}

TEST(MidiByteStream, RealTimeBytesMayComeAnywhere) {
    const auto found = messages({0x90, 0xF8, 60, 0xFE, 100, 0xFA, 61, 0xFF, 99});
    ASSERT_EQ(found.size(), 2U);
    expect(found[0], 0x90, 60, 100);
    expect(found[1], 0x90, 61, 99);
}

TEST(MidiByteStream, SystemMessagesEndRunningStatus) {
    EXPECT_EQ(messages({0x90, 60, 100, 0xF0, 1, 2, 3, 0xF7, 61, 100}).size(), 1U);
    EXPECT_EQ(messages({0x90, 60, 100, 0xF2, 1, 2, 61, 100}).size(), 1U);
    EXPECT_EQ(messages({0x90, 60, 100, 0xF6, 61, 100, 0x80, 60, 1}).size(), 2U);
}

TEST(MidiByteStream, AStatusByteAbandonsAnIncompleteMessage) {
    const auto found = messages({0x90, 60, 0xB0, 64, 127});
    ASSERT_EQ(found.size(), 1U);
    expect(found[0], 0xB0, 64, 127);
    EXPECT_TRUE(messages({60, 100, 61}).empty());
}

}  // namespace
}  // namespace jawari::host
