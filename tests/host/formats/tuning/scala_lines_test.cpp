#include "formats/tuning/scala_lines.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(ScalaLines, CommentsAreLeftOutAndLinesKeepTheirNumbers) {
    const auto lines = scala_lines("! one\n two\n\n!four\nfive");
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].number, 2U);
    EXPECT_EQ(lines[0].text, " two");
    EXPECT_EQ(lines[1].number, 3U);
    EXPECT_EQ(lines[1].text, "");
    EXPECT_EQ(lines[2].number, 5U);
    EXPECT_EQ(lines[2].text, "five");
}

TEST(ScalaLines, EveryKindOfLineEndAndAByteOrderMark) {
    for (const char* text : {"a\nb\n", "a\r\nb\r\n", "a\rb\r",
                             "\xef\xbb\xbf"
                             "a\nb"}) {
        const auto lines = scala_lines(text);
        ASSERT_EQ(lines.size(), 2U) << text;
        EXPECT_EQ(lines[0].text, "a");
        EXPECT_EQ(lines[1].text, "b");
        EXPECT_EQ(lines[1].number, 2U);
    }
    EXPECT_TRUE(scala_lines("").empty());
}

TEST(ScalaLines, WordsAndWholeNumbers) {
    EXPECT_EQ(first_word(" \t5/4  E"), "5/4");
    EXPECT_EQ(first_word("  "), "");
    EXPECT_EQ(trimmed("\t a b "), "a b");
    EXPECT_EQ(whole_number("-12"), -12);
    EXPECT_EQ(whole_number("999999999999999999"), 999999999999999999);
    for (const char* text : {"", "-", "1.", "+1", "1e3", "0x1", "1000000000000000000000"})
        EXPECT_FALSE(whole_number(text)) << text;
}

}  // namespace
}  // namespace jawari::host
