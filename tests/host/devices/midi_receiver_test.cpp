#include "devices/midi_receiver.h"

#include <gtest/gtest.h>

#include "devices/midi_inputs.h"

namespace jawari::host {
namespace {

std::optional<ChannelMessage> from(std::vector<unsigned char> bytes) {
    return channel_message(bytes);
}

TEST(ChannelMessageFromDriver, TakesWholeChannelMessages) {
    const auto note = from({0x93, 60, 100});
    ASSERT_TRUE(note);
    EXPECT_EQ(note->status, 0x93);
    EXPECT_EQ(note->data1, 60);
    EXPECT_EQ(note->data2, 100);
    const auto program = from({0xC0, 5});
    ASSERT_TRUE(program);
    EXPECT_EQ(program->data2, 0);
}

TEST(ChannelMessageFromDriver, LeavesOutTheRest) {
    for (const auto& bytes : std::vector<std::vector<unsigned char>>{{},
                                                                     {0x90},
                                                                     {0x90, 60},
                                                                     {0x90, 60, 100, 1},
                                                                     {0xC0},
                                                                     {0xC0, 1, 2},
                                                                     {0x90, 0x80, 1},
                                                                     {0x90, 1, 0xFF},
                                                                     {60, 60, 60},
                                                                     {0xF0, 1, 0xF7},
                                                                     {0xF8},
                                                                     {0xFE}})
        EXPECT_FALSE(from(bytes));
}

TEST(SystemMessagesFromDriver, ResetsAndExclusives) {
    const auto kinds = [](const std::vector<unsigned char>& bytes) {
        std::vector<SystemKind> all;
        const auto decoded = system_messages(bytes);
        if (!decoded) return all;
        for (const ChannelMessage& message : decoded->messages)
            all.push_back(static_cast<SystemKind>(message.status));
        return all;
    };
    using Kinds = std::vector<SystemKind>;
    EXPECT_EQ(kinds({0xFF}), Kinds{SystemKind::Reset});
    EXPECT_EQ(kinds({0xF0, 0x7E, 0x7F, 0x09, 0x01, 0xF7}), Kinds{SystemKind::Reset});
    EXPECT_EQ(kinds({0xF0, 0x7F, 0x7F, 0x04, 0x01, 0, 64, 0xF7}), Kinds{SystemKind::MasterVolume});
    for (const auto& bytes : std::vector<std::vector<unsigned char>>{
             {}, {0xF0}, {0xFE}, {0xF8}, {0xF0, 0xF7}, {0xF0, 0x7E, 0x7F, 0x09, 0x01}, {0x90, 60, 1}})
        EXPECT_TRUE(kinds(bytes).empty());
    EXPECT_FALSE(system_messages(std::vector<unsigned char>{0xFE}));
    // GS reverb: nothing that strings can do, but it has a name to be counted by.
    const std::vector<unsigned char> reverb{0xF0, 0x41, 0x10, 0x42, 0x12, 0x40, 0x01, 0x30, 0x04, 0x0B, 0xF7};
    EXPECT_EQ(system_messages(reverb)->name, "GS reverb");
}

TEST(LastingName, LeavesOutNumbersThatChangeWhenADeviceIsPluggedInAgain) {
    EXPECT_EQ(lasting_name("Keystation 49:Keystation 49 MIDI 1 20:0"), "Keystation 49:Keystation 49 MIDI 1");
    EXPECT_EQ(lasting_name("Keystation 49:Keystation 49 MIDI 1 128:12"),
              "Keystation 49:Keystation 49 MIDI 1");
    for (const char* name :
         {"keyboard:out", "system:midi_capture_1", "Piano 2", "a:1", "", "20:0", " ", "x 20:", "x :0"})
        EXPECT_EQ(lasting_name(name), name);
}

}  // namespace
}  // namespace jawari::host
