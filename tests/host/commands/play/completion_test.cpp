#include "commands/play/completion.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

std::vector<std::string> presets() {
    return {"sitar", "bass-slap", "bass-fretted"};
}

using Words = std::vector<std::string>;

TEST(Completion, OffersWhatMayStandThere) {
    EXPECT_EQ(completions("pre", presets), (Words{"preset", "presets"}));
    EXPECT_EQ(completions("preset ", presets), (Words{"bass-fretted", "bass-slap", "sitar"}));
    EXPECT_EQ(completions("preset bass", presets), (Words{"bass-fretted", "bass-slap"}));
    EXPECT_EQ(completions("set vol", presets), (Words{"volume"}));
    EXPECT_EQ(completions("monitor o", presets), (Words{"off", "on"}));
    EXPECT_EQ(completions("help qu", presets), (Words{"quit"}));
    for (const char* nothing : {"set volume ", "panic ", "bogus ", "preset x y", "record start ", "\"open "})
        EXPECT_TRUE(completions(nothing, presets).empty()) << nothing;
}

TEST(Completion, CompletesAsFarAsAllAgree) {
    EXPECT_EQ(common_start({"bass-fretted", "bass-slap"}), "bass-");
    EXPECT_EQ(common_start({"on", "on"}), "on");
    EXPECT_EQ(common_start({"pan", "panic"}), "pan");
    EXPECT_EQ(common_start({"a", ""}), "");
    EXPECT_EQ(common_start({}), "");
}

}  // namespace
}  // namespace jawari::host
