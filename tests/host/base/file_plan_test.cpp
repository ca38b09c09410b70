#include "base/file_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// Names of one file that exists, and of one that does not.
struct Names {
    TemporaryFolder folder;
    std::vector<std::string> there, not_there;

    Names() {
        folder.write("song.mid", "MThd");
        fs::create_directory(folder.file("sub"));
        fs::create_symlink("song.mid", folder.file("soft"));
        fs::create_symlink("soft", folder.file("softer"));
        fs::create_hard_link(folder.file("song.mid"), folder.file("hard"));
        fs::create_symlink(".", folder.file("here"));
        fs::create_symlink("none.wav", folder.file("dangling"));
        fs::create_symlink("../dangling", folder.file("sub/dangling"));
        for (const char* name :
             {"song.mid", "./song.mid", "sub/../song.mid", "soft", "softer", "hard", "here/song.mid"})
            there.push_back(folder.file(name));
        for (const char* name :
             {"none.wav", "./none.wav", "sub/../none.wav", "here/none.wav", "dangling", "sub/dangling"})
            not_there.push_back(folder.file(name));
    }
};

TEST(FilePlan, NoNameOfAnInputIsAnOutput) {
    const Names names;
    for (const std::string& input : names.there) {
        for (const std::string& output : names.there) {
            for (const bool overwrite : {false, true}) {
                FilePlan plan(overwrite);
                plan.add_input("MIDI", input);
                const auto error = plan.add_output("--out", output, FileContent::Sound);
                ASSERT_TRUE(error) << input << " " << output;
                EXPECT_EQ(error->kind, ErrorKind::Usage);
                EXPECT_EQ(error->message, "--out: " + output + " (allowed: another file than that of MIDI, " +
                                              input + ", which is read)");
            }
        }
    }
}

TEST(FilePlan, NoFileIsWrittenTwiceWhateverItsNames) {
    const Names names;
    for (const auto& group : {names.there, names.not_there}) {
        for (const std::string& first : group) {
            for (const std::string& second : group) {
                FilePlan plan(true);
                EXPECT_FALSE(plan.add_output("--out", first, FileContent::Sound)) << first;
                EXPECT_TRUE(plan.add_output("--stems", second, FileContent::Sound)) << first << " " << second;
                EXPECT_EQ(is_same_file(first, second), true);
            }
        }
    }
    EXPECT_FALSE(is_same_file(names.there[0], names.not_there[0]));
}

TEST(FilePlan, OtherFilesAreFree) {
    const Names names;
    FilePlan plan(false);
    plan.add_input("MIDI", names.there[0]);
    plan.add_input("--preset", names.folder.file("missing"));
    EXPECT_FALSE(plan.add_output("--out", names.folder.file("missing"), FileContent::Sound));
    EXPECT_FALSE(plan.add_output("--stats", names.folder.file("other"), FileContent::Json));
    EXPECT_FALSE(plan.add_output("--stems", names.folder.file("sub/missing"), FileContent::Sound));
    EXPECT_FALSE(plan.add_output("--plot", "", FileContent::Picture));
}

TEST(FilePlan, DevicesMayHaveSeveralUsersStandardOutputMayNot) {
    FilePlan plan(false);
    plan.add_input("MIDI", "/dev/null");
    EXPECT_FALSE(plan.add_output("--out", "/dev/null", FileContent::Sound));
    EXPECT_FALSE(plan.add_output("--stats", "/dev/null", FileContent::Json));
    EXPECT_FALSE(plan.add_output("--stems", "-", FileContent::Sound));
    EXPECT_TRUE(plan.add_output("--plot", "-", FileContent::Json));
}

TEST(FilePlan, OnlyFilesOfTheSameKindAreReplacedUnasked) {
    using namespace std::string_literals;
    struct Old {
        std::string text;
        std::vector<FileContent> replaced_by;
    };
    using enum FileContent;
    const std::vector<FileContent> all{Sound, RawSound, Json, Picture, Table, Hdf5, Midi};
    const std::vector<Old> files{{"", all},
                                 {"RIFF\x10\0\0\0WAVEfmt "s, {Sound}},
                                 {"RF64\xff\xff\xff\xffWAVE"s, {Sound}},
                                 {"fLaC\0\0\0\x22"s, {Sound}},
                                 {"OggS\0\2"s, {Sound}},
                                 {"FORM\0\0\0\x10"
                                  "AIFF"s,
                                  {Sound}},
                                 {"MThd\0\0\0\6\0\0"s, {Midi}},
                                 {"RIFF\x10\0\0\0RMIDdata"s, {Midi}},
                                 {"\x89PNG\r\n\x1a\n"s, {Picture}},
                                 {"<?xml version=\"1.0\"?>\n<svg width=\"3\"", {Picture}},
                                 {"\x89HDF\r\n\x1a\n"s, {Hdf5, RawSound}},
                                 {"time_s,a\n0,1\n", {Table}},
                                 {"{\n  \"schema\": \"jawari.render-stats/2\"", {Json}},
                                 {"{\"processor\": \"x\"", {Json}},
                                 {"{\"schema\": \"jawari.preset/2\", \"name\"", {}},
                                 {"{\"schema\": \"jawari.scene/1\"", {}},
                                 {"{ \"comment\": \"mine\", \"schema\": \"jawari.midi-map/1\"", {}},
                                 {"! scale.scl\n12\n", {}},
                                 {"dear diary,\n", {}},
                                 {"\0\1\2\3\xfe\xff"s, {RawSound}}};
    const TemporaryFolder folder;
    for (const Old& old : files) {
        const std::string path = folder.write("old", old.text);
        for (const FileContent kind : all) {
            const bool expected =
                std::find(old.replaced_by.begin(), old.replaced_by.end(), kind) != old.replaced_by.end();
            EXPECT_EQ(may_replace(path, kind), expected) << old.text << " " << static_cast<int>(kind);
            FilePlan plan(false), forced(true);
            EXPECT_EQ(!plan.add_output("--out", path, kind), expected);
            EXPECT_FALSE(forced.add_output("--out", path, kind));
        }
    }
    for (const FileContent kind : all) EXPECT_TRUE(may_replace(folder.file("none"), kind));
}

}  // namespace
}  // namespace jawari::host
