#include "plot/audio_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "plot/figure.h"
#include "plot/gnuplot.h"

namespace jawari::host {
namespace {

using namespace plot;  // figures and gnuplot

constexpr int width_px = 1120;
constexpr int height_px = 700;
constexpr std::size_t waveform_columns = 1100;
constexpr double dynamic_range_db = 90;

Panel panel(double bottom_px, double top_px) {
    constexpr double left_px = 84, right_px = 120;
    Panel place;
    place.left = left_px / width_px;
    place.right = (width_px - right_px) / width_px;
    place.margin = right_px / width_px;
    place.bottom = bottom_px / height_px;
    place.top = top_px / height_px;
    return place;
}

/// Lowest and highest sample of each column, as `time low high`.
std::string waveform_data(std::span<const float> samples, double rate_hz) {
    const std::size_t columns = std::min(waveform_columns, samples.size());
    std::string data = "$waveform << EOD\n";
    for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t from = samples.size() * c / columns;
        const std::size_t to = samples.size() * (c + 1) / columns;
        const auto [low, high] = std::minmax_element(samples.begin() + static_cast<std::ptrdiff_t>(from),
                                                     samples.begin() + static_cast<std::ptrdiff_t>(to));
        data += number(static_cast<double>(from) / rate_hz) + ' ' + number(static_cast<double>(*low)) + ' ' +
                number(static_cast<double>(*high)) + '\n';
    }
    if (columns == 0) data += "0 0 0\n";
    return data + "EOD\n";
}

std::string waveform_panel(std::span<const float> samples, double rate_hz, double duration_s) {
    double peak = 0;
    for (const float sample : samples) peak = std::max(peak, std::abs(static_cast<double>(sample)));
    const double limit = peak > 0 ? 1.08 * peak : 1;
    std::string title = "waveform";
    if (peak > 0) {
        std::array<char, 48> text{};
        std::snprintf(text.data(), text.size(), ", peak %.1f dB of full scale", 20 * std::log10(peak));
        title += text.data();
    }
    return waveform_data(samples, rate_hz) + "set title " + quote(title) + "\n" +
           set_range("x", {0, duration_s, false}) + set_range("y", {-limit, limit, false}) +
           "set ylabel 'amplitude (full scale = 1)'\nset xlabel 'time (s)'\nunset key\n"
           "plot $waveform using 1:2:3 with filledcurves fc rgb '#0072b2' notitle, \\\n"
           "     $waveform using 1:2 with lines lw 1 lc rgb '#0072b2' notitle, \\\n"
           "     $waveform using 1:3 with lines lw 1 lc rgb '#0072b2' notitle\n";
}

/// Tics at round frequencies on an axis of log10(f).
std::string frequency_tics(double lowest_hz, double highest_hz) {
    std::string tics;
    for (const double decade : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
        for (const double step : {1.0, 2.0, 5.0}) {
            const double f = decade * step;
            if (f < lowest_hz || f > highest_hz) continue;
            const std::string text = f >= 1000 ? number(f / 1000) + " k" : number(f);
            tics += (tics.empty() ? "" : ", ") + quote(text) + " " + number(std::log10(f));
        }
    }
    return "set ytics (" + tics + ")\n";
}

std::string spectrogram_panel(std::span<const float> samples, double rate_hz, double duration_s,
                              const SpectrogramGrid& grid) {
    const Spectrogram picture = spectrogram(samples, rate_hz, grid);
    double loudest = grid.floor_db;
    for (const double level : picture.level_db) loudest = std::max(loudest, level);
    const double top = loudest > grid.floor_db ? 5 * std::ceil(loudest / 5) : 0;
    const double bottom = top - dynamic_range_db;

    std::string data = "$levels << EOD\n";
    for (std::size_t row = 0; row < picture.rows; ++row) {
        for (std::size_t column = 0; column < picture.columns; ++column) {
            // A tenth of a decibel is finer than the colours.
            const double level = std::max(bottom, picture.at(row, column));
            data += number(std::round(10 * level) / 10) + (column + 1 < picture.columns ? ' ' : '\n');
        }
    }
    data += "EOD\n";

    const double low = std::log10(picture.lowest_hz), high = std::log10(picture.highest_hz);
    const double dx = duration_s / static_cast<double>(picture.columns);
    const double dy = (high - low) / static_cast<double>(picture.rows);
    return data + inferno_palette() + "set title 'spectrogram'\n" + set_range("x", {0, duration_s, false}) +
           set_range("y", {low, high, false}) + set_range("cb", {bottom, top, false}) +
           frequency_tics(picture.lowest_hz, picture.highest_hz) +
           "set cblabel 'level (dB of full scale)'\nset xlabel 'time (s)'\nset ylabel 'frequency (Hz)'\n"
           "unset grid\nunset key\nset border 15\n"
           "plot $levels matrix using (($1+0.5)*" +
           number(dx) + "):(" + number(low) + "+($2+0.5)*" + number(dy) + "):3 with image notitle\n";
}

}  // namespace

MaybeError plot_audio(std::span<const float> samples, double rate_hz, const std::string& title,
                      const std::string& path, const SpectrogramGrid& grid) {
    const double duration_s = std::max(static_cast<double>(samples.size()), 1.0) / rate_hz;
    std::string script = "set multiplot title " + quote(title) + " font ',16' offset 0,0.1\n";
    script += common_style() + panel(482, 622).place() + waveform_panel(samples, rate_hz, duration_s);
    script += "reset\n" + common_style() + panel(62, 394).place() +
              spectrogram_panel(samples, rate_hz, duration_s, grid);
    return draw(path, width_px, height_px, script + "unset multiplot\n");
}

}  // namespace jawari::host
