#include "devices/held_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

namespace jawari::host {
namespace {

using Bytes = std::array<int, 3>;

std::set<Bytes> bytes_of(const std::vector<ChannelMessage>& messages) {
    std::set<Bytes> all;
    for (const ChannelMessage& each : messages) all.insert({each.status, each.data1, each.data2});
    return all;
}

TEST(HeldNotes, LetsGoOfWhatIsHeldAndOfNothingElse) {
    HeldNotes held;
    for (const ChannelMessage& message : {ChannelMessage{0x90, 40, 100},
                                          {0x90, 47, 90},
                                          {0x95, 40, 1},
                                          {0x90, 47, 0},
                                          {0x91, 50, 10},
                                          {0x81, 50, 64},
                                          {0xB0, 64, 127},
                                          {0xB3, 64, 127},
                                          {0xB3, 64, 63},
                                          {0xE2, 1, 64},
                                          {0xE4, 0, 64},
                                          {0xB0, 1, 100},
                                          {0xD0, 90, 0}})
        follow(held, message);
    EXPECT_EQ(bytes_of(release_all(held)),
              (std::set<Bytes>{{0x80, 40, 64}, {0x85, 40, 64}, {0xB0, 64, 0}, {0xE2, 0, 64}}));
    EXPECT_TRUE(release_all(held).empty());
}

TEST(HeldNotes, EveryOpenNoteGetsItsNoteOff) {
    HeldNotes held;
    for (const ChannelMessage& message : {ChannelMessage{0x90, 40, 100},
                                          {0x90, 40, 90},
                                          {0x90, 40, 90},
                                          {0x80, 40, 0},
                                          {0xB0, 66, 127},
                                          {0xB0, 69, 64}})
        follow(held, message);
    const auto released = release_all(held);
    EXPECT_EQ(std::count_if(released.begin(), released.end(), [](const auto& m) { return m.status == 0x80; }),
              2);
    EXPECT_EQ(bytes_of(released), (std::set<Bytes>{{0x80, 40, 64}, {0xB0, 66, 0}, {0xB0, 69, 0}}));
    follow(held, {0x90, 40, 100});
    follow(held, {0xB0, 123, 0});
    EXPECT_TRUE(release_all(held).empty());
}

TEST(HeldNotes, NothingIsLeftWhateverWasPlayed) {
    std::mt19937 random(1);
    const auto up_to = [&](unsigned most) { return static_cast<std::uint8_t>(random() % (most + 1)); };
    for (int round = 0; round < 200; ++round) {
        HeldNotes held;
        for (int i = 0; i < 300; ++i)
            follow(held, {static_cast<std::uint8_t>(0x80 + up_to(0x6F)), up_to(127), up_to(127)});
        for (const ChannelMessage& message : release_all(held)) follow(held, message);
        EXPECT_TRUE(release_all(held).empty());
    }
}

}  // namespace
}  // namespace jawari::host
