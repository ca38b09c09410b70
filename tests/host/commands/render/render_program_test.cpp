// `jawari render` as a user meets it: sample accuracy, determinism, formats, tails, and every way it can
// fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>

#include "support/midi_bytes.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

const std::string demo = JAWARI_SOURCE_DIR "/presets/demo/slap.mid";

std::string as_text(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

/// One note from 100 ms to 200 ms; a tick is a millisecond.
std::string one_note(int key = 28, int velocity = 40) {
    Bytes track;
    append_event(track, 100, {0x90, static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(velocity)});
    append_event(track, 100, {static_cast<std::uint8_t>(key), 0});
    append_event(track, 0, end_of_track);
    return as_text(file_with_track(track, 500));
}

struct Rendered {
    Ran ran;
    nlohmann::json stats;
    Wav wav;
};

Rendered render_text(const std::string& midi, std::vector<std::string> options) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{
        "render", folder.write("in.mid", midi), "--preset", "bass-fretted",
        "-o",     folder.file("out.wav"),       "--stats",  folder.file("stats.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Rendered rendered{jawari(arguments), {}, {}};
    EXPECT_EQ(rendered.ran.exit_code, 0) << rendered.ran.err;
    rendered.stats = nlohmann::json::parse(read_text(folder.file("stats.json")));
    rendered.wav = read_wav(folder.file("out.wav"));
    return rendered;
}

TEST(RenderProgram, TheFirstSampleOfANoteIsAtItsTime) {
    for (const std::string rate : {"44100", "48000", "96000"}) {
        const auto rendered = render_text(one_note(), {"--rate", rate, "--format", "float"});
        EXPECT_EQ(std::to_string(rendered.wav.rate_hz), rate);
        EXPECT_EQ(rendered.wav.channels, 2);
        const auto sound = rendered.wav.channel(0);
        const auto first = std::find_if(sound.begin(), sound.end(), [](double x) { return x != 0; });
        EXPECT_EQ(first - sound.begin(), std::stol(rate) / 10);
    }
}

TEST(RenderProgram, TwoRendersGiveTheSameBytes) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.wav", "b.wav"}) {
        const Ran ran = jawari({"render", demo, "--preset", "bass-fretted", "-o", folder.file(name)});
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.err, "");  // no warning: the demo does not clip
    }
    const std::string bytes = read_text(folder.file("a.wav"));
    EXPECT_GT(bytes.size(), 1000000U);
    EXPECT_TRUE(bytes == read_text(folder.file("b.wav")));
}

