// Tunings against closed forms and values computed by hand.
#include "formats/tuning/tuning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

KeyFrequencies tuned(const std::string& scale, const std::string& map = "") {
    const KeyboardMap keys = map.empty() ? KeyboardMap{} : parse_keyboard_map(map).value();
    return tune(parse_scale(scale).value(), keys).value();
}

double cents(double frequency, double reference) {
    return 1200 * std::log2(frequency / reference);
}

const std::string just_major = "just\n7\n9/8\n5/4\n4/3\n3/2\n5/3\n15/8\n2/1\n";
const std::string white_keys = "12\n0\n127\n60\n69\n440.0\n7\n0\nx\n1\nx\n2\n3\nx\n4\nx\n5\nx\n6\n";

TEST(Tuning, TwelveEqualStepsAreTheOrdinaryKeyboard) {
    std::string scale = "12-TET\n12\n";
    for (int step = 1; step <= 12; ++step) scale += std::to_string(100 * step) + ".0\n";
    const auto by_default = tuned(scale);
    const auto from_a = tuned(scale, "0\n0\n127\n60\n69\n440.0\n0\n");
    for (int key = 0; key < 128; ++key) {
        const double expected = 440 * std::pow(2.0, (key - 69) / 12.0);
        EXPECT_NEAR(by_default[static_cast<std::size_t>(key)] / expected, 1, 1e-14) << key;
        EXPECT_NEAR(from_a[static_cast<std::size_t>(key)] / expected, 1, 1e-14) << key;
    }
    EXPECT_EQ(from_a[69], 440.0);
}

TEST(Tuning, QuarterCommaMeantone) {
    // Aaron 1523: fifths of 5^(1/4); the scale's cents are rounded to 1e-5.
    const auto keys = tuned(
        "1/4-comma "
        "meantone\n12\n76.04900\n193.15686\n310.26471\n5/4\n503.42157\n579.47057\n696.57843\n25/16\n"
        "889.73529\n1006.84314\n1082.89214\n2/1\n");
    const double fifth = std::pow(5.0, 0.25);
    const double expected[] = {1,
                               std::pow(fifth, 7) / 16,
                               fifth * fifth / 2,
                               4 / std::pow(fifth, 3),
                               5.0 / 4,
                               2 / fifth,
                               std::pow(fifth, 6) / 8,
                               fifth,
                               25.0 / 16,
                               std::pow(fifth, 3) / 2,
                               4 / (fifth * fifth),
                               std::pow(fifth, 5) / 4,
                               2};
    for (std::size_t degree = 0; degree <= 12; ++degree) {
        EXPECT_NEAR(cents(keys[60 + degree], keys[60]), cents(expected[degree], 1), 1e-5) << degree;
        EXPECT_NEAR(cents(keys[48 + degree], keys[60]), cents(expected[degree], 2), 1e-5) << degree;
    }
    EXPECT_NEAR(keys[60], 261.6255653005986, 1e-12);
}

TEST(Tuning, BohlenPierceRepeatsAtTheTwelfth) {
    const auto keys = tuned(
        "Bohlen-Pierce, "
        "just\n13\n27/25\n25/21\n9/7\n7/5\n75/49\n5/3\n9/5\n49/25\n15/7\n7/3\n63/25\n25/9\n3/1\n");
    EXPECT_NEAR(keys[73] / keys[60], 3, 1e-14);
    EXPECT_NEAR(keys[86] / keys[60], 9, 1e-13);
    EXPECT_NEAR(keys[47] / keys[60], 1.0 / 3, 1e-15);
    EXPECT_NEAR(keys[66] / keys[60], 5.0 / 3, 1e-14);
    EXPECT_NEAR(keys[53] / keys[60], 5.0 / 9, 1e-14);
}

