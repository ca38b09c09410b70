// Inputs after public reports (tests/data/cases/README.md): what is right is measured from the sound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

constexpr double rate_hz = 48000;
const std::string midi_cases = JAWARI_SOURCE_DIR "/tests/data/cases/midi/";

struct Played {
    Ran ran;
    nlohmann::json stats;
    std::vector<double> sound;  ///< both channels' mean
};

Played play_text(const std::string& midi, std::vector<std::string> options = {}) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render",   folder.write("in.mid", midi),
                                       "-o",       folder.file("o.wav"),
                                       "--stats",  folder.file("s.json"),
                                       "--format", "float",
                                       "--tail",   "0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Played played{jawari(arguments), {}, {}};
    EXPECT_EQ(played.ran.exit_code, 0) << played.ran.err;
    if (played.ran.exit_code != 0) return played;
    played.stats = nlohmann::json::parse(read_text(folder.file("s.json")));
    const Wav wav = read_wav(folder.file("o.wav"));
    const auto left = wav.channel(0), right = wav.channel(1);
    for (std::size_t n = 0; n < left.size(); ++n) played.sound.push_back((left[n] + right[n]) / 2);
    return played;
}

Played play_case(const std::string& name, std::vector<std::string> options = {}) {
    return play_text(read_text(midi_cases + name + ".mid"), std::move(options));
}

/// Of the samples between two times [s].
std::vector<double> between(const Played& played, double begin_s, double end_s) {
    const auto begin = static_cast<std::size_t>(begin_s * rate_hz);
    const auto end = std::min(played.sound.size(), static_cast<std::size_t>(end_s * rate_hz));
    if (begin >= end) return {};
    return {played.sound.begin() + static_cast<std::ptrdiff_t>(begin),
            played.sound.begin() + static_cast<std::ptrdiff_t>(end)};
}

double level_db(const std::vector<double>& sound) {
    double sum = 0;
    for (const double sample : sound) sum += sample * sample;
    return 10 * std::log10(sum / static_cast<double>(std::max<std::size_t>(1, sound.size())) + 1e-30);
}

double power_at(const std::vector<double>& sound, double frequency_hz) {
    const double w = 2 * std::numbers::pi * frequency_hz / rate_hz;
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < sound.size(); ++i) {
        const double x = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sound.size());
        sum += sound[i] * (0.5 - 0.5 * std::cos(x)) * std::polar(1.0, -w * static_cast<double>(i));
    }
    return std::norm(sum);
}

/// The strongest frequency between two, in steps of 2 cents.
double pitch_hz(const std::vector<double>& sound, double low_hz, double high_hz) {
    double best = 0, best_power = -1;
    for (double f = low_hz; f <= high_hz; f *= std::exp2(2.0 / 1200)) {
        const double power = power_at(sound, f);
        if (power > best_power) best_power = power, best = f;
    }
    return best;
}

void expect_pitch(const std::vector<double>& sound, double expected_hz) {
    const double found = pitch_hz(sound, expected_hz / 1.3, expected_hz * 1.3);
    EXPECT_NEAR(1200 * std::log2(found / expected_hz), 0, 8) << found << " Hz";
}

TEST(Cases, CoarseTuningIsHeard) {
    const auto played = play_case("01_rpn2_coarse");
    expect_pitch(between(played, 0.2, 0.9), 220);
    expect_pitch(between(played, 1.2, 1.9), 220 * std::exp2(2 / 12.0));
    expect_pitch(between(played, 2.2, 2.9), 110);
}

TEST(Cases, TheTuningStandardMovesOneKey) {
    const auto played = play_case("02_mts_single_rt");
    expect_pitch(between(played, 0.2, 0.9), 220);
    expect_pitch(between(played, 1.2, 1.9), 220 * std::exp2(0.5 / 12));
    expect_pitch(between(played, 2.2, 2.9), 220 * std::exp2(2 / 12.0));
}

TEST(Cases, MasterVolumeFallsToSilence) {
    for (const char* name : {"03_master_volume", "03b_gs_master_volume"}) {
        const auto played = play_case(name);
        const std::vector<double> values{127, 90, 64, 32};
        // The first note finds its string at rest, the others find what is left of the one before.
        EXPECT_NEAR(level_db(between(played, 1.1, 1.9)) - level_db(between(played, 0.1, 0.9)),
                    40 * std::log10(values[1] / 127), 1);
        const double full = level_db(between(played, 1.1, 1.9)) - 40 * std::log10(values[1] / 127);
        for (std::size_t i = 2; i < values.size(); ++i) {
            const double begin = 0.1 + static_cast<double>(i);
            EXPECT_NEAR(level_db(between(played, begin, begin + 0.8)) - full,
                        40 * std::log10(values[i] / 127), 0.1)
                << name << " " << values[i];
        }
        EXPECT_LT(level_db(between(played, 4.1, 4.9)), full - 70) << name;
    }
}

