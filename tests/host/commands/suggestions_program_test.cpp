// "Did you mean": wherever the program refuses a name, it says which one is near.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

struct Refused {
    std::vector<std::string> arguments;
    int exit_code;
    std::string says;
};

TEST(Suggestions, EveryNameThatIsRefusedComesWithTheNearestOne) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("s.json", R"({"schema": "jawari.scene/1", "duration": 1})");
    const std::string law =
        folder.write("l.json", R"({"schema": "jawari.scene/1", "duration_s": 1, "law": "singorini"})");
    const std::string map = folder.write(
        "m.json",
        R"({"schema": "jawari.midi-map/1", "bindings": [{"controller": 3, "parameter": "palm_mut"}]})");
    const std::string midi = folder.write("x.mid", "");
    const std::vector<Refused> cases{
        {{"rendr", "x.mid"},
         2,
         "rendr: unknown command; did you mean \"render\"? (allowed: simulate, render, "},
        {{"render", "x.mid", "--ouput", "y.wav"},
         2,
         "--ouput: unknown option; did you mean \"--out\"? See jawari"},
        {{"render", "x.mid", "-o", "y.wav", "--temop=90"},
         2,
         "--temop: unknown option; did you mean \"--tempo\"?"},
        {{"simulate", "fretles"},
         4,
         "no built-in scene of that name; did you mean \"lab/fretless\"? (built-in: "},
        {{"simulate", "lab/bass", "--law", "signorni"},
         2,
         "signorni; did you mean \"signorini\"? (allowed: "},
        {{"simulate", "lab/bass", "--no-skip", "slep"}, 2, "slep; did you mean \"sleep\"? (allowed: "},
        {{"simulate", scene}, 3, "duration: unknown key; did you mean \"duration_s\"? (allowed: schema, "},
        {{"simulate", law}, 3, "law: \"singorini\"; did you mean \"signorini\"? (allowed: \"newton\", "},
        {{"info", "sitra"}, 4, "no preset of that name; did you mean \"sitar\"? (presets: "},
        {{"render", midi, "-o", folder.file("y.wav"), "--preset", "bass_slap"},
         4,
         "did you mean \"bass-slap\"?"},
        {{"render", midi, "-o", folder.file("y.wav"), "--set", "plam_mute=1"},
         2,
         "plam_mute=1; did you mean \"palm_mute\"? (allowed: "},
        {{"render", midi, "-o", folder.file("y.wav"), "--midi-map", map},
         3,
         "bindings[0].parameter: \"palm_mut\"; did you mean \"palm_mute\"? (allowed: "}};
    for (const Refused& each : cases) {
        const Ran ran = jawari(each.arguments);
        EXPECT_EQ(ran.exit_code, each.exit_code) << ran.err;
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find(each.says), std::string::npos) << ran.err << each.says;
    }
}

TEST(Suggestions, NamesThatAreFarFromAllGetNone) {
    for (const auto& arguments : std::vector<std::vector<std::string>>{
             {"render", "x.mid", "-o", "y.wav", "--frobnicate"}, {"info", "trombone"}, {"play-the-fool"}}) {
        const Ran ran = jawari(arguments);
        EXPECT_NE(ran.exit_code, 0);
        EXPECT_EQ(ran.err.find("did you mean"), std::string::npos) << ran.err;
    }
}

}  // namespace
}  // namespace jawari::host
