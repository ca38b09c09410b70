// `jawari simulate` as users run it: exit codes, one line of error, nothing left behind.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"

namespace jawari::test {
namespace {

using Arguments = std::vector<std::string>;
using Names = std::vector<std::string>;

Ran simulate(Arguments arguments, const RunOptions& options = {}) {
    arguments.insert(arguments.begin(), "simulate");
    return jawari(arguments, options);
}

void expect_one_line(const Ran& ran, int exit_code, const std::string& part) {
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
    EXPECT_EQ(ran.out, "");
}

TEST(Simulate, WrongCommandLinesAreOneLineAndExitCode2) {
    const auto refused = [](const Arguments& arguments, const std::string& part) {
        expect_one_line(jawari(arguments), 2, part);
    };
    refused({}, "subcommand is required");
    refused({"simulate"}, "SCENE is required");
    refused({"simulate", "lab/bass", "--unknown"}, "--unknown");
    refused({"simulate", "lab/bass", "--theta", "3", "--scheme", "theta"}, "--theta: 3 (allowed: 0.5 to 1)");
    refused({"simulate", "lab/bass", "--theta", "0.6"},
            "--theta: 0.6 (allowed: only together with --scheme theta)");
    refused({"simulate", "lab/bass", "--restitution", "-0.5"}, "--restitution: -0.5 (allowed: 0 to 1)");
    refused({"simulate", "lab/bass", "--restitution", "nan"}, "--restitution: nan (allowed: 0 to 1)");
    refused({"simulate", "lab/bass", "--output-rate", "fast"},
            "--output-rate: fast (allowed: 1 to 1000000000)");
    refused({"simulate", "lab/bass", "--duration", "1e9"}, "--duration: 1e9 (allowed: 0 to 86400)");
    refused({"simulate", "lab/bass", "--law", "hertz"},
            "--law: hertz (allowed: newton, paoli-schatzman, passive, signorini)");
    refused({"simulate", "lab/bass", "--start", "late"}, "--start: late (allowed: backward, exact)");
    refused({"simulate", "lab/bass", "--contact-rate", "2e6"}, "the nearest being 2007040");
    refused({"simulate", "lab/bass", "--out", "probes.txt"},
            "--out: probes.txt (allowed: a name that ends in");
    refused({"simulate", "lab/bass", "--plot", "bass.pdf"}, "--plot: bass.pdf (allowed: a name that ends in");
    refused({"simulate", "lab/bass", "--out", "-", "--stats", "-"}, "--stats: - (allowed: another name");
    refused({"simulate", "lab/bass", "--stats", "a.svg", "--plot", "a.svg"},
            "--plot: a.svg (allowed: another name than that of the other outputs, here --stats a.svg)");
    refused({"simulate", "lab/bass", "--no-skip", "flight,nothing"},
            "--no-skip: nothing (allowed: all, flight, certificate, near, lazy, sleep)");
}

TEST(Simulate, HelpAndVersionSucceed) {
    const Ran version = jawari({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_TRUE(version.out.starts_with("jawari ")) << version.out;
    const Ran help = simulate({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* part : {"--contact-rate", "Examples:", "Exit codes:", "lab/fretless"})
        EXPECT_NE(help.out.find(part), std::string::npos) << part;
}

struct BadFile {
    const char* name;
    std::string text;
    const char* message;  // after the path
};

TEST(Simulate, BadSceneFilesAreOneLineAndExitCode3) {
    const std::string valid = valid_scene;
    const std::vector<BadFile> files{
        {"missing key", replaced(valid, "\"length_m\": 0.8,", ""),
         ": strings[0].length_m: missing (allowed: "},
        {"unknown key", replaced(valid, "length_m", "lenght_m"),
         ": strings[0].lenght_m: unknown key; did you mean \"length_m\"? (allowed: name, length_m, "},
        {"wrong type", replaced(valid, "0.005", "\"thin\""),
         ": strings[0].linear_density_kg_per_m: \"thin\" (allowed: "},
        {"not a number", replaced(valid, "0.005", "NaN"), ":12:"},
        {"too large a number", replaced(valid, "0.005", "1e400"), ":12:"},
        {"negative length", replaced(valid, ": 0.8", ": -0.8"),
         ": strings[0].length_m: -0.8 (allowed: 0.001 to 1000)"},
        {"contact outside", replaced(valid, "\"position_m\": 0.5,", "\"position_m\": 0.81,"),
         ": strings[0].contacts[1].position_m: 0.81 (allowed: 0 to 0.8)"},
        {"too many modes", replaced(valid, "\"count\": 20", "\"count\": 1000000000"),
         ": strings[0].modes.count: 1000000000 (allowed: a whole number from 1 to 8192)"},
        {"broken", valid.substr(0, valid.size() / 2), ":"},
        {"empty", "", ": the file is empty"},
        {"another kind", "[1, 2]", ": document: an array of 2 (allowed: an object)"},
        {"key with control characters", "{\"schema\": \"jawari.scene/1\", \"a\\nb\\u001b\": 1}",
         ": a\\x0ab\\x1b: unknown key"},
        {"deep", std::string(100000, '['), ": arrays and objects are nested too deeply"},
        {"fret above a fitting string",
         replaced(valid, "\"contacts\": [",
                  "\"frets\": {\"count\": 3, \"height_m\": 1e400}, \"contacts\": ["),
         ":"},
    };
    const TemporaryFolder folder;
    for (const BadFile& file : files) {
        SCOPED_TRACE(file.name);
        const std::string path = folder.write("scene.json", file.text);
        expect_one_line(simulate({path, "--out", folder.file("out.csv"), "--stats", folder.file("out.json")}),
                        3, path + file.message);
        EXPECT_EQ(folder.names(), Names{"scene.json"});
    }
}

TEST(Simulate, FilesThatCannotBeReadOrWrittenAreExitCode4) {
    const TemporaryFolder folder;
    folder.write("file", "");
    const std::string scene = folder.write("scene.json", valid_scene);
    const auto refused = [&](const Arguments& arguments, const std::string& part) {
        expect_one_line(simulate(arguments), 4, part);
    };
    refused({"nowhere"},
            "nowhere: no such file, and no built-in scene of that name (built-in: lab/bar, lab/bass, ");
    refused({folder.file(".")}, "Is a directory");
    refused({scene + "/x"}, "Not a directory");
    refused({scene, "--out", folder.file("no/out.csv")},
            folder.file("no/out.csv") + ": No such file or directory");
    refused({scene, "--stats", folder.file("file/out.json")},
            folder.file("file/out.json") + ": Not a directory");
    refused({scene, "--plot", folder.file("no/out.svg")},
            folder.file("no/out.svg") + ": No such file or directory");
    refused({scene, "--stats", folder.file(".")}, "Is a directory");
    refused({scene, "--stats", "/dev/full"}, "/dev/full: No space left on device");
    for (const char* name : {"full.csv", "full.h5", "full.wav"}) {
        std::filesystem::create_symlink("/dev/full", folder.file(name));
        refused({scene, "--out", folder.file(name)}, folder.file(name) + ": ");
        EXPECT_TRUE(std::filesystem::is_symlink(folder.file(name)));
    }
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(Simulate, AFullDiskLeavesNothingInAnyFormat) {
    for (const char* name : {"out.csv", "out.h5", "out.wav"})
        for (const std::uint64_t room : {1000U, 40000U, 300000U}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(room));
            const TemporaryFolder folder;
            const std::string out = folder.write(name, "old");
            const Ran ran = simulate({"lab/bass", "--duration", "2", "--contact-rate", "15680", "--out", out,
                                      "--stats", folder.file("stats.json"), "--overwrite"},
                                     {.largest_file_bytes = room});
            expect_one_line(ran, 4, out + ": File too large");
            EXPECT_EQ(read_text(out), "old");
            EXPECT_EQ(folder.names(), Names{name});
        }
}

TEST(Simulate, InterruptsLeaveNothing) {
    for (const auto& [signal, exit_code] :
         {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}, std::pair{SIGHUP, 129}})
        for (const char* name : {"out.csv", "out.h5", "out.wav"}) {
            const TemporaryFolder folder;
            const Ran ran = simulate({"lab/bass", "--duration", "1000", "--out", folder.file(name)},
                                     {.signal = signal, .signal_after_ms = 300});
            expect_one_line(ran, exit_code, "nothing was written");
            EXPECT_TRUE(folder.names().empty());
        }
}

TEST(Simulate, WithoutFilesASummaryIsPrinted) {
    const Ran ran = simulate({"lab/bass", "--duration", "0.01"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.err, "");
    for (const char* part : {"lab/bass", "862 modes, 20 contacts", "newton", "real time"})
        EXPECT_NE(ran.out.find(part), std::string::npos) << part << "\n" << ran.out;
}

TEST(Simulate, SignoriniNoticesThatRestitutionIsIgnored) {
    const TemporaryFolder folder;
    const Ran ran = simulate({"lab/bass", "--duration", "0.001", "--law", "signorini", "--restitution", "0.5",
                              "--out", folder.file("a.csv")});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.err, "notice: the law signorini ignores the restitution of the contacts\n");
    EXPECT_EQ(
        simulate({"lab/bass", "--duration", "0.001", "--law", "signorini", "--out", folder.file("a.csv")})
            .err,
        "");
}

TEST(Simulate, ScenesWithoutProbesCannotBeWrittenAsTables) {
    const TemporaryFolder folder;
    std::string text = valid_scene;
    const auto probes = text.find("\"probes\"");
    const std::string scene = folder.write("s.json", text.substr(0, probes) + "\"probes\": []}]}");
    expect_one_line(simulate({scene, "--out", folder.file("a.csv")}), 2, "for scenes with probes");
    expect_one_line(simulate({scene, "--out", folder.file("a.wav")}), 2, "for scenes with probes");
    EXPECT_EQ(simulate({scene, "--out", folder.file("a.h5")}).exit_code, 0);
}

TEST(Simulate, WavNeedsAWholeOutputRate) {
    const TemporaryFolder folder;
    expect_one_line(simulate({"lab/bass", "--output-rate", "7840.5", "--contact-rate", "784050", "--out",
                              folder.file("a.wav")}),
                    2, "whole number of hertz");
    EXPECT_TRUE(folder.names().empty());
}

TEST(Simulate, PlotsAppearBesideOtherOutputs) {
    const TemporaryFolder folder;
    const Ran ran = simulate(
        {"lab/bass", "--duration", "0.01", "--plot", folder.file("a.svg"), "--out", folder.file("a.csv")});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(read_text(folder.file("a.svg")).find("<svg") != std::string::npos);
    EXPECT_EQ(folder.names().size(), 2U);
}

}  // namespace
}  // namespace jawari::test