TEST(Cases, GeneralMidiOnStartsAnew) {
    const auto played = play_case("04_gm_on_mid");
    EXPECT_LT(level_db(between(played, 0.1, 0.8)), -200);
    EXPECT_GT(level_db(between(played, 1.2, 1.9)), -65);
    expect_pitch(between(played, 1.2, 1.9), 220);
}

TEST(Cases, DrumsAreSilentAndCounted) {
    for (const auto& [name, notes] : {std::pair{"05_xg_drums", 4}, {"05e_xg_kit", 8}, {"05b_gs_drums", 4}}) {
        const auto played = play_case(name);
        EXPECT_EQ(played.stats["silent_notes"], notes) << name;
        EXPECT_EQ(played.stats["notes"], 0) << name;
        EXPECT_NE(played.ran.err.find("notes are silent"), std::string::npos) << name;
    }
    const auto melody = play_case("05d_gm2_melody_ch10");
    EXPECT_EQ(melody.stats["silent_notes"], 0);
    EXPECT_EQ(melody.stats["notes"], 4);
}

TEST(Cases, SostenutoHoldsWhatIsDown) {
    std::string without = read_text(midi_cases + "06_sostenuto.mid");
    for (std::size_t at = without.find("\xB0\x42"); at != std::string::npos; at = without.find("\xB0\x42"))
        without[at + 1] = 3;
    const auto held = play_case("06_sostenuto");
    const auto ended = play_text(without);
    const double e3_hz = 440 * std::exp2((52 - 69) / 12.0);
    const double ratio = power_at(between(held, 1.0, 1.9), e3_hz) / power_at(between(ended, 1.0, 1.9), e3_hz);
    EXPECT_GT(10 * std::log10(ratio), 25);
    const double end = static_cast<double>(held.sound.size()) / rate_hz;  // and lets go when it goes up
    EXPECT_LT(level_db(between(held, end - 0.1, end)), level_db(between(held, 1.0, 1.9)) - 25);
}

TEST(Cases, PortamentoGlides) {
    const auto played = play_case("07_portamento");
    expect_pitch(between(played, 0.2, 0.9), 110);
    const double on_the_way = pitch_hz(between(played, 1.15, 1.35), 100, 160);
    EXPECT_GT(on_the_way, 114);
    EXPECT_LT(on_the_way, 140);
    expect_pitch(between(played, 1.55, 1.95), 110 * std::exp2(5 / 12.0));
}

TEST(Cases, PortsDoNotTouchEachOther) {
    const auto two = play_case("08_two_ports");
    ASSERT_EQ(two.stats["parts"].size(), 2U);
    EXPECT_EQ(two.stats["parts"][0]["preset"], "guitar-nylon");
    EXPECT_EQ(two.stats["parts"][1]["preset"], "bass-fretted");
    EXPECT_EQ(two.stats["parts"][1]["port"], 2);
    EXPECT_EQ(two.stats["silent_notes"], 0);
    // The bass's bend is its own: near the guitar's pitch nothing is louder than it.
    const double e4_hz = 440 * std::exp2((64 - 69) / 12.0);
    EXPECT_NEAR(pitch_hz(between(two, 0.05, 0.4), 310, 350), e4_hz, 2);
    const auto flute = play_case("08b_two_ports_flute", {"--only-strings"});
    EXPECT_EQ(flute.stats["notes"], 4);
    EXPECT_EQ(flute.stats["silent_notes"], 4);
}

TEST(Cases, ANoteOffEndsTheNoteItBelongsTo) {
    for (const char* preset : {"guitar-steel", "bass-fretted", "harpsichord"}) {
        const std::vector<std::string> options{"--preset", preset};
        const auto handover = play_case("09_unison_handover_tracks", options);
        const auto alone = play_case("09_control", options);
        EXPECT_NEAR(level_db(between(handover, 1.1, 1.9)), level_db(between(alone, 1.1, 1.9)), 1.5) << preset;
        const auto overlap = play_case("10b_unison_half_and_quarter", options);
        const auto half = play_case("10b_control", options);
        EXPECT_NEAR(level_db(between(overlap, 0.55, 0.95)), level_db(between(half, 0.55, 0.95)), 1.5)
            << preset;
    }
}

