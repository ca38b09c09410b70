#include "plot/spectrogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace jawari::host::plot {
namespace {

std::vector<float> sine(double amplitude, double frequency_hz, double rate_hz, std::size_t count) {
    std::vector<float> samples(count);
    for (std::size_t n = 0; n < count; ++n) {
        const double phase = 2 * std::numbers::pi * frequency_hz * static_cast<double>(n) / rate_hz;
        samples[n] = static_cast<float>(amplitude * std::sin(phase));
    }
    return samples;
}

std::size_t loudest_row(const Spectrogram& picture, std::size_t column) {
    std::size_t best = 0;
    for (std::size_t row = 1; row < picture.rows; ++row) {
        if (picture.at(row, column) > picture.at(best, column)) best = row;
    }
    return best;
}

double frequency_of(const Spectrogram& picture, double row) {
    return picture.lowest_hz *
           std::pow(picture.highest_hz / picture.lowest_hz, (row + 0.5) / static_cast<double>(picture.rows));
}

TEST(PlotSpectrogram, SineReadsItsLevelAtItsFrequency) {
    const SpectrogramGrid grid{.columns = 40, .rows = 300};
    for (const double frequency : {100.0, 440.0, 3000.0, 12000.0}) {
        const auto samples = sine(0.1, frequency, 48000, 48000);
        const Spectrogram picture = spectrogram(samples, 48000, grid);
        const std::size_t row = loudest_row(picture, 20);
        // Between two bins the Hann window loses up to 1.4 dB.
        EXPECT_NEAR(picture.at(row, 20), -20, 1.5) << frequency;
        const double bin_hz = 48000.0 / 4096;
        EXPECT_NEAR(frequency_of(picture, static_cast<double>(row)), frequency, bin_hz + 0.03 * frequency)
            << frequency;
    }
}

TEST(PlotSpectrogram, TimeRunsFromLeftToRight) {
    std::vector<float> samples = sine(1, 1000, 48000, 48000);
    const auto later = sine(1, 4000, 48000, 48000);
    samples.insert(samples.end(), later.begin(), later.end());
    const Spectrogram picture = spectrogram(samples, 48000, {.columns = 100, .rows = 200});
    EXPECT_NEAR(frequency_of(picture, static_cast<double>(loudest_row(picture, 25))), 1000, 50);
    EXPECT_NEAR(frequency_of(picture, static_cast<double>(loudest_row(picture, 75))), 4000, 150);
}

TEST(PlotSpectrogram, ShortEventsInLongSoundsAreSeen) {
    // One click in 100 s, between the centres of columns 3 s wide.
    std::vector<float> samples(800000, 0.0F);
    samples[411111] = 1;
    const SpectrogramGrid grid{.columns = 30, .rows = 50, .window_s = 0.03};
    const Spectrogram picture = spectrogram(samples, 8000, grid);
    const std::size_t column = 411111 * 30 / 800000;
    EXPECT_GT(picture.at(25, column), grid.floor_db + 50);
    EXPECT_EQ(picture.at(25, column + 2), grid.floor_db);
}

TEST(PlotSpectrogram, SilenceAndNothingAreTheFloor) {
    const SpectrogramGrid grid{.columns = 10, .rows = 10};
    for (const std::size_t count : {0u, 1u, 5000u}) {
        const Spectrogram picture = spectrogram(std::vector<float>(count, 0.0F), 44100, grid);
        for (const double level : picture.level_db) EXPECT_EQ(level, grid.floor_db);
    }
}

}  // namespace
}  // namespace jawari::host::plot
