#include "base/text.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

namespace jawari::host {
namespace {

double random_double(std::mt19937_64& source) {
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-300, 300);
    return std::ldexp(mantissa(source), exponent(source));
}

TEST(Text, NumbersReadBackAsTheSameDouble) {
    std::mt19937_64 source(1);
    for (int i = 0; i < 20000; ++i) {
        const double value = random_double(source);
        EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
        EXPECT_EQ(std::strtod(seventeen_digits(value).c_str(), nullptr), value);
    }
}

TEST(Text, SeventeenDigitsAreThoseOfTheCLibrary) {
    std::mt19937_64 source(2);
    for (int i = 0; i < 20000; ++i) {
        const double value = random_double(source);
        std::array<char, 64> expected{};
        std::snprintf(expected.data(), expected.size(), "%.17g", value);
        EXPECT_EQ(seventeen_digits(value), expected.data());
    }
}

TEST(Text, TimesAreSecondsOrHaveColons) {
    EXPECT_EQ(parse_time("0"), 0);
    EXPECT_EQ(parse_time("90.5"), 90.5);
    EXPECT_EQ(parse_time("1:30.5"), 90.5);
    EXPECT_EQ(parse_time("0:05"), 5);
    EXPECT_EQ(parse_time("90:00"), 5400);
    EXPECT_EQ(parse_time("1:02:03.25"), 3723.25);
    for (const char* bad : {"", ":", "1:", ":30", "-1", "-0", "nan", "inf", "1:60", "1:60:00", "1.5:00",
                            "1:-5", "1:2:3:4", "1: 30", "1h", "1::2", "inf:00"})
        EXPECT_FALSE(parse_time(bad)) << bad;
}

TEST(Text, RatesAreWrittenWithoutExponent) {
    EXPECT_EQ(shortest(2e6), "2000000");
    EXPECT_EQ(shortest(0.0863), "0.0863");
    EXPECT_EQ(shortest(-0.002335), "-0.002335");
    EXPECT_EQ(shortest(1e300), "1e+300");
    EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Text, ParseNumberTakesWholeNumbersOnly) {
    EXPECT_EQ(parse_number("1e-3"), 0.001);
    EXPECT_EQ(parse_number("+2"), 2.0);
    for (const char* wrong : {"", "abc", "1x", " 1", "1 ", "++1", "+", "0x10", "1,5"})
        EXPECT_FALSE(parse_number(wrong)) << wrong;
}

TEST(Text, ForeignTextStaysOnOneLine) {
    EXPECT_EQ(printable("a\nb\x1b[2J\x7f"), "a\\x0ab\\x1b[2J\\x7f");
    EXPECT_EQ(in_quotes("ok"), "\"ok\"");
    // Shortened between characters, never inside one: each of these is two bytes.
    EXPECT_EQ(in_quotes("ääää", 5), "\"ää...\"");
}

TEST(Text, JoinAndLowerCase) {
    EXPECT_EQ(join({"a", "b"}, "|"), "a|b");
    EXPECT_EQ(join({}), "");
    EXPECT_EQ(lower_case("OUT.Csv"), "out.csv");
}

}  // namespace
}  // namespace jawari::host