TEST(BrokenCases, PlayWithANoticeAndAreRefusedStrictly) {
    const std::vector<std::pair<std::string, int>> files{{"16a_missing_eot", 2},
                                                         {"16b_running_after_meta", 2},
                                                         {"16d_type0_two_tracks", 2},
                                                         {"16e_three_announced_two_there", 2},
                                                         {"16f_one_announced_two_there", 2},
                                                         {"16g_type2_one_track", 2},
                                                         {"16h_length_too_long", 2},
                                                         {"16i2_notes_after_eot", 2},
                                                         {"16l_macbinary", 2},
                                                         {"16q_empty_track", 2},
                                                         {"16t_realtime_bytes", 1}};
    for (const auto& [name, notes] : files) {
        const auto played = play_case(name, {"--preset", "guitar-steel"});
        EXPECT_EQ(played.stats["notes"], notes) << name;
        ASSERT_EQ(played.stats["repairs"].size(), 1U) << name;
        EXPECT_EQ(played.ran.error_lines(), 1) << name << played.ran.err;
        EXPECT_EQ(played.ran.err.rfind("notice: ", 0), 0U) << played.ran.err;
        EXPECT_NE(played.ran.err.find(": byte "), std::string::npos) << played.ran.err;
        const TemporaryFolder folder;
        const Ran strict =
            jawari({"render", midi_cases + name + ".mid", "-o", folder.file("o.wav"), "--strict"});
        EXPECT_EQ(strict.exit_code, 3) << name;
        EXPECT_EQ(strict.error_lines(), 1) << strict.err;
        EXPECT_TRUE(folder.names().empty());
    }
}

TEST(Cases, MusicEndsWithItsLastMessage) {
    const auto played = play_case("17_eot_81_minutes", {"--preset", "guitar-steel"});
    EXPECT_LT(played.stats["sound_s"], 2.1);
    EXPECT_NE(played.ran.err.find("end of track: 4888 s after the last note"), std::string::npos);
}

TEST(Cases, AScoreHasAsManyFramesAsItLasts) {
    EXPECT_EQ(play_case("44_exact_2s").sound.size(), 96000U);
}

TEST(Cases, ABankOfGsOrXgIsNotOurs) {
    EXPECT_EQ(play_case("45_bank_0_1_0").stats["parts"][0]["preset"], "dulcimer");
    EXPECT_EQ(play_case("45_bank_0_1_24").stats["parts"][0]["preset"], "guitar-nylon");
    std::string ours = read_text(midi_cases + "45_bank_0_1_0.mid");
    const std::size_t at = ours.find(std::string("\xB0\x00\x00\x00\xB0\x20\x01", 7));
    ASSERT_NE(at, std::string::npos);
    ours[at + 2] = 74;
    ours[at + 6] = 87;
    EXPECT_EQ(play_text(ours).stats["parts"][0]["preset"], "bass-fretted");
}

TEST(Cases, ACourseIsOneNote) {
    const auto played = play_case("46_four_notes", {"--preset", "guitar-12"});
    EXPECT_EQ(played.stats["notes"], 4);
    EXPECT_EQ(played.stats["parts"][0]["notes"], 4);
    EXPECT_EQ(played.stats["strokes"], 8);
}

TEST(Cases, WhatIsIgnoredIsSaidOnceForEachKind) {
    std::string midi = read_text(midi_cases + "03b_gs_master_volume.mid");
    std::size_t at = 0;  // the five volumes become reverb levels
    for (int i = 0; i < 5; ++i) {
        at = midi.find(std::string("\x40\x00\x04", 3), at);
        ASSERT_NE(at, std::string::npos);
        midi.replace(at, 3, std::string("\x40\x01\x33", 3));
    }
    const auto played = play_text(midi);
    EXPECT_EQ(played.ran.err, "notice: 5 messages do nothing: system exclusive: GS reverb\n");
    EXPECT_EQ(played.stats["ignored"],
              nlohmann::json::parse(R"([{"what": "system exclusive: GS reverb", "messages": 5}])"));
}

}  // namespace
}  // namespace jawari::host
