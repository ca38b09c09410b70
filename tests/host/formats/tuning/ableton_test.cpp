#include "formats/tuning/ableton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formats/tuning/tuning.h"

namespace jawari::host {
namespace {

std::string equal_steps(int notes, const std::string& lines) {
    std::string text = "equal steps\n" + std::to_string(notes) + "\n";
    for (int note = 1; note <= notes; ++note) text += std::to_string(1200.0 * note / notes) + "\n";
    return text + lines;
}

Result<KeyFrequencies> tuned(const std::string& text) {
    const Scale scale = parse_scale(text).value();
    const auto lines = parse_ableton_lines(text, scale);
    if (!lines) return lines.failure();
    return tune(scale, lines.value());
}

std::string refusal(const std::string& text) {
    const auto keys = tuned(text);
    return keys ? "" : keys.failure().line();
}

TEST(Ableton, TheReferenceOfTheSpecificationIsConcertPitch) {
    const auto keys = tuned(equal_steps(12, "! @ABL REFERENCE_PITCH 4 9 440.0\n")).value();
    for (int key = 0; key < 128; ++key)
        EXPECT_NEAR(keys[static_cast<std::size_t>(key)] / (440 * std::exp2((key - 69) / 12.0)), 1, 1e-6)
            << key;
    EXPECT_EQ(keys[69], 440);
}

TEST(Ableton, TheReferenceMovesAllKeys) {
    const auto keys = tuned(equal_steps(12, "! @ABL REFERENCE_PITCH 4 9 432\n")).value();
    EXPECT_EQ(keys[69], 432);
    EXPECT_NEAR(keys[57], 216, 1e-3);
}

TEST(Ableton, TheNoteNearestToMiddleCLiesOnItsKey) {
    // 24 steps an octave: the reference is 18 steps above a note at 440 2^(-18/24) = 261.63 Hz.
    const auto quarter = tuned(equal_steps(24, "! @ABL REFERENCE_PITCH 3 18 440\n")).value();
    EXPECT_NEAR(quarter[60], 261.6256, 1e-3);
    EXPECT_EQ(quarter[78], 440);
    // Five steps an octave from 300 Hz down: 300, 261.17, ...: the second is the nearest.
    const auto five = tuned(equal_steps(5, "! @ABL REFERENCE_PITCH 4 0 300\n")).value();
    EXPECT_NEAR(five[60], 300 * std::exp2(-0.2), 1e-4);
    EXPECT_EQ(five[61], 300);
}

TEST(Ableton, KeysOutsideTheRangeOfFrequenciesAreSilent) {
    const auto keys =
        tuned(equal_steps(12, "! @ABL REFERENCE_PITCH 4 9 440\n! @ABL NOTE_RANGE_BY_FREQUENCY 200 441\n"))
            .value();
    EXPECT_TRUE(std::isnan(keys[55]));  // 196.0 Hz
    EXPECT_FALSE(std::isnan(keys[56]));
    EXPECT_FALSE(std::isnan(keys[69]));
    EXPECT_TRUE(std::isnan(keys[70]));
    const auto open = tuned(equal_steps(12, "! @ABL NOTE_RANGE_BY_FREQUENCY 200\n")).value();
    EXPECT_TRUE(std::isnan(open[55]));
    EXPECT_FALSE(std::isnan(open[127]));
}

TEST(Ableton, KeysOutsideTheRangeOfIndicesAreSilent) {
    const auto keys = tuned(equal_steps(12,
                                        "! @ABL REFERENCE_PITCH 4 9 440\n"
                                        "! @ABL NOTE_RANGE_BY_INDEX 3 0 5 11\n"))
                          .value();
    EXPECT_TRUE(std::isnan(keys[47]));
    EXPECT_FALSE(std::isnan(keys[48]));
    EXPECT_FALSE(std::isnan(keys[83]));
    EXPECT_TRUE(std::isnan(keys[84]));
}

TEST(Ableton, WhatChangesNoPitchIsLeftOut) {
    const std::string lines =
        "! @ABL NOTE_NAMES C \"C sharp\" D\n! @ABL SOURCE \"a book\"\n! @ABL LINK https://example.org\n"
        "!! @ABL REFERENCE_PITCH 4 0 1\n! a comment that names @ABL\n";
    const auto with = tuned(equal_steps(3, lines)).value(), without = tuned(equal_steps(3, "")).value();
    for (std::size_t key = 0; key < midi_keys; ++key)
        EXPECT_TRUE(with[key] == without[key] || (std::isnan(with[key]) && std::isnan(without[key]))) << key;
}

TEST(Ableton, MistakesAreRefusedWithTheirLine) {
    const std::string reference = "! @ABL REFERENCE_PITCH 4 0 440\n";
    const std::pair<std::string, std::string> wrong[] = {
        {"! @ABL REFERENCE_PITCH 4 2 440\n",
         "line 5: \"REFERENCE_PITCH 4 2 440\" (allowed: REFERENCE_PITCH OCTAVE"},
        {"! @ABL REFERENCE_PITCH 4 0\n", "line 5: "},
        {"! @ABL REFERENCE_PITCH 9 0 440\n", "-2 to 8"},
        {"! @ABL REFERENCE_PITCH 4 0 nan\n", "line 5: "},
        {"! @ABL REFERENCE_PITCH 4 0 0\n", "line 5: "},
        {reference + reference, "line 6: \"REFERENCE_PITCH 4 0 440\" (allowed: one REFERENCE_PITCH)"},
        {"! @ABL NOTE_RANGE_BY_INDEX 0 0\n", "after REFERENCE_PITCH"},
        {reference + "! @ABL NOTE_RANGE_BY_INDEX 5 0 4 1\n", "line 6: "},
        {"! @ABL NOTE_RANGE_BY_FREQUENCY 400 100\n", "line 5: "},
        {reference + "! @ABL NOTE_RANGE_BY_FREQUENCY 10 20\n! @ABL NOTE_RANGE_BY_INDEX 4 0\n",
         "the only range"},
        {"! @ABL REFERENCE_PICH 4 0 440\n", "\"REFERENCE_PICH\"; did you mean \"REFERENCE_PITCH\"?"},
        {"! @ABL\n", "line 5: \"\""}};
    for (const auto& [lines, text] : wrong)
        EXPECT_NE(refusal(equal_steps(2, lines)).find(text), std::string::npos)
            << refusal(equal_steps(2, lines)) << " / " << text;
    EXPECT_NE(
        refusal("falls\n1\n-100.0\n! @ABL REFERENCE_PITCH 4 0 440\n").find("does not repeat above itself"),
        std::string::npos);
}

}  // namespace
}  // namespace jawari::host
