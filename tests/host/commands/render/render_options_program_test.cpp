// `jawari render` with its options: pipes, several files, stems, limiter, tuning, map, seed, programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/midi_bytes.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

std::string as_text(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

/// Bass notes every 150 ms on channel 1, after some messages. A tick is a millisecond.
std::string notes(const std::vector<int>& keys, const std::vector<Bytes>& before = {}, int channel = 0,
                  int velocity = 80) {
    Bytes track;
    for (const Bytes& message : before) append_event(track, 0, message);
    for (const int key : keys) {
        append_event(track, 0,
                     {static_cast<std::uint8_t>(0x90 + channel), static_cast<std::uint8_t>(key),
                      static_cast<std::uint8_t>(velocity)});
        append_event(track, 150,
                     {static_cast<std::uint8_t>(0x80 + channel), static_cast<std::uint8_t>(key), 64});
    }
    append_event(track, 0, end_of_track);
    return as_text(file_with_track(track, 500));
}

struct Rendered {
    Ran ran;
    nlohmann::json stats;
    Wav wav;
};

Rendered render(const TemporaryFolder& folder, const std::string& midi, std::vector<std::string> options) {
    std::vector<std::string> arguments{"render",   folder.write("in.mid", midi),
                                       "-o",       folder.file("out.wav"),
                                       "--stats",  folder.file("stats.json"),
                                       "--format", "float",
                                       "--tail",   "0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Rendered rendered{jawari(arguments), {}, {}};
    EXPECT_EQ(rendered.ran.exit_code, 0) << rendered.ran.err;
    rendered.stats = nlohmann::json::parse(read_text(folder.file("stats.json")));
    rendered.wav = read_wav(folder.file("out.wav"));
    return rendered;
}

const std::vector<std::string> bass{"--preset", "bass-fretted"};

std::vector<std::string> with_bass(std::vector<std::string> options) {
    options.insert(options.begin(), bass.begin(), bass.end());
    return options;
}

double largest(const std::vector<double>& samples) {
    double peak = 0;
    for (const double sample : samples) peak = std::max(peak, std::abs(sample));
    return peak;
}

TEST(RenderOptions, StandardInputToStandardOutput) {
    const TemporaryFolder folder;
    const std::string midi = folder.write("in.mid", notes({28, 33}));
    const Ran file = jawari({"render", midi, "--preset", "bass-fretted", "-o", folder.file("a.wav")});
    ASSERT_EQ(file.exit_code, 0) << file.err;
    const Ran piped = run({"/bin/sh", "-c",
                           std::string(JAWARI_PROGRAM) + " render - --preset bass-fretted -o - < " + midi +
                               " > " + folder.file("b.wav")});
    ASSERT_EQ(piped.exit_code, 0) << piped.err;
    EXPECT_EQ(piped.out, "");
    EXPECT_EQ(piped.err, "");
    EXPECT_TRUE(read_wav(folder.file("a.wav")).data == read_wav(folder.file("b.wav")).data);
}

TEST(RenderOptions, SeveralFilesBecomeSeveralFiles) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render"};
    for (int i = 0; i < 5; ++i)
        arguments.push_back(folder.write("song" + std::to_string(i) + ".mid", notes({28 + i})));
    std::filesystem::create_directory(folder.file("out"));
    std::filesystem::create_directory(folder.file("single"));
    auto parallel = arguments;
    parallel.insert(parallel.end(), {"--preset", "bass-fretted", "-o", folder.file("out"), "--jobs", "3"});
    const Ran ran = jawari(parallel);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    for (std::size_t i = 0; i < 5; ++i) {
        const std::string name = "song" + std::to_string(i) + ".wav";
        const Ran alone = jawari(
            {"render", arguments[i + 1], "--preset", "bass-fretted", "-o", folder.file("single/" + name)});
        ASSERT_EQ(alone.exit_code, 0) << alone.err;
        EXPECT_TRUE(read_text(folder.file("out/" + name)) == read_text(folder.file("single/" + name)))
            << name;
    }
}

TEST(RenderOptions, OfSeveralFilesTheGoodOnesAreRendered) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("out"));
    const Ran ran =
        jawari({"render", folder.file("none.mid"), folder.write("good.mid", notes({28})),
                folder.write("bad.mid", "MThd"), "--preset", "bass-fretted", "-o", folder.file("out")});
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.error_lines(), 2);
    EXPECT_NE(ran.err.find("none.mid: No such file"), std::string::npos);
    EXPECT_NE(ran.err.find("bad.mid: byte 4"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/good.wav")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("out/bad.wav")));
}

TEST(RenderOptions, PortamentoControlSlidesOnTheString) {
    const auto sound = [](const std::vector<Bytes>& between) {
        Bytes track;
        append_event(track, 0, {0xB0, 5, 64});
        append_event(track, 0, {0x90, 40, 90});
        for (const Bytes& message : between) append_event(track, 0, message);
        append_event(track, 300, {0x90, 43, 90});
        append_event(track, 900, {0x80, 43, 64});
        append_event(track, 0, {0x80, 40, 64});
        append_event(track, 0, end_of_track);
        return as_text(file_with_track(track, 500));
    };
    const TemporaryFolder folder;
    EXPECT_EQ(render(folder, sound({{0xB0, 84, 40}}), bass).stats["legato_notes"], 1);
    EXPECT_EQ(render(folder, sound({}), bass).stats["legato_notes"], 0);
    const auto none = render(folder, sound({{0xB0, 84, 41}}), bass);
    EXPECT_EQ(none.stats["legato_notes"], 0);
    EXPECT_EQ(none.stats["ignored"][0]["what"], "controller 84 (portamento from)");
}

TEST(RenderOptions, TheLimiterKeepsItsCeilingAndSaysSo) {
    const TemporaryFolder folder;
    const auto loud = render(folder, notes({28, 33, 38}), with_bass({"--gain", "20", "--limiter", "-3"}));
    const double ceiling = std::pow(10.0, -3.0 / 20);
    EXPECT_LE(largest(loud.wav.samples()), ceiling * (1 + 1e-7));  // floats
    EXPECT_GT(largest(loud.wav.samples()), 0.9 * ceiling);
    EXPECT_GT(loud.stats["limited_frames"], 0);
    EXPECT_GT(loud.stats["limiter_reduction_db"], 1);
    EXPECT_NE(loud.ran.err.find("the limiter lowered"), std::string::npos);
    EXPECT_EQ(loud.stats["frames"], loud.wav.channel(0).size());
    const auto soft = render(folder, notes({28, 33, 38}), with_bass({"--gain", "-6", "--limiter", "0"}));
    const auto plain = render(folder, notes({28, 33, 38}), with_bass({"--gain", "-6"}));
    EXPECT_EQ(soft.ran.err, "");
    EXPECT_TRUE(soft.wav.data == plain.wav.data);  // bit for bit, without delay
}

TEST(RenderOptions, TheSeedDecides) {
    const TemporaryFolder folder;
    const std::string midi = notes({28, 33, 38, 43, 30, 35});
    const auto plain = render(folder, midi, bass).wav.data;
    const auto one = render(folder, midi, with_bass({"--seed", "1"})).wav.data;
    EXPECT_TRUE(one == render(folder, midi, with_bass({"--seed", "1"})).wav.data);
    EXPECT_FALSE(one == render(folder, midi, with_bass({"--seed", "2"})).wav.data);
    EXPECT_FALSE(one == plain);
}

TEST(RenderOptions, ProgramsChoosePresets) {
    const TemporaryFolder folder;
    const auto chosen = render(folder, notes({28, 33}, {{0xC0, 33}}), {});
    EXPECT_EQ(chosen.stats["parts"].size(), 1U);
    EXPECT_EQ(chosen.stats["parts"][0]["preset"], "bass-fretted");
    EXPECT_EQ(chosen.ran.err, "");
    EXPECT_TRUE(chosen.wav.data == render(folder, notes({28, 33}), bass).wav.data);
    const auto flute = render(folder, notes({28, 33}, {{0xC0, 73}}), {"--only-strings"});
    EXPECT_EQ(flute.stats["silent_notes"], 2);
    EXPECT_EQ(largest(flute.wav.samples()), 0);
    EXPECT_NE(flute.ran.err.find("notice: 2 notes are silent"), std::string::npos);
    const auto nearest = render(folder, notes({62, 65}, {{0xC0, 73}}), {});
    EXPECT_EQ(nearest.stats["parts"][0]["preset"], "dulcimer");
    EXPECT_EQ(nearest.stats["silent_notes"], 0);
    const auto effects = render(folder, notes({62, 65}, {{0xC0, 124}}), {});
    EXPECT_EQ(effects.stats["silent_notes"], 2);
    const auto drums = render(folder, notes({36}, {{0xC9, 33}}, 9), {});
    EXPECT_EQ(drums.stats["silent_notes"], 1);
    const auto ignored = render(folder, notes({28}, {{0xC0, 73}}), bass);
    EXPECT_NE(ignored.ran.err.find("program changes do nothing"), std::string::npos);
}

TEST(RenderOptions, ANotePresetsHaveNoStringForIsPlayedByANeighbour) {
    const TemporaryFolder folder;
    const std::string piano = notes({36, 60, 88, 20}, {{0xC0, 0}});  // the dulcimer has keys 50 to 86
    const auto song = render(folder, piano, {});
    ASSERT_EQ(song.stats["parts"].size(), 2U);
    EXPECT_EQ(song.stats["notes"], 3);
    EXPECT_EQ(song.stats["ignored_notes"], 1);
    EXPECT_NE(song.ran.err.find("2 notes are beyond the keys of dulcimer; harpsichord plays them"),
              std::string::npos)
        << song.ran.err;
    EXPECT_EQ(song.stats["lent_notes"],
              nlohmann::json::parse(R"([{"preset": "dulcimer", "player": "harpsichord", "notes": 2}])"));
    const auto alone = render(folder, piano, {"--only-strings"});
    EXPECT_EQ(alone.stats["ignored_notes"], 3);
    const auto chosen = render(folder, piano, {"--preset", "dulcimer"});
    EXPECT_EQ(chosen.stats["ignored_notes"], 3);
    EXPECT_EQ(chosen.stats["parts"].size(), 1U);
}

TEST(RenderOptions, StemsAreWrittenBesideTheMix) {
    const TemporaryFolder folder;
    render(folder, notes({28, 33}), with_bass({"--stems", folder.file("stems.wav")}));
    EXPECT_EQ(read_wav(folder.file("stems.wav")).channels, 4);
    std::filesystem::create_directory(folder.file("stems"));
    render(folder, notes({28, 33}), with_bass({"--stems", folder.file("stems/")}));
    for (const char* name : {"1-bass-fretted-E.wav", "1-bass-fretted-G.wav"})
        EXPECT_EQ(read_wav(folder.file("stems") + "/" + name).channels, 1);
}

struct Refusal {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
};

TEST(RenderOptions, EveryFailureIsOneLineAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string good = folder.write("good.mid", notes({28}));
    const std::string scale = folder.write("bad.scl", "x\n1\n0/1\n");
    const std::string octave = folder.write("octave.scl", "x\n1\n2/1\n");
    const std::string keys = folder.write("bad.kbm", "0\n0\n999\n");
    const std::string map =
        folder.write("map.json", R"({"schema": "jawari.midi-map/1", "bindings": [{"nrpn": 1}]})");
    const std::size_t written = folder.names().size();
    const std::vector<Refusal> refusals{
        {{"--tuning", scale}, 3, "bad.scl: line 3: \"0/1\""},
        {{"--tuning", folder.file("none.scl")}, 4, "none.scl: No such file"},
        {{"--tuning", octave, "--keyboard-map", keys}, 3, "bad.kbm: line 3: \"999\""},
        {{"--keyboard-map", keys}, 2, "--keyboard-map"},
        {{"--move-frets"}, 2, "--move-frets: given (allowed: only with --tuning)"},
        {{"--midi-map", map}, 3, "map.json: bindings[0].parameter: missing"},
        {{"--set", "palm_mute=2"}, 2, "palm_mute=2 (allowed: palm_mute=0 to 1)"},
        {{"--set", "palm=2"}, 2, "palm=2 (allowed: PARAMETER=VALUE, one of volume"},
        {{"--set", "palm_mute"}, 2, "palm_mute (allowed: palm_mute=0 to 1)"},
        {{"--guitar-mode", "17"}, 2, "--guitar-mode: 17 (allowed: a whole number, 1 to 16"},
        {{"--guitar-mode", "14"}, 2, "--guitar-mode: 14 (allowed: 1 to 13 for this preset's 4 strings"},
        {{"--limiter", "3"}, 2, "--limiter: 3 (allowed: -40 to 0)"},
        {{"--seed", "1.5"}, 2, "--seed: 1.5"},
        {{"--jobs", "0"}, 2, "--jobs: 0"},
        {{"--quality", "best"}, 2, "best (allowed: live, reference, studio)"},
        {{"--silence", "0"}, 2, "--silence: 0"},
        {{"--stems", folder.file("none/none/")}, 4, "none/none/: No such file"},
        {{"--stems", folder.file("x.mp3")}, 2, "x.mp3 (allowed: a name that ends in one of .wav, .w64"},
        {{"--stems", folder.file("x.flac"), "--format", "float"}, 2, "(allowed: pcm16 or pcm24 in FLAC)"},
        {{"--transpose", "49"}, 2, "--transpose: 49"},
        {{"--mute", "17"}, 2, "--mute: 17 (allowed: a whole number, 1 to 16"},
        {{"--tempo", "0"}, 2, "--tempo: 0 (allowed: 10 to 1000"},
        {{"--plot", folder.file("p.pdf")}, 2, "p.pdf (allowed: a name that ends in .svg or .png)"},
        {{good, "--stats", folder.file("s.json")}, 2, "s.json (allowed: only with one MIDI file)"}};
    for (const Refusal& refusal : refusals) {
        std::vector<std::string> arguments{"render",       good, "--preset",
                                           "bass-fretted", "-o", folder.file("o.wav")};
        arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
        const Ran ran = jawari(arguments);
        EXPECT_EQ(ran.exit_code, refusal.exit_code) << refusal.message << "\n" << ran.err;
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find(refusal.message), std::string::npos)
            << ran.err << "expected: " << refusal.message;
        EXPECT_EQ(ran.out, "");
    }
    EXPECT_EQ(folder.names().size(), written);
}

