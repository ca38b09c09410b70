#include "formats/tuning/keyboard_map.h"

#include <gtest/gtest.h>

#include <string>

namespace jawari::host {
namespace {

const std::string header = "! Size\n3\n! First\n0\n127\n60\n69\n440.0\n7\n";

std::string failure_of(const std::string& text) {
    const auto map = parse_keyboard_map(text);
    return map.ok() ? "accepted" : map.failure().line();
}

TEST(KeyboardMap, EveryValueIsRead) {
    const auto map = parse_keyboard_map("2\n5\n120\n61\n70\n452.5 Hz\n19\n x\n-3 low\n");
    ASSERT_TRUE(map.ok());
    EXPECT_EQ(map.value().first_key, 5);
    EXPECT_EQ(map.value().last_key, 120);
    EXPECT_EQ(map.value().middle_key, 61);
    EXPECT_EQ(map.value().reference_key, 70);
    EXPECT_EQ(map.value().reference_hz, 452.5);
    EXPECT_EQ(map.value().formal_octave, 19);
    ASSERT_EQ(map.value().degrees.size(), 2U);
    EXPECT_FALSE(map.value().degrees[0]);
    EXPECT_EQ(map.value().degrees[1], -3);
}

TEST(KeyboardMap, UnmappedKeysAtTheEndMayBeLeftOut) {
    for (const std::string end : {"0\n", "0\nx\n", "0\nx\nX\n", "0\n\n"}) {
        const auto map = parse_keyboard_map(header + end);
        ASSERT_TRUE(map.ok()) << end << map.failure().line();
        ASSERT_EQ(map.value().degrees.size(), 3U);
        EXPECT_EQ(map.value().degrees[0], 0);
        EXPECT_FALSE(map.value().degrees[1]);
        EXPECT_FALSE(map.value().degrees[2]);
    }
}

TEST(KeyboardMap, EachFaultIsNamedWithItsLine) {
    EXPECT_NE(failure_of("").find("end of file: no size of the map"), std::string::npos);
    EXPECT_NE(failure_of("3\n0\n127\n60\n69\n").find("no frequency of the reference key"), std::string::npos);
    EXPECT_NE(failure_of("-1\n").find("line 1: \"-1\""), std::string::npos);
    EXPECT_NE(failure_of("0\n128\n").find("line 2: \"128\" (allowed: first key to retune, 0 to 127)"),
              std::string::npos);
    EXPECT_NE(failure_of("0\n60\n59\n60\n69\n440.\n12\n").find("line 3: \"59\""), std::string::npos);
    EXPECT_NE(failure_of("0\n0\n127\n60\n69\nnan\n12\n").find("line 6: \"nan\""), std::string::npos);
    EXPECT_NE(failure_of("0\n0\n127\n60\n69\n0\n12\n").find("line 6:"), std::string::npos);
    EXPECT_NE(failure_of("0\n0\n127\n60\n69\n440\n12.5\n").find("line 7:"), std::string::npos);
    EXPECT_NE(failure_of(header + "0\ny\n").find("line 11: \"y\""), std::string::npos);
    EXPECT_NE(failure_of(header + "0\n\n2\n").find("line 11: \"\""), std::string::npos);
    EXPECT_NE(failure_of(header + "0\n1\n2\n3\n").find("line 13: \"3\" (allowed: nothing"),
              std::string::npos);
    EXPECT_NE(failure_of(header + "99999\n").find("line 10:"), std::string::npos);
}

}  // namespace
}  // namespace jawari::host