TEST(Tuning, SevenNotesOnTheWhiteKeys) {
    const auto keys = tuned(just_major, white_keys);
    EXPECT_EQ(keys[69], 440.0);
    EXPECT_NEAR(keys[60], 264.0, 1e-12);  // A is 5/3 above C
    EXPECT_NEAR(keys[67], 396.0, 1e-12);
    EXPECT_NEAR(keys[72], 528.0, 1e-12);
    EXPECT_NEAR(keys[59], 247.5, 1e-12);  // 15/8 of the C below
    EXPECT_NEAR(keys[36], 66.0, 1e-12);
    for (const std::size_t black : {1U, 61U, 63U, 66U, 68U, 70U, 126U}) EXPECT_TRUE(std::isnan(keys[black]));
}

TEST(Tuning, TheFormalOctaveIsTheDistanceOfThePatterns) {
    // Two keys a pattern on degrees 0 and 4 (3/2), patterns a fifth (degree 4) apart: each key rises or
    // stays.
    const auto keys = tuned(just_major, "2\n0\n127\n60\n60\n100\n4\n0\n4\n");
    EXPECT_NEAR(keys[61], 150, 1e-12);
    EXPECT_NEAR(keys[62], 150, 1e-12);
    EXPECT_NEAR(keys[63], 225, 1e-12);
    EXPECT_NEAR(keys[59], 100, 1e-12);
    EXPECT_NEAR(keys[58], 100 / 1.5, 1e-12);
    // 0 stands for the scale's last degree.
    EXPECT_NEAR(tuned(just_major, "2\n0\n127\n60\n60\n100\n0\n0\n4\n")[62], 200, 1e-12);
    // A formal octave beyond the scale goes on repeating it: degree 8 is 2 x 9/8.
    EXPECT_NEAR(tuned(just_major, "2\n0\n127\n60\n60\n100\n8\n0\n4\n")[62], 225, 1e-12);
}

TEST(Tuning, KeysOutsideTheRangeKeepEqualTemperament) {
    const auto keys = tuned(just_major, "0\n48\n72\n60\n60\n300\n0\n");
    EXPECT_NEAR(keys[47], 440 * std::pow(2.0, -22 / 12.0), 1e-12);
    EXPECT_NEAR(keys[73], 440 * std::pow(2.0, 4 / 12.0), 1e-12);
    EXPECT_NEAR(keys[61], 337.5, 1e-12);
    EXPECT_NEAR(keys[67], 600, 1e-12);
}

TEST(Tuning, KeysBeyondAllHearingAreSilent) {
    const auto keys = tuned("four octaves a key\n1\n16/1\n");
    EXPECT_NEAR(keys[61] / keys[60], 16, 1e-13);
    EXPECT_TRUE(std::isnan(keys[62]));   // 67 kHz
    EXPECT_FALSE(std::isnan(keys[58]));  // 1.02 Hz
    EXPECT_TRUE(std::isnan(keys[57]));   // 0.06 Hz
}

TEST(Tuning, ASilentReferenceKeyIsRefused) {
    const auto result = tune(parse_scale(just_major).value(),
                             parse_keyboard_map("2\n0\n127\n60\n61\n440\n7\n0\nx\n").value());
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.failure().line().find("reference key: 61"), std::string::npos);
}

TEST(Tuning, FilesAreNamedInMessages) {
    const test::TemporaryFolder folder;
    const std::string scale = folder.write("just.scl", just_major);
    const std::string map = folder.write("white.kbm", white_keys);
    EXPECT_EQ(load_tuning(scale, map).value()[69], 440.0);
    const auto bad = load_tuning(folder.write("bad.scl", "x\n1\n0/1\n"), map);
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().kind, ErrorKind::InvalidInput);
    EXPECT_NE(bad.error().message.find("bad.scl: line 3: \"0/1\""), std::string::npos);
    EXPECT_EQ(load_tuning(scale, folder.file("none.kbm")).error().kind, ErrorKind::File);
    const auto bad_map = load_tuning(scale, folder.write("bad.kbm", "2\n0\n127\n60\n61\n440\n7\n0\nx\n"));
    EXPECT_NE(bad_map.error().message.find("bad.kbm: reference key: 61"), std::string::npos);
}

}  // namespace
}  // namespace jawari::host
