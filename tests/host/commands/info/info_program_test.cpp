// `jawari presets` and `jawari info`.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/info/survey.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

TEST(Presets, TheListNamesBuiltInPresets) {
    const Ran text = jawari({"presets"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_NE(text.out.find("bass-fretted"), std::string::npos);
    const Ran json = jawari({"presets", "--json"});
    const auto list = nlohmann::json::parse(json.out);
    EXPECT_EQ(list["schema"], "jawari.presets/1");
    bool found = false;
    for (const auto& preset : list["presets"]) {
        if (preset["preset"] != "bass-fretted") continue;
        found = true;
        EXPECT_EQ(preset["strings"], 4);
        EXPECT_EQ(preset["program"], 0);
        EXPECT_TRUE(preset["problem"].is_null());
    }
    EXPECT_TRUE(found);
}

TEST(Presets, FoldersOfTheUserAreListedWithTheirProblems) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.file("c/jawari/presets"));
    folder.write("c/jawari/presets/mine.json", "{");
    const Ran ran =
        run({"/usr/bin/env", "XDG_CONFIG_HOME=" + folder.file("c"), JAWARI_PROGRAM, "presets", "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    bool found = false;
    const auto list = nlohmann::json::parse(ran.out);
    for (const auto& preset : list["presets"]) {
        if (preset["preset"] != "mine") continue;
        found = true;
        EXPECT_EQ(preset["origin"], "user configuration");
        EXPECT_EQ(preset["path"], folder.file("c/jawari/presets/mine.json"));
        EXPECT_TRUE(preset["problem"].is_string());
    }
    EXPECT_TRUE(found);
}

TEST(Info, SaysWhatTheBassIs) {
    const Ran ran = jawari({"info", "bass-fretted", "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto info = nlohmann::json::parse(ran.out);
    EXPECT_EQ(info["schema"], "jawari.preset-info/1");
    ASSERT_EQ(info["strings"].size(), 4U);
    const auto& g = info["strings"][3];
    EXPECT_EQ(g["open_note_name"], "G2");
    EXPECT_EQ(g["highest_note"], 63);
    EXPECT_EQ(g["frets"], 20);
    // T = mu (2 L f)^2 with 6.7 g/m, 0.863 m, 97.9989 Hz: 191.69 N; stiffness takes B = 0.0035 %.
    EXPECT_NEAR(g["tension_N"].get<double>(), 191.6828, 0.001);
    // f_k = k f_0 sqrt(1 + B k^2) stays below 80 kHz up to mode 352.
    EXPECT_EQ(g["modes"], 352);
    EXPECT_EQ(info["cost"]["stopped_strings"], 4 * 21);
    EXPECT_GT(info["cost"]["cpu_all_strings"], 0);
    EXPECT_GT(info["parameters"].size(), 15U);
    const Ran text = jawari({"info", "bass-fretted"});
    for (const char* word : {"Fretted bass", "G2", "finger", "palm_mute", "cost"})
        EXPECT_NE(text.out.find(word), std::string::npos) << word;
}

TEST(Info, FailuresAreOneLine) {
    const Ran missing = jawari({"info", "no-such"});
    EXPECT_EQ(missing.exit_code, 4);
    EXPECT_EQ(missing.error_lines(), 1);
    EXPECT_EQ(jawari({"info"}).exit_code, 2);
    EXPECT_EQ(jawari({"info", "bass-fretted", "--rate", "1"}).exit_code, 2);
}

TEST(Info, NoteNames) {
    EXPECT_EQ(note_name(60), "C4");
    EXPECT_EQ(note_name(69), "A4");
    EXPECT_EQ(note_name(0), "C-1");
    EXPECT_EQ(note_name(127), "G9");
}

}  // namespace
}  // namespace jawari::host
