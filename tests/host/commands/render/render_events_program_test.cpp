// What MIDI messages do to the sound, end to end: bends, tuning, volume, pan, maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "support/midi_bytes.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

constexpr double pi = 3.14159265358979323846;
constexpr double rate_hz = 48000;

/// A note of 1.2 s on channel 1 after some messages; a tick is a millisecond.
std::string note(int key, int velocity, const std::vector<Bytes>& before = {}) {
    Bytes track;
    for (const Bytes& message : before) append_event(track, 0, message);
    append_event(track, 0, {0x90, static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(velocity)});
    append_event(track, 1200, {0x80, static_cast<std::uint8_t>(key), 64});
    append_event(track, 0, end_of_track);
    const Bytes bytes = file_with_track(track, 500);
    return {bytes.begin(), bytes.end()};
}

Wav render(const std::string& midi, std::vector<std::string> options = {},
           const std::string& preset = "bass-fretted") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"render",   folder.write("in.mid", midi),
                                       "--preset", preset,
                                       "-o",       folder.file("out.wav"),
                                       "--format", "float",
                                       "--tail",   "0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ran ran = jawari(arguments);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return read_wav(folder.file("out.wav"));
}

/// Frequency of the strongest peak within 60 cents of `expected_hz`, from a fine Hann-windowed periodogram.
double measured_hz(const std::vector<double>& sound, double expected_hz) {
    const std::size_t begin = 9600, length = 43200;
    EXPECT_GE(sound.size(), begin + length);
    if (sound.size() < begin + length) return 0;
    double best = 0, best_power = -1;
    for (double cents = -60; cents <= 60; cents += 0.5) {
        const double w = 2 * pi * expected_hz * std::exp2(cents / 1200) / rate_hz;
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < length; ++i) {
            const double hann = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(i) / length);
            sum += sound[begin + i] * hann * std::polar(1.0, -w * static_cast<double>(i));
        }
        if (std::norm(sum) > best_power) {
            best_power = std::norm(sum);
            best = cents;
        }
    }
    return expected_hz * std::exp2(best / 1200);
}

double cents(double a, double b) {
    return 1200 * std::log2(a / b);
}

double energy(const std::vector<double>& sound) {
    double sum = 0;
    for (const double sample : sound) sum += sample * sample;
    return sum;
}

double key_hz(double key) {
    return 440 * std::exp2((key - 69) / 12);
}

TEST(RenderEvents, APitchBendBendsByItsRange) {
    const auto straight = render(note(45, 30)).channel(0);
    EXPECT_NEAR(cents(measured_hz(straight, key_hz(45)), key_hz(45)), 0, 3);
    const auto bent = render(note(45, 30, {{0xE0, 0x7F, 0x7F}})).channel(0);
    EXPECT_NEAR(cents(measured_hz(bent, key_hz(47)), key_hz(47)), 0, 5);
    const auto wide =
        render(note(45, 30, {{0xB0, 101, 0}, {0xB0, 100, 0}, {0xB0, 6, 12}, {0xE0, 0, 80}})).channel(0);
    EXPECT_NEAR(cents(measured_hz(wide, key_hz(48)), key_hz(48)), 0, 5);  // a quarter of an octave
}

TEST(RenderEvents, AScaleTunesTheStrings) {
    const TemporaryFolder folder;
    // Seven equal steps, linear from key 45 at 100 Hz: key 48 is 100 x 2^(3/7) Hz.
    const std::string scale = folder.write(
        "seven.scl", "7-TET\n7\n171.42857\n342.85714\n514.28571\n685.71429\n857.14286\n1028.57143\n2/1\n");
    const std::string map = folder.write("a.kbm", "0\n0\n127\n45\n45\n100.0\n0\n");
    const double expected = 100 * std::exp2(3 / 7.0);
    for (const bool moves : {false, true}) {
        std::vector<std::string> options{"--tuning", scale, "--keyboard-map", map};
        if (moves) options.emplace_back("--move-frets");
        const auto tuned = render(note(48, 30), options).channel(0);
        EXPECT_NEAR(cents(measured_hz(tuned, expected), expected), 0, 3) << moves;
    }
}

