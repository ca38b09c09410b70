#include "commands/play/osc_message.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace jawari::host {
namespace {

using namespace std::string_literals;

Outcome<std::vector<OscMessage>> decode(const std::string& packet) {
    return decode_osc(std::span(packet.data(), packet.size()));
}

// Packets as "Open Sound Control Specification 1.0" (2002) spells them, byte by byte.
const std::string set_pan = "/jawari/set\0,sf\0pan\0\x3E\x80\0\0"s;  // 0.25

std::string bundle(const std::vector<std::string>& elements) {
    std::string packet = "#bundle\0\0\0\0\0\0\0\0\x01"s;
    for (const std::string& each : elements)
        packet +=
            "\0\0"s + static_cast<char>(each.size() / 256) + static_cast<char>(each.size() % 256) + each;
    return packet;
}

TEST(OscMessage, ReadsTheTypesOfTheSpecification) {
    const auto messages = decode(set_pan);
    ASSERT_TRUE(messages.ok()) << messages.error().message;
    ASSERT_EQ(messages.value().size(), 1U);
    EXPECT_EQ(messages.value()[0].path, "/jawari/set");
    EXPECT_EQ(messages.value()[0].arguments, (std::vector<VerbValue>{"pan"s, 0.25}));
    const auto all = decode("/a\0\0,ihdTFS\0\xFF\xFF\xFF\xFE\0\0\0\0\0\0\0\x07\x40\x04\0\0\0\0\0\0x\0\0\0"s);
    ASSERT_TRUE(all.ok()) << all.error().message;
    EXPECT_EQ(all.value()[0].arguments, (std::vector<VerbValue>{-2.0, 7.0, 2.5, 1.0, 0.0, "x"s}));
}

TEST(OscMessage, ReadsBundlesInOrder) {
    const auto messages = decode(bundle({set_pan, bundle({"/b\0\0,\0\0\0"s}), set_pan}));
    ASSERT_TRUE(messages.ok()) << messages.error().message;
    ASSERT_EQ(messages.value().size(), 3U);
    EXPECT_EQ(messages.value()[1].path, "/b");
    EXPECT_TRUE(decode(bundle({})).value().empty());
}

TEST(OscMessage, RefusesWhatIsMalformed) {
    const std::vector<std::string> wrong{""s,
                                         "abc"s,
                                         "abcd"s,
                                         "/abc"s,
                                         "/a\0\0,s\0\0"s,
                                         "/a\0\0,f\0\0\0\0"s,
                                         "/a\0\0,b\0\0\0\0\0\4"s,
                                         "/a\0\0,z\0\0"s,
                                         "#bundle\0\0\0\0\0"s,
                                         bundle({set_pan}).substr(0, 20),
                                         bundle({"/a\0"s}),
                                         bundle({""s}),
                                         "#bundle\0\0\0\0\0\0\0\0\1\xFF\xFF\xFF\xFC"s,
                                         bundle({bundle({bundle({bundle({bundle({set_pan})})})})}),
                                         bundle(std::vector<std::string>(most_osc_messages + 1, set_pan)),
                                         std::string(longest_osc_packet + 4, '\0'),
                                         "/a\0\0,N\0\0"s};
    for (const std::string& packet : wrong)
        EXPECT_FALSE(decode(packet).ok()) << testing::PrintToString(packet);
}

TEST(OscMessage, WritesWhatTheSpecificationSays) {
    const std::vector<char> packet = encode_osc({"/jawari/set", {"pan"s, 0.25}});
    EXPECT_EQ(std::string(packet.begin(), packet.end()), set_pan);
}

TEST(OscMessage, NoGarbageHarmsIt) {
    std::mt19937 random(3);
    const std::vector<std::string> seeds{set_pan, bundle({set_pan, bundle({set_pan})})};
    for (int round = 0; round < 200'000; ++round) {
        std::string packet = seeds[random() % seeds.size()];
        for (unsigned i = random() % 8; i > 0; --i)
            packet[random() % packet.size()] = static_cast<char>(random());
        packet.resize(random() % 8 == 0 ? random() % (packet.size() + 1) : packet.size());
        (void)decode(packet);
    }
}

}  // namespace
}  // namespace jawari::host
