// What is left on the disk by a program that was killed, ran out of room, or may not write there.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <random>
#include <string>

#include "support/midi_bytes.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

constexpr const char* old_content = "what was there before";

std::string short_song() {
    Bytes track;  // a tick is a millisecond
    append_event(track, 0, {0x90, 31, 100});
    append_event(track, 200, {31, 0});
    append_event(track, 0, end_of_track);
    const Bytes file = file_with_track(track, 500);
    return {file.begin(), file.end()};
}

std::vector<std::string> render_command(const TemporaryFolder& folder) {
    return {"render", folder.file("in.mid"),  "--preset",   "bass-fretted", "--tail", "0.2",
            "-o",     folder.file("out.wav"), "--overwrite"};
}

/// Names that the program may leave behind when it is killed (docs/commands/exit-codes.md).
bool is_temporary(const std::string& name) {
    return name.starts_with(".jawari-") && name.size() == std::string(".jawari-XXXXXX").size();
}

TEST(KilledProgram, LeavesTheOldFileOrTheWholeNewOne) {
    const TemporaryFolder whole;
    whole.write("in.mid", short_song());
    ASSERT_EQ(jawari(render_command(whole)).exit_code, 0);
    const std::string expected = read_text(whole.file("out.wav"));
    ASSERT_GT(expected.size(), 1000U);

    std::mt19937 random(1);
    std::size_t killed = 0, temporaries = 0;
    for (int i = 0; i < 60; ++i) {
        const TemporaryFolder folder;
        folder.write("in.mid", short_song());
        if (i % 2 == 0) folder.write("out.wav", old_content);
        // Some at any moment; most from the moment on at which it begins to write, soon or late.
        const auto writes = [&] {
            const auto names = folder.names();
            return i % 4 == 0 || std::any_of(names.begin(), names.end(), is_temporary);
        };
        const unsigned longest_us = i % 4 == 0 ? 100000 : 1U << (i % 14);
        const Ran ran =
            jawari(render_command(folder), {.signal = SIGKILL,
                                            .signal_when = writes,
                                            .signal_after_us = static_cast<unsigned>(random() % longest_us)});
        if (ran.exit_code == 1000 + SIGKILL) killed += 1;
        bool there = false;
        for (const std::string& name : folder.names()) {
            if (name == "out.wav") there = true;
            if (is_temporary(name)) temporaries += 1;
            EXPECT_TRUE(name == "in.mid" || name == "out.wav" || is_temporary(name)) << name;
        }
        const std::string found = read_text(folder.file("out.wav"));
        if (i % 2 == 0) {
            EXPECT_TRUE(found == old_content || found == expected) << found.size() << " bytes";
        } else if (there) {
            EXPECT_EQ(found, expected);
        }
        if (ran.exit_code == 0) {
            EXPECT_EQ(found, expected);
        }
    }
    EXPECT_GT(killed, 0U);
    EXPECT_GT(temporaries, 0U);  // some were killed while they wrote
}

TEST(FullDisk, KeepsTheOldFilesOfMixStemsAndStatistics) {
    for (const std::uint64_t room : {0U, 1U, 43U, 44U, 1000U, 20000U}) {
        const TemporaryFolder folder;
        folder.write("in.mid", short_song());
        for (const char* name : {"out.wav", "stems.wav", "stats.json"}) folder.write(name, old_content);
        auto command = render_command(folder);
        for (const std::string& more : {std::string("--stems"), folder.file("stems.wav"),
                                        std::string("--stats"), folder.file("stats.json")})
            command.push_back(more);
        const Ran ran = jawari(command, {.largest_file_bytes = room + 1});
        EXPECT_EQ(ran.exit_code, 4) << ran.err;
        EXPECT_EQ(folder.names().size(), 4U) << room;
        for (const char* name : {"out.wav", "stems.wav", "stats.json"})
            EXPECT_EQ(read_text(folder.file(name)), old_content) << name << ", room for " << room;
    }
}

TEST(ReadOnly, FoldersAndFilesStayAsTheyAre) {
    const TemporaryFolder folder;
    folder.write("in.mid", short_song());
    folder.write("out.wav", old_content);
    chmod(folder.file("in.mid").c_str(), 0444);
    chmod(folder.file("out.wav").c_str(), 0444);
    const auto as_nobody = [&](mode_t mode) {
        chmod(folder.file("").c_str(), mode);
        auto command = render_command(folder);
        command[3] =
            JAWARI_SOURCE_DIR "/presets/instruments/bass-fretted.json";  // root's own folders are shut
        return jawari(command, {.as_nobody = true});
    };
    const Ran first = as_nobody(0555);
    if (first.exit_code == 127 || first.err.find("bass-fretted.json") != std::string::npos)
        GTEST_SKIP() << "the program and its sources are where only root may read them";
    for (const mode_t mode : {0555U, 0777U}) {  // the folder; the file in it
        const Ran ran = as_nobody(mode);
        EXPECT_EQ(ran.exit_code, 4);
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find("out.wav: Permission denied"), std::string::npos) << ran.err;
        EXPECT_EQ(read_text(folder.file("out.wav")), old_content);
        EXPECT_EQ(folder.names().size(), 2U);
    }
    unlink(folder.file("out.wav").c_str());
    EXPECT_EQ(as_nobody(0555).exit_code, 4);
    EXPECT_EQ(folder.names().size(), 1U);
    chmod(folder.file("").c_str(), 0700);
}

}  // namespace
}  // namespace jawari::host