TEST(RenderOptions, FilesThatWouldOverwriteOneAnotherAreRefused) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render", "-o", folder.file("out")};
    for (const char* name : {"a", "b", "out"}) std::filesystem::create_directory(folder.file(name));
    for (const char* name : {"a/song.mid", "b/song.mid"})
        arguments.push_back(folder.write(name, notes({28})));
    const Ran same_names = jawari(arguments);
    EXPECT_EQ(same_names.exit_code, 2);
    EXPECT_EQ(same_names.error_lines(), 1) << same_names.err;
    EXPECT_NE(same_names.err.find("b/song.mid (allowed: files of different names"), std::string::npos)
        << same_names.err;

    arguments.back() = "-";
    const Ran piped = jawari(arguments);
    EXPECT_EQ(piped.exit_code, 2);
    EXPECT_EQ(piped.err, "MIDI: - (allowed: standard input only as the one file)\n");
    EXPECT_TRUE(std::filesystem::is_empty(folder.file("out")));
}

TEST(RenderOptions, FormatsAreThoseOfTheNames) {
    // First bytes as each format has them, and the samples as libsndfile's own tool decodes them.
    using namespace std::string_literals;
    const TemporaryFolder folder;
    const std::string midi = folder.write("in.mid", notes({28, 33}));
    const std::vector<std::pair<std::string, std::string>> formats{
        {"a.flac", "fLaC"}, {"a.FLAC", "fLaC"}, {"a.ogg", "OggS"}, {"a.aiff", "FORM"}, {"a.aif", "FORM"},
        {"a.caf", "caff"},  {"a.w64", "riff"},  {"a.wav", "RIFF"}, {"plain", "RIFF"}};
    for (const auto& [name, header] : formats) {
        const Ran ran =
            jawari({"render", midi, "--preset", "bass-fretted", "--tail", "0", "-o", folder.file(name)});
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(read_text(folder.file(name)).substr(0, 4), header) << name;
    }
    const Ran raw = jawari({"render", midi, "--preset", "bass-fretted", "--tail", "0", "--format", "pcm16",
                            "-o", folder.file("a.raw")});
    EXPECT_EQ(raw.exit_code, 0) << raw.err;
    const Ran wav = jawari({"render", midi, "--preset", "bass-fretted", "--tail", "0", "--format", "pcm16",
                            "-o", folder.file("b.wav")});
    EXPECT_EQ(wav.exit_code, 0) << wav.err;
    EXPECT_TRUE(read_text(folder.file("a.raw")) == read_wav(folder.file("b.wav")).data);
    for (const char* name : {"a.mp3", "a.mid", "a.wave"}) {
        const Ran ran = jawari({"render", midi, "-o", folder.file(name)});
        EXPECT_EQ(ran.exit_code, 2) << name;
        EXPECT_NE(ran.err.find("(allowed: a name that ends in one of .wav, "), std::string::npos) << ran.err;
    }
}