TEST(RenderEvents, VolumeAndPanAreHeard) {
    const auto full = render(note(40, 60));
    const auto half = render(note(40, 60, {{0xB0, 7, 64}}));
    EXPECT_NEAR(10 * std::log10(energy(half.channel(0)) / energy(full.channel(0))), -12.04, 0.1);
    const auto left = render(note(40, 60, {{0xB0, 10, 0}}));
    EXPECT_GT(energy(left.channel(0)), 1e3 * energy(left.channel(1)));
    const auto right = render(note(40, 60, {{0xB0, 10, 127}}));
    EXPECT_GT(energy(right.channel(1)), 1e3 * energy(right.channel(0)));
    const auto middle = render(note(40, 60, {{0xB0, 10, 64}}));
    EXPECT_NEAR(energy(middle.channel(0)) / energy(middle.channel(1)), 1, 1e-9);
}

TEST(RenderEvents, AMapAndASettingMoveTheSameParameter) {
    const TemporaryFolder folder;
    const std::string map = folder.write("map.json", R"({"schema": "jawari.midi-map/1", "bindings": [
        {"controller": 20, "parameter": "palm_mute", "from": 0, "to": 0.5},
        {"controller": 7, "parameter": "none"}]})");
    const auto mapped = render(note(40, 60, {{0xB0, 20, 127}, {0xB0, 7, 10}}), {"--midi-map", map});
    const auto set = render(note(40, 60), {"--set", "palm_mute=0.5"});
    EXPECT_TRUE(mapped.data == set.data);
    EXPECT_FALSE(mapped.data == render(note(40, 60)).data);
}

TEST(RenderEvents, KeysThatNoStringHasAreNamed) {
    const TemporaryFolder folder;
    for (const auto& [key, named] : {std::pair{38, true}, std::pair{37, false}, std::pair{49, false}}) {
        const Ran ran = jawari({"render", folder.write("in.mid", note(key, 60)), "--preset", "sitar", "-o",
                                folder.file("out.wav"), "--tail", "0"});
        EXPECT_EQ(ran.exit_code, 0);
        EXPECT_EQ(
            ran.err.find("sitar: no string has the keys 38; their notes are not played") != std::string::npos,
            named)
            << ran.err;
    }
}

TEST(RenderEvents, StemsOfAnInstrumentWithoutPickupsAddUpToItsMonoSound) {
    const TemporaryFolder folder;
    const auto mix = render(note(60, 90), {"--stems", folder.file("stems.wav")}, "guitar-nylon");
    const auto stems = read_wav(folder.file("stems.wav"));
    ASSERT_EQ(stems.channels, 6);
    const auto left = mix.channel(0), right = mix.channel(1);
    std::size_t sounding = 0;
    for (std::size_t s = 0; s < 6; ++s) sounding += energy(stems.channel(s)) > 1e-6 ? 1 : 0;
    EXPECT_EQ(sounding, 1U);
    const auto each = stems.samples();
    for (std::size_t n = 0; n < left.size(); ++n) {
        double sum = 0;
        for (std::size_t s = 0; s < 6; ++s) sum += each[n * 6 + s];
        ASSERT_NEAR(sum, (left[n] + right[n]) / 2, 1e-5) << n;
    }
}

TEST(RenderEvents, StemsAddUpToTheMixOfABassWithoutABody) {
    const TemporaryFolder folder;
    const auto mix = render(note(40, 60), {"--stems", folder.file("stems.wav")});
    const auto stems = read_wav(folder.file("stems.wav"));
    ASSERT_EQ(stems.channels, 4);
    std::vector<double> sum(mix.channel(0).size(), 0.0);
    for (std::size_t s = 0; s < 4; ++s) {
        const auto stem = stems.channel(s);
        ASSERT_EQ(stem.size(), sum.size());
        for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += stem[n];
    }
    // In the middle both sides carry the same share of it.
    const auto left = mix.channel(0);
    const double share = std::sqrt(energy(left) / energy(sum));
    EXPECT_GT(share, 0.5);
    for (std::size_t n = 0; n < sum.size(); ++n) ASSERT_NEAR(left[n], share * sum[n], 1e-6);
}

}  // namespace
}  // namespace jawari::host