TEST(RenderProgram, TheDemoStrikesTheFretsAtASaneLevel) {
    const TemporaryFolder folder;
    const Ran ran =
        jawari({"render", demo, "--preset", "bass-fretted", "-o", folder.file("a.wav"), "--stats", "-"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto stats = nlohmann::json::parse(ran.out);
    EXPECT_GT(stats["impulses"], 1000);
    EXPECT_EQ(stats["ignored_notes"], 0);
    EXPECT_EQ(stats["nonfinite_resets"], 0);
    EXPECT_EQ(stats["truncated_solves"], 0);
    EXPECT_GT(stats["peak_dbfs"], -18.0);  // presets aim at a loudness, scripts/instruments/levels.py
    EXPECT_LT(stats["peak_dbfs"], -1.0);
    EXPECT_GT(stats["sound_s"], 10.0);
    EXPECT_LT(stats["sound_s"], 20.0);
}

TEST(RenderProgram, TheDemoFileIsWhatItsScriptWrites) {
    const TemporaryFolder folder;
    const Ran ran =
        run({JAWARI_PYTHON, JAWARI_SOURCE_DIR "/scripts/make_demo_midi.py", folder.file("slap.mid")});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(read_text(folder.file("slap.mid")) == read_text(demo));
}

TEST(RenderProgram, FormatsDifferByRoundingOnly) {
    const auto exact = render_text(one_note(28, 127), {"--format", "float"}).wav;
    EXPECT_EQ(exact.format, 3);
    EXPECT_EQ(exact.bits, 32);
    const auto samples = exact.samples();
    for (const unsigned bits : {16U, 24U}) {
        const auto pcm = render_text(one_note(28, 127), {"--format", "pcm" + std::to_string(bits)}).wav;
        EXPECT_EQ(pcm.format, 1);
        EXPECT_EQ(pcm.bits, bits);
        const std::size_t bytes = bits / 8;
        ASSERT_EQ(pcm.data.size(), samples.size() * bytes);
        const double full = std::pow(2.0, bits - 1) - 1;  // as libsndfile scales
        for (std::size_t n = 0; n < samples.size(); ++n) {
            std::int32_t value = 0;
            for (std::size_t i = 0; i < bytes; ++i) {
                value |= static_cast<std::int32_t>(
                    static_cast<std::uint32_t>(static_cast<std::uint8_t>(pcm.data[n * bytes + i]))
                    << (8 * (i + 4 - bytes)));
            }
            value >>= 32 - bits;
            ASSERT_NEAR(value / full, samples[n], 1.6 / full) << n;
        }
    }
}

TEST(RenderProgram, ClippingIsCountedWarnedOfAndClamped) {
    const auto loud = render_text(one_note(28, 127), {"--gain", "30", "--format", "pcm16"});
    EXPECT_GT(loud.stats["clipped_samples"], 0);
    EXPECT_EQ(loud.ran.error_lines(), 1);
    EXPECT_NE(loud.ran.err.find("clipped"), std::string::npos);
    const auto kept = render_text(one_note(28, 127), {"--gain", "30", "--format", "float"});
    const auto sound = kept.wav.samples();
    EXPECT_GT(*std::max_element(sound.begin(), sound.end()), 2);
    const auto normal = render_text(one_note(28, 127), {"--format", "float"});
    const auto quiet = normal.wav.samples();
    for (std::size_t n = 0; n < quiet.size(); ++n)
        ASSERT_NEAR(sound[n], quiet[n] * std::pow(10.0, 1.5), 1e-5);
}

TEST(RenderProgram, TailsEndWhenTold) {
    const auto none = render_text(one_note(), {"--tail", "0"});
    EXPECT_EQ(none.stats["frames"], 9600);
    const auto one = render_text(one_note(), {"--tail", "1"});
    EXPECT_EQ(one.stats["frames"], 9600 + 48000);
    const auto automatic = render_text(one_note(), {"--tail", "auto", "--format", "float"});
    const auto sound = automatic.wav.channel(0);
    ASSERT_GT(sound.size(), 9600U + 4800);
    for (std::size_t n = sound.size() - 4800; n < sound.size(); ++n)
        ASSERT_LT(std::abs(sound[n]), std::pow(10.0, -4.5));
    EXPECT_LT(sound.size(), 9600U + 48000);
}

TEST(RenderProgram, NotesOutOfRangeAreCounted) {
    const auto rendered = render_text(one_note(20), {"--tail", "0"});
    EXPECT_EQ(rendered.stats["ignored_notes"], 1);
    EXPECT_EQ(rendered.stats["notes"], 0);
    EXPECT_TRUE(rendered.stats["peak_dbfs"].is_null());
}

// ---------------------------------------------------------------------------------------------- failures

struct Refusal {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
};

TEST(RenderProgram, EveryFailureIsOneLineAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string good = folder.write("good.mid", one_note());
    const std::string cut = folder.write("cut.mid", one_note().substr(0, 30));
    const std::string text = folder.write("text.mid", "hello");
    const std::string bad_preset =
        folder.write("bad.json", R"({"schema": "jawari.preset/2", "name": "x", "gaim": 1})");
    const std::string out = folder.file("out.wav");
    const std::string missing = folder.file("missing");
    const std::vector<Refusal> refusals{
        {{good, "--preset", "bass-fretted"}, 2, "--out"},
        {{good, "--preset", "bass-fretted", "-o", out, "--rate", "48000.5"}, 2, "--rate: 48000.5 (allowed: "},
        {{good, "--preset", "bass-fretted", "-o", out, "--rate", "1e9"}, 2, "8000 to 384000"},
        {{good, "--preset", "bass-fretted", "-o", out, "--tail", "-1"},
         2,
         "--tail: -1 (allowed: auto, or 0 to 600"},
        {{good, "--preset", "bass-fretted", "-o", out, "--format", "mp3"},
         2,
         "mp3 (allowed: float, pcm16, pcm24"},
        {{good, "--preset", "bass-fretted", "-o", out, "--gain", "nan"}, 2, "--gain: nan"},
        {{good, "--preset", "bass-fretted", "-o", out, "--stats", out}, 2, "another name"},
        {{missing, "--preset", "bass-fretted", "-o", out}, 4, "missing: No such file"},
        {{cut, "--preset", "bass-fretted", "-o", out, "--strict"}, 3, "cut.mid: byte 18 (track 1): "},
        {{text, "--preset", "bass-fretted", "-o", out}, 3, "text.mid: byte 0: not a standard MIDI file"},
        {{good, "--preset", "bass-fretles", "-o", out},
         4,
         "no preset of that name; did you mean \"bass-fretless\"? (presets: "},
        {{good, "--preset", bad_preset, "-o", out}, 3, "bad.json: gaim"},
        {{good, "--preset", good, "-o", out}, 3, "good.mid:1:1"},
        {{good, "--preset", "bass-fretted", "-o", missing + "/out.wav"}, 4, "out.wav: No such file"},
        {{good, "--preset", "bass-fretted", "-o", "/dev/full"}, 4, "/dev/full"}};
    for (Refusal refusal : refusals) {
        refusal.arguments.insert(refusal.arguments.begin(), "render");
        const Ran ran = jawari(refusal.arguments);
        EXPECT_EQ(ran.exit_code, refusal.exit_code) << refusal.message << "\n" << ran.err;
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_NE(ran.err.find(refusal.message), std::string::npos)
            << ran.err << "expected: " << refusal.message;
        EXPECT_EQ(ran.out, "");
    }
    EXPECT_EQ(folder.names().size(), 4U);  // only what the test wrote
}

TEST(RenderProgram, AFullDiskLeavesNothing) {
    const TemporaryFolder folder;
    const Ran ran = jawari({"render", demo, "--preset", "bass-fretted", "-o", folder.file("out.wav")},
                           {.largest_file_bytes = 200000});
    EXPECT_EQ(ran.exit_code, 4) << ran.err;
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(RenderProgram, AnInterruptLeavesNothing) {
    const TemporaryFolder folder;
    Bytes track;  // an hour of a note that rings
    append_event(track, 0, {0x90, 28, 127});
    append_event(track, 3600 * 1000, {28, 0});
    append_event(track, 0, end_of_track);
    const std::string midi = folder.write("long.mid", as_text(file_with_track(track, 500)));
    for (const auto& [signal, exit_code] :
         {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}, std::pair{SIGHUP, 129}}) {
        const Ran ran = jawari({"render", midi, "--preset", "bass-fretted", "-o", folder.file("out.wav")},
                               {.signal = signal, .signal_after_ms = 400});
        EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
        EXPECT_EQ(folder.names().size(), 1U);
    }
}

}  // namespace
}  // namespace jawari::host