TEST(RenderOptions, TheLastFolderIsMade) {
    const TemporaryFolder folder;
    const std::string midi = folder.write("in.mid", notes({28}));
    const Ran ran = jawari({"render", midi, "--preset", "bass-fretted", "--tail", "0", "-o",
                            folder.file("out/"), "--stems", folder.file("stems/")});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/in.wav")));
    EXPECT_TRUE(std::filesystem::exists(folder.file("stems/1-bass-fretted-E.wav")));
}

TEST(RenderOptions, TranspositionMovesEveryKey) {
    const TemporaryFolder folder;
    const auto moved = render(folder, notes({28, 33}), with_bass({"--transpose", "5"}));
    EXPECT_TRUE(moved.wav.data == render(folder, notes({33, 38}), bass).wav.data);
}

TEST(RenderOptions, MuteSoloTempoAndQuiet) {
    const TemporaryFolder folder;
    const std::string midi = notes({28, 33, 38});
    EXPECT_EQ(render(folder, midi, with_bass({"--mute", "2,1"})).stats["notes"], 0);
    EXPECT_EQ(render(folder, midi, with_bass({"--solo", "2", "--solo", "3"})).stats["notes"], 0);
    EXPECT_EQ(render(folder, midi, with_bass({"--solo", "1", "--mute", "2"})).stats["notes"], 3);
    EXPECT_EQ(render(folder, midi, with_bass({"--tempo", "50"})).stats["frames"], 2 * 3 * 7200);
    const Ran quiet = jawari({"render", folder.write("f.mid", notes({28}, {{0xB0, 91, 1}})), "-q", "--preset",
                              "bass-fretted", "-o", folder.file("q.wav")});
    EXPECT_EQ(quiet.exit_code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(RenderOptions, GuitarModeNeedsThePresetWhoseStringsItIsFor) {
    const TemporaryFolder folder;
    const Ran ran = jawari(
        {"render", folder.write("song.mid", notes({28})), "-o", folder.file("o.wav"), "--guitar-mode", "1"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_NE(ran.err.find("--guitar-mode: 1 (allowed: only with --preset NAME)"), std::string::npos)
        << ran.err;
}

}  // namespace
}  // namespace jawari::host
