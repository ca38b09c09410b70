#include "formats/tuning/tun_formulas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace jawari::host {
namespace {

/// Note n has n + 1 Hz.
NoteFrequencies counted() {
    NoteFrequencies scale{};
    for (std::size_t n = 0; n < scale.size(); ++n) scale[n] = static_cast<double>(n + 1);
    return scale;
}

NoteFrequencies after(int note, const std::string& formula) {
    NoteFrequencies scale = counted();
    const auto read = read_formula(note, formula);
    EXPECT_TRUE(read.has_value()) << formula;
    if (read) apply(*read, scale);
    return scale;
}

TEST(TunFormulas, EachOperationDoesWhatTheFormatSays) {
    EXPECT_DOUBLE_EQ(after(5, "")[5], 6);
    EXPECT_DOUBLE_EQ(after(5, "# 440")[5], 440);
    EXPECT_DOUBLE_EQ(after(5, "#=69")[5], 70);
    EXPECT_DOUBLE_EQ(after(5, "#>-3")[5], 3);
    EXPECT_DOUBLE_EQ(after(5, "#>+3")[5], 9);
    EXPECT_DOUBLE_EQ(after(5, "#=0 * 3 / 2")[5], 1.5);
    EXPECT_NEAR(after(5, "#=0 % 700")[5], std::exp2(7.0 / 12), 1e-12);
    EXPECT_DOUBLE_EQ(after(5, "+ 0.25")[5], 6.25);
    EXPECT_DOUBLE_EQ(after(5, "#=9 + =4")[5], 15);
    EXPECT_DOUBLE_EQ(after(5, "*1e+1 +>1")[5], 67);
    EXPECT_DOUBLE_EQ(after(5, "#=0 % -1200 +2")[5], 2.5);
}

TEST(TunFormulas, ALoopGoesOnFromWhatItHasChanged) {
    const auto up = after(2, "#>-1 * 2 ~3");
    EXPECT_DOUBLE_EQ(up[1], 2);
    EXPECT_DOUBLE_EQ(up[2], 4);
    EXPECT_DOUBLE_EQ(up[3], 8);
    EXPECT_DOUBLE_EQ(up[4], 16);
    EXPECT_DOUBLE_EQ(up[5], 6);
    const auto down = after(3, "#>1 / 2 ~-999");
    EXPECT_DOUBLE_EQ(down[3], 2.5);
    EXPECT_DOUBLE_EQ(down[0], 5.0 / 16);
    EXPECT_DOUBLE_EQ(after(120, "#>-1 ~999")[127], 120);
    EXPECT_DOUBLE_EQ(after(120, "#>1 ~999")[127], 128);  // no note beyond the last
}

TEST(TunFormulas, AnEnsuredFrequencyMovesTheWholeScale) {
    const auto scale = after(9, "! 440");
    for (std::size_t n = 0; n < scale.size(); ++n)
        EXPECT_NEAR(scale[n], 44.0 * static_cast<double>(n + 1), 1e-9);
}

TEST(TunFormulas, WhatIsNoneIsRefused) {
    for (const char* text :
         {"440",  "?",    "#",    "#=",    "#=128", "#=-1", "#>-6", "#>123", "+>200", "/0", "*x",
          "%nan", "%1e9", "~1e3", "~1000", "!0",    "!-5",  "!",    "#=1.5", "#>1 ~", "++", "#=0 %"})
        EXPECT_FALSE(read_formula(5, text)) << text;
}

TEST(TunFormulas, AMappingRepeatsAndStaysInTheScale) {
    TunMapping mapping;
    EXPECT_EQ(mapping.note(127), 127);
    mapping.note_of_key[3] = 100;
    EXPECT_EQ(mapping.note(3), 100);
    mapping.loop_size = 12;
    EXPECT_EQ(mapping.note(15), 112);
    EXPECT_EQ(mapping.note(123), 127);
    EXPECT_EQ(mapping.note(14), 14);
}

}  // namespace
}  // namespace jawari::host
