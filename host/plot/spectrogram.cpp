#include "plot/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace jawari::host::plot {
namespace {

std::size_t power_of_two_from(double samples) {
    std::size_t size = 16;
    while (static_cast<double>(size) < samples && size < (std::size_t{1} << 20)) size *= 2;
    return size;
}

/// Hann window scaled so that a sine of amplitude 1 has magnitude 1 in its bin.
std::vector<double> hann_window(std::size_t size) {
    std::vector<double> window(size);
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const double s =
            std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(size));
        window[i] = s * s;
        sum += window[i];
    }
    for (double& value : window) value *= 2 / sum;
    return window;
}

/// Power spectra of windows of one sound.
class WindowedSpectrum {
  public:
    WindowedSpectrum(std::span<const float> samples, std::size_t size)
        : samples_(samples), window_(hann_window(size)), frame_(size), power_(size / 2 + 1) {
        fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    }

    const std::vector<double>& power_around(double centre) {
        const auto size = static_cast<std::ptrdiff_t>(window_.size());
        const auto start = static_cast<std::ptrdiff_t>(std::llround(centre)) - size / 2;
        for (std::ptrdiff_t i = 0; i < size; ++i) {
            const std::ptrdiff_t n = start + i;
            const bool inside = n >= 0 && n < static_cast<std::ptrdiff_t>(samples_.size());
            const auto index = static_cast<std::size_t>(i);
            frame_[index] =
                inside ? window_[index] * static_cast<double>(samples_[static_cast<std::size_t>(n)]) : 0.0;
        }
        fft_.fwd(spectrum_, frame_);
        for (std::size_t bin = 0; bin < power_.size(); ++bin) power_[bin] = std::norm(spectrum_[bin]);
        return power_;
    }

  private:
    std::span<const float> samples_;
    std::vector<double> window_;
    std::vector<double> frame_;
    std::vector<std::complex<double>> spectrum_;
    std::vector<double> power_;
    Eigen::FFT<double> fft_;
};

/// Power at a frequency between two bins, interpolated; the largest of the bins that a row of the picture
/// covers, if several.
double power_of_row(const std::vector<double>& power, double low_bin, double high_bin) {
    const double last = static_cast<double>(power.size() - 1);
    const auto first_inside = static_cast<std::size_t>(std::clamp(std::ceil(low_bin), 0.0, last));
    const auto last_inside = static_cast<std::size_t>(std::clamp(std::floor(high_bin), 0.0, last));
    if (first_inside <= last_inside && high_bin - low_bin >= 1) {
        return *std::max_element(power.begin() + static_cast<std::ptrdiff_t>(first_inside),
                                 power.begin() + static_cast<std::ptrdiff_t>(last_inside) + 1);
    }
    const double bin = std::clamp(0.5 * (low_bin + high_bin), 0.0, last);
    const auto below = static_cast<std::size_t>(bin);
    const std::size_t above = std::min(below + 1, power.size() - 1);
    const double share = bin - static_cast<double>(below);
    return (1 - share) * power[below] + share * power[above];
}

}  // namespace

Spectrogram spectrogram(std::span<const float> samples, double rate_hz, const SpectrogramGrid& grid) {
    Spectrogram result;
    result.columns = grid.columns;
    result.rows = grid.rows;
    result.highest_hz = std::min(grid.highest_hz, rate_hz / 2);
    result.lowest_hz = std::min(grid.lowest_hz, result.highest_hz / 2);
    result.level_db.assign(grid.rows * grid.columns, grid.floor_db);
    const std::size_t size = power_of_two_from(grid.window_s * rate_hz);
    WindowedSpectrum spectrum(samples, size);

    const double column_samples = static_cast<double>(samples.size()) / static_cast<double>(grid.columns);
    const auto windows =
        static_cast<std::size_t>(std::max(1.0, std::ceil(2 * column_samples / static_cast<double>(size))));
    const double octaves = std::log2(result.highest_hz / result.lowest_hz);
    const auto bin_at = [&](double row) {
        const double f = result.lowest_hz * std::exp2(octaves * row / static_cast<double>(grid.rows));
        return f * static_cast<double>(size) / rate_hz;
    };
    std::vector<double> mean(grid.rows);
    for (std::size_t column = 0; column < grid.columns; ++column) {
        std::fill(mean.begin(), mean.end(), 0.0);
        for (std::size_t w = 0; w < windows; ++w) {
            const double share = (static_cast<double>(w) + 0.5) / static_cast<double>(windows);
            const auto& power = spectrum.power_around((static_cast<double>(column) + share) * column_samples);
            for (std::size_t row = 0; row < grid.rows; ++row) {
                const double r = static_cast<double>(row);
                mean[row] += power_of_row(power, bin_at(r), bin_at(r + 1)) / static_cast<double>(windows);
            }
        }
        for (std::size_t row = 0; row < grid.rows; ++row) {
            const double level = mean[row] > 0 ? 10 * std::log10(mean[row]) : grid.floor_db;
            result.level_db[row * grid.columns + column] = std::max(level, grid.floor_db);
        }
    }
    return result;
}

}  // namespace jawari::host::plot
