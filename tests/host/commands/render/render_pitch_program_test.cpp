// Every note of a chromatic scale, plucked softly enough not to strike a fret, is in tune: measured from the
// WAV.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "support/midi_bytes.h"
#include "support/read_wav.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

constexpr double pi = std::numbers::pi;

/// sum of x[n] exp(-i w n) under a four-term Blackman-Harris window, whose side lobes (-92 dB) keep other
/// partials out when the window spans at least four periods of the first. n counts from the start of x, so
/// that phases of windows compare.
std::complex<double> windowed(const std::vector<double>& x, std::size_t begin, std::size_t length, double w) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < length; ++i) {
        const double p = 2 * pi * static_cast<double>(i) / static_cast<double>(length - 1);
        const double window =
            0.35875 - 0.48829 * std::cos(p) + 0.14128 * std::cos(2 * p) - 0.01168 * std::cos(3 * p);
        const double n = static_cast<double>(begin + i);
        sum += x[begin + i] * window * std::polar(1.0, -w * n);
    }
    return sum;
}

/// Frequency near `expected_hz` from the phase that it gains between two windows; unambiguous within +-1/(2
/// hop seconds).
double measured_hz(const std::vector<double>& x, std::size_t begin, double expected_hz, double rate_hz) {
    const auto length = static_cast<std::size_t>(0.4 * rate_hz);
    const auto hop = static_cast<std::size_t>(0.3 * rate_hz);
    const double w = 2 * pi * expected_hz / rate_hz;
    const auto first = windowed(x, begin, length, w);
    const auto second = windowed(x, begin + hop, length, w);
    return expected_hz + std::arg(second * std::conj(first)) / (2 * pi) * rate_hz / static_cast<double>(hop);
}

double cents(double frequency_hz, double reference_hz) {
    return 1200 * std::log2(frequency_hz / reference_hz);
}

TEST(RenderPitch, TheEstimatorFindsAKnownFrequencyAmongPartials) {
    for (const double true_hz : {41.0, 41.5, 98.3, 310.0}) {
        std::vector<double> x;
        for (int n = 0; n < 40000; ++n) {
            const double t = n / 48000.0;
            double sum = 0;
            for (int k = 1; k <= 20; ++k)
                sum += std::exp(-0.5 * k * t) * std::sin(2 * pi * true_hz * k * (1 + 1e-4 * (k - 1)) * t + k);
            x.push_back(sum);
        }
        EXPECT_NEAR(cents(measured_hz(x, 1000, true_hz * 1.003, 48000), true_hz), 0, 0.02) << true_hz;
    }
}

constexpr int lowest_key = 28;   // E1
constexpr int highest_key = 63;  // the 20th fret of the G string
constexpr int note_ms = 1000;
constexpr int pause_ms = 200;

/// One tick is a millisecond.
std::string chromatic_scale(int velocity) {
    Bytes track;
    for (int key = lowest_key; key <= highest_key; ++key) {
        append_event(track, key == lowest_key ? 0 : pause_ms,
                     {0x90, static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(velocity)});
        append_event(track, note_ms, {0x80, static_cast<std::uint8_t>(key), 0});
    }
    append_event(track, 0, end_of_track);
    const Bytes bytes = file_with_track(track, 500);
    return {bytes.begin(), bytes.end()};
}

TEST(RenderPitch, ChromaticScaleIsWithinOneCent) {
    const TemporaryFolder folder;
    const std::string midi = folder.write("scale.mid", chromatic_scale(30));
    const Ran ran = jawari({"render", midi, "--preset", "bass-fretted", "-o", folder.file("scale.wav"),
                            "--format", "float", "--stats", folder.file("stats.json")});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto stats = nlohmann::json::parse(read_text(folder.file("stats.json")));
    EXPECT_EQ(stats["notes"], highest_key - lowest_key + 1);
    EXPECT_EQ(stats["ignored_notes"], 0);
    EXPECT_EQ(stats["impulses"], 0) << "a soft note struck a fret";

    const auto sound = read_wav(folder.file("scale.wav")).channel(0);
    double worst = 0;
    for (int key = lowest_key; key <= highest_key; ++key) {
        const double equal_tempered_hz = 440 * std::pow(2.0, (key - 69) / 12.0);
        const auto start = static_cast<std::size_t>(key - lowest_key) * 48 * (note_ms + pause_ms) + 48 * 200;
        ASSERT_LT(start + 48 * 700, sound.size());
        const double error = cents(measured_hz(sound, start, equal_tempered_hz, 48000), equal_tempered_hz);
        EXPECT_NEAR(error, 0, 1) << "key " << key;
        worst = std::max(worst, std::abs(error));
    }
    RecordProperty("worst_cents", std::to_string(worst));
    std::printf("worst error: %.4f cents\n", worst);
}

}  // namespace
}  // namespace jawari::host
