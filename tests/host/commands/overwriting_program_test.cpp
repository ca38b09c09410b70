// No command writes over what it reads, or twice to one file, whatever it is called.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;
namespace fs = std::filesystem;

const std::string cases = JAWARI_SOURCE_DIR "/tests/data/cases/";

/// Files that users have, and their contents.
class Desk {
  public:
    Desk() {
        add("a.mid", read_text(cases + "midi/46_four_notes.mid"));
        add("b.mid", read_text(cases + "midi/44_exact_2s.mid"));
        add("s.scl", "x\n1\n2/1\n");
        add("k.kbm", "0\n0\n127\n60\n60\n261.6\n0\n");
        add("map.json", R"({"schema": "jawari.midi-map/1", "bindings": []})");
        add("p.json", read_text(JAWARI_SOURCE_DIR "/presets/instruments/bass-fretted.json"));
        add("scene.json", read_text(JAWARI_SOURCE_DIR "/presets/scenes/lab/one-contact.json"));
        fs::create_symlink("a.mid", folder.file("l.wav"));
        fs::create_hard_link(folder.file("a.mid"), folder.file("h.wav"));
        fs::create_directory(folder.file("stems"));
        fs::create_directory(folder.file("out"));
        fs::create_symlink("../a.mid", folder.file("stems/1-bass-fretted-E.wav"));
        fs::create_symlink("../a.mid", folder.file("out/a.wav"));
    }

    void expect_untouched(const std::string& what) const {
        for (const auto& [name, text] : texts_) EXPECT_TRUE(read_text(folder.file(name)) == text) << what;
        EXPECT_TRUE(fs::is_symlink(folder.file("l.wav"))) << what;
        EXPECT_EQ(folder.names().size(), texts_.size() + 4) << what;
    }

    TemporaryFolder folder;

  private:
    void add(const std::string& name, const std::string& text) {
        folder.write(name, text);
        texts_[name] = text;
    }
    std::map<std::string, std::string> texts_;
};

/// Paths of a command line are those of the desk.
Ran at_desk(const Desk& desk, const std::string& line, const RunOptions& options = {}) {
    return run({"/bin/sh", "-c", "cd '" + desk.folder.file("") + "' && " JAWARI_PROGRAM " " + line}, options);
}

TEST(Overwriting, IsRefusedWithOneLineAndNothingChanges) {
    const Desk desk;
    const std::string render = "render a.mid --preset bass-fretted ";
    const std::vector<std::string> lines{
        render + "-o a.mid",
        render + "-o ./a.mid --overwrite",
        render + "-o l.wav --overwrite",
        render + "-o h.wav --overwrite",
        render + "-o o.wav --stats a.mid --overwrite",
        render + "-o o.wav --stems a.mid --overwrite",
        render + "-o o.wav --stems stems/ --overwrite",
        render + "-o s.scl --tuning s.scl --overwrite",
        render + "-o k.kbm --tuning s.scl --keyboard-map k.kbm --overwrite",
        render + "-o o.wav --stats map.json --midi-map map.json --overwrite",
        "render a.mid -o p.json --preset p.json --overwrite",
        "render a.mid -o o.wav --stats p.json --preset ./p.json --overwrite",
        "render -o *.mid",  // the shell makes the first file the output
        "render a.mid -o out --overwrite",
        render + "-o q.wav --stems ./q.wav",
        render + "-o q.wav --stems q.wav --overwrite",
        render + "-o - --stats - > /dev/null",
        render + "-o b.mid",
        render + "-o p.json",
        render + "-o o.wav --stats map.json",
        render + "-o o.wav --plot scene.json.svg --stems ./scene.json.svg",
        "render - --preset bass-fretted -o a.mid --overwrite < a.mid",
        "simulate scene.json --duration 0.01 --stats scene.json --overwrite",
        "simulate scene.json --duration 0.01 --stats p.json",
        "simulate scene.json --duration 0.01 --out x.csv --stats ./x.csv",
        "simulate scene.json --duration 0.01 --stats x.svg --plot ./x.svg",
        "bench-latency --preset p.json --frames 64 --blocks 1 --json p.json --overwrite",
        "bench-latency --preset p.json --frames 64 --blocks 1 --csv x --json ./x"};
    for (const std::string& line : lines) {
        const Ran ran = at_desk(desk, line);
        EXPECT_EQ(ran.exit_code, 2) << line << "\n" << ran.err;
        EXPECT_EQ(ran.error_lines(), 1) << line << "\n" << ran.err;
        EXPECT_NE(ran.err.find("(allowed: "), std::string::npos) << ran.err;
        desk.expect_untouched(line);
    }
}

TEST(Overwriting, APresetOfTheUsersFolderIsAnInputToo) {
    const Desk desk;
    fs::create_directories(desk.folder.file("out/jawari/presets"));
    const std::string preset = desk.folder.file("out/jawari/presets/mine.json");
    fs::copy_file(desk.folder.file("p.json"), preset);
    const std::string before = read_text(preset);
    for (const char* chosen : {"mine", "auto"}) {
        const Ran ran = run({"/bin/sh", "-c",
                             "XDG_DATA_HOME='" + desk.folder.file("out") + "' " JAWARI_PROGRAM " render '" +
                                 desk.folder.file("a.mid") + "' --overwrite --preset " + chosen + " -o '" +
                                 desk.folder.file("o.wav") + "' --stats '" + preset + "'"});
        EXPECT_EQ(ran.exit_code, 2) << ran.err;
        EXPECT_TRUE(read_text(preset) == before);
    }
}

TEST(Overwriting, FilesOfTheSameKindAreReplacedAndOthersWhenAskedFor) {
    const Desk desk;
    for (const char* line :
         {"render a.mid -o o.wav --stats o.json --tail 0", "render a.mid -o o.wav --stats o.json --tail 0",
          "simulate scene.json --duration 0.01 --out x.csv --stats o.json",
          "simulate scene.json --duration 0.01 --out x.csv --stats o.json",
          "simulate scene.json --duration 0.01 --out o.wav",
          "render b.mid -o a.wav --tail 0 --stats s.scl --overwrite"}) {
        const Ran ran = at_desk(desk, line);
        EXPECT_EQ(ran.exit_code, 0) << line << "\n" << ran.err;
    }
    EXPECT_TRUE(read_text(desk.folder.file("s.scl")).starts_with("{"));
}

TEST(Overwriting, ALinkToAFileThatIsNotThereYetStaysALink) {
    const Desk desk;
    fs::create_symlink("new.wav", desk.folder.file("link.wav"));
    EXPECT_EQ(at_desk(desk, "render a.mid -o new.wav --stems link.wav --tail 0").exit_code, 2);
    const Ran ran = at_desk(desk, "render a.mid -o link.wav --tail 0");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(fs::is_symlink(desk.folder.file("link.wav")));
    EXPECT_TRUE(read_text(desk.folder.file("new.wav")).starts_with("RIFF"));
}

}  // namespace
}  // namespace jawari::host
