#include "formats/tuning/scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <cmath>
#include <string>

namespace jawari::host {
namespace {

Scale scale_of(const std::string& text) {
    const auto scale = parse_scale(text);
    EXPECT_TRUE(scale.ok()) << (scale.ok() ? "" : scale.failure().line());
    return scale.ok() ? scale.value() : Scale{};
}

std::string failure_of(const std::string& text) {
    const auto scale = parse_scale(text);
    return scale.ok() ? "accepted" : scale.failure().line();
}

TEST(Scale, ValidPitchLinesOfTheFormatsDefinition) {
    // The examples of scl_format.html; cents of the ratios with 20 digits (mpmath).
    const Scale scale = scale_of(
        "! a comment\nExamples\n 9 \n81/64\n408.0\n408.\n5\n-5.0\n10/20\n100.0 cents\n100.0 C#\n5/4   E\\\n");
    EXPECT_EQ(scale.description, "Examples");
    const double expected[] = {407.82000346154973, 408, 408, 2786.3137138648348, -5, -1200, 100, 100,
                               386.31371386483481};
    ASSERT_EQ(scale.cents.size(), std::size(expected));
    for (std::size_t i = 0; i < scale.cents.size(); ++i)
        EXPECT_NEAR(scale.cents[i], expected[i], 1e-12 * 2787) << i;
}

TEST(Scale, OctavesAreExact) {
    const Scale scale = scale_of("\n2\n2/1\n4\n");
    EXPECT_EQ(scale.description, "");
    EXPECT_EQ(scale.cents[0], 1200.0);
    EXPECT_EQ(scale.cents[1], 2400.0);
}

TEST(Scale, BlanksAroundValuesAndCommentsBetweenThem) {
    const Scale scale = scale_of("x\n\t 2 \n! half\n\t3 / 2\n   2/1   octave\n\n \n");
    ASSERT_EQ(scale.cents.size(), 2U);
    EXPECT_NEAR(scale.cents[0], 701.95500086538742, 1e-12 * 702);
}

TEST(Scale, DegreesRepeatInBothDirections) {
    const Scale scale = scale_of("x\n3\n100.\n150.\n1000.\n");
    const double expected[] = {-1900, -1850, -1000, -900, -850, 0, 100, 150, 1000, 1100, 1150, 2000};
    for (long long degree = -5; degree <= 6; ++degree)
        EXPECT_EQ(degree_cents(scale, degree), expected[degree + 5]) << degree;
    EXPECT_EQ(degree_cents(scale_of("nothing\n0\n"), 5), 0);
}

TEST(Scale, EachFaultIsNamedWithItsLine) {
    EXPECT_NE(failure_of("").find("end of file: no description"), std::string::npos);
    EXPECT_NE(failure_of("x\n").find("end of file: no number of notes"), std::string::npos);
    EXPECT_NE(failure_of("x\n-1\n").find("line 2: \"-1\" (allowed: the number of notes"), std::string::npos);
    EXPECT_NE(failure_of("x\n12 notes\n").find("line 2: \"12 notes\""), std::string::npos);
    EXPECT_NE(failure_of("x\n99999\n").find("line 2:"), std::string::npos);
    EXPECT_NE(failure_of("x\n2\n100.\n").find("end of file: no note 2"), std::string::npos);
    EXPECT_NE(failure_of("x\n1\n! c\n2/1\n3/1\n").find("line 5: \"3/1\" (allowed: nothing"),
              std::string::npos);
    for (const char* pitch : {"",      "-4/3",       "0",     "0/1",      "1/0",
                              "4/-3",  "3//2",       "3/2/1", "abc",      "1e3",
                              "1.5e3", "100.0cents", "inf",   "nan",      "nan.",
                              ".",     "1..2",       "5/4.0", "120000.5", "1/99999999999999999999x"})
        EXPECT_NE(failure_of("x\n1\n" + std::string(pitch) + "\n").find("line 3:"), std::string::npos)
            << pitch;
}

TEST(Scale, APythagoreanChainInExactRatios) {
    // Each note is n fifths of 3/2, less octaves: 1200 log2(3/2) cents each.
    std::ifstream file(JAWARI_SOURCE_DIR "/tests/data/cases/tuning/32_pyth41.scl");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto scale = parse_scale(text);
    ASSERT_TRUE(scale.ok()) << scale.failure().line();
    ASSERT_EQ(scale.value().cents.size(), 41U);
    std::vector<double> expected;
    for (int n = -41; n <= 41; ++n)
        expected.push_back(std::fmod(1200 * std::log2(1.5) * n + 1200 * 41, 1200));
    for (const double cents : scale.value().cents) {
        const bool found =
            cents == 1200 || std::any_of(expected.begin(), expected.end(),
                                         [cents](double each) { return std::abs(each - cents) < 1e-9; });
        EXPECT_TRUE(found) << cents;
    }
    EXPECT_EQ(scale.value().cents.back(), 1200);
}

TEST(Scale, PartsOfManyDigits) {
    const std::string three(300, '3'), one(300, '1');
    const auto scale = parse_scale("x\n2\n" + three + "/" + one + "\n" + three + "0/" + three + "\n");
    ASSERT_TRUE(scale.ok()) << scale.failure().line();
    EXPECT_NEAR(scale.value().cents[0], 1200 * std::log2(3.0), 1e-9);
    EXPECT_NEAR(scale.value().cents[1], 1200 * std::log2(10.0), 1e-9);
    EXPECT_FALSE(parse_scale("x\n1\n" + three + "x/1\n").ok());
    EXPECT_FALSE(parse_scale("x\n1\n" + std::string(1001, '3') + "/1\n").ok());
    EXPECT_FALSE(parse_scale("x\n1\n3/" + std::string(300, '0') + "\n").ok());
}

}  // namespace
}  // namespace jawari::host
