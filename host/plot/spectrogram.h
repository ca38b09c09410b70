// Short-time spectrum of a sound, averaged into a grid of times and of logarithmically spaced frequencies.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace jawari::host::plot {

struct SpectrogramGrid {
    std::size_t columns = 900;
    std::size_t rows = 300;
    double lowest_hz = 30;      ///< > 0
    double highest_hz = 20000;  ///< lowered to half the rate
    double window_s = 0.06;     ///< Hann window, rounded up to a power of two samples
    double floor_db = -200;     ///< of silence
};

struct Spectrogram {
    std::size_t columns = 0;
    std::size_t rows = 0;
    double lowest_hz = 0;
    double highest_hz = 0;
    /// rows x columns, lowest frequency first, in dB: a sine of amplitude 1 reads 0 dB at its frequency.
    std::vector<double> level_db;
    [[nodiscard]] double at(std::size_t row, std::size_t column) const {
        return level_db[row * columns + column];
    }
};

/// Windows are centred on their columns and overlap by at least half; a column shows the mean power of its
/// windows, so that nothing between two columns of a long sound is lost. The sound is silent before its start
/// and after its end.
Spectrogram spectrogram(std::span<const float> samples, double rate_hz, const SpectrogramGrid& grid);

}  // namespace jawari::host::plot
