#include "base/suggestion.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jawari::host {
namespace {

const std::vector<std::string> presets{"bass-fretted", "bass-fretless", "sitar", "biwa"};

TEST(Suggestion, DistancesAreThoseOfTextbooks) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);   // Levenshtein's example
    EXPECT_EQ(edit_distance("saturday", "sunday"), 3U);  // Wagner and Fischer's
    EXPECT_EQ(edit_distance("sitar", "sitra"), 1U);      // a swap is one slip
    EXPECT_EQ(edit_distance("ca", "abc"), 3U);           // optimal string alignment; 2 with unbounded swaps
}

TEST(Suggestion, ASlipOfTheFingerIsUnderstood) {
    EXPECT_EQ(nearest_word("sitra", presets), "sitar");
    EXPECT_EQ(nearest_word("bass-freted", presets), "bass-fretted");
    EXPECT_EQ(nearest_word("bass_fretless", presets), "bass-fretless");
    EXPECT_EQ(nearest_word("Biwa", presets), "biwa");
    EXPECT_EQ(nearest_word("bas", {"lab/fretless", "lab/bass"}), "lab/bass");
}

TEST(Suggestion, NothingIsSuggestedForWordsThatAreFarFromAll) {
    EXPECT_FALSE(nearest_word("trombone", presets));
    EXPECT_FALSE(nearest_word("", presets));
    EXPECT_FALSE(nearest_word("x", {"a", "b"}));
    EXPECT_FALSE(nearest_word(std::string(100000, 's'), presets));
    EXPECT_FALSE(nearest_word("sitar", {}));
}

TEST(Suggestion, TheNearestWordAndOfEquallyNearOnesTheFirstIsTaken) {
    EXPECT_EQ(nearest_word("cart", {"cat", "cast", "car"}), "cat");
    EXPECT_EQ(nearest_word("bass-fretles", presets), "bass-fretless");
}

TEST(Suggestion, TextsFollowTheWordOfAMessageAndStayOnItsLine) {
    EXPECT_EQ(did_you_mean("sitra", presets), "; did you mean \"sitar\"?");
    EXPECT_EQ(did_you_mean("trombone", presets), "");
    EXPECT_EQ(did_you_mean("sitr", {"sit\nr"}), "; did you mean \"sit\\x0ar\"?");
}

}  // namespace
}  // namespace jawari::host
