#include "plot/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "plot/gnuplot.h"
namespace jawari::host::plot {

Scale scale_for(double largest, std::string_view unit) {
    struct Prefix {
        double from;
        double factor;
        const char* text;
    };
    static constexpr std::array<Prefix, 6> prefixes{{{1e6, 1e-6, "M"},
                                                     {1e4, 1e-3, "k"},
                                                     {0.5, 1, ""},
                                                     {5e-4, 1e3, "m"},
                                                     {5e-7, 1e6, "µ"},
                                                     {0, 1e9, "n"}}};
    if (!(largest > 0) || !std::isfinite(largest)) return {1, std::string(unit)};
    for (const Prefix& prefix : prefixes) {
        if (largest >= prefix.from) return {prefix.factor, prefix.text + std::string(unit)};
    }
    return {1, std::string(unit)};
}

std::string number(double value) {
    if (!std::isfinite(value)) return "NaN";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    return text.data();
}

void Range::include(double value) {
    if (!std::isfinite(value)) return;
    low = empty ? value : std::min(low, value);
    high = empty ? value : std::max(high, value);
    empty = false;
}

Range padded(Range range, double share) {
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    double margin = range.width() * share;
    if (!(range.width() > 1e-9 * size)) margin = size > 0 ? 0.1 * size : 1;
    range.low -= margin;
    range.high += margin;
    range.empty = false;
    return range;
}

std::string set_range(std::string_view axis, const Range& range) {
    return "set " + std::string(axis) + "range [" + number(range.low) + ":" + number(range.high) + "]\n";
}

Polyline envelope(std::span<const double> x, std::span<const double> y, std::size_t most) {
    Polyline line;
    const std::size_t count = std::min(x.size(), y.size());
    if (count <= most) {
        line.x.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count));
        line.y.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(count));
        return line;
    }
    const std::size_t intervals = std::max<std::size_t>(1, most / 2);
    for (std::size_t i = 0; i < intervals; ++i) {
        const auto from = y.begin() + static_cast<std::ptrdiff_t>(count * i / intervals);
        const auto to = y.begin() + static_cast<std::ptrdiff_t>(count * (i + 1) / intervals);
        const auto [low, high] = std::minmax_element(from, to);
        for (const auto& extreme : {std::min(low, high), std::max(low, high)}) {
            line.x.push_back(x[static_cast<std::size_t>(extreme - y.begin())]);
            line.y.push_back(*extreme);
        }
    }
    return line;
}

std::string datablock(std::string_view name, std::span<const Polyline> lines) {
    std::string text = "$" + std::string(name) + " << EOD\n";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0) text += '\n';
        for (std::size_t j = 0; j < lines[i].x.size(); ++j) {
            text += number(lines[i].x[j]) + ' ' + number(lines[i].y[j]) + '\n';
        }
    }
    return text + "EOD\n";
}

std::string Panel::place() const {
    return "set lmargin at screen " + number(left) + "\nset rmargin at screen " + number(right) +
           "\nset bmargin at screen " + number(bottom) + "\nset tmargin at screen " + number(top) +
           "\nset colorbox user origin screen " + number(right + 0.12 * margin) + "," + number(bottom) +
           " size screen " + number(0.13 * margin) + "," + number(top - bottom) + " noborder\n";
}

std::string Panel::legend_beside() const {
    return "set key at screen " + number(right + 0.03 * margin) + "," + number(top) +
           " left top Left reverse vertical maxcols 1 samplen 1.5 spacing 1.3\n";
}

std::string Panel::legend_below_bar() const {
    return "set key at screen " + number(right + 0.1 * margin) + "," + number(bottom - 0.3 * foot) +
           " left top Left reverse vertical maxcols 1 samplen 1 spacing 1.1\n";
}

std::string Panel::y_label(const std::string& text) const {
    return "set label 1 " + quote(text) + " at screen " + number(left - 0.87 * edge) + "," +
           number((bottom + top) / 2) + " center rotate by 90 textcolor rgb '#303030'\n";
}

std::string shortened(std::string_view text, std::size_t most) {
    std::vector<std::size_t> starts;  // of characters: bytes that do not continue one
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) starts.push_back(i);
    if (starts.size() <= most) return std::string(text);
    const std::size_t kept = most - 1;
    const std::size_t from_end = kept / 2;
    const std::size_t head = starts[kept - from_end];
    const std::size_t tail = from_end == 0 ? text.size() : starts[starts.size() - from_end];
    return std::string(text.substr(0, head)) + "…" + std::string(text.substr(tail));
}

std::string common_style() {
    return "set border 3 lw 1 lc rgb '#606060'\n"
           "set tics nomirror out scale 0.6 textcolor rgb '#303030'\n"
           "set grid lw 1 lc rgb '#e4e4e4'\n"
           "set title font ',13' textcolor rgb '#202020' offset 0,-0.4\n"
           "set xlabel textcolor rgb '#303030' offset 0,0.3\nset ylabel textcolor rgb '#303030'\n"
           "set cblabel textcolor rgb '#303030'\n"
           "set style line 1 lw 1\n";
}

std::string line_colour(std::size_t index) {
    static constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                        "#56b4e9", "#e69f00", "#404040"};
    return colours[index % colours.size()];
}

std::string viridis_palette() {
    return "set palette defined (0 '#440154', 1 '#46327e', 2 '#365c8d', 3 '#277f8e', 4 '#1fa187', 5 "
           "'#4ac16d', "
           "6 '#a0da39', 7 '#e3d21b')\n";
}

std::string inferno_palette() {
    return "set palette defined (0 '#000004', 1 '#1b0c41', 2 '#4a0c6b', 3 '#781c6d', 4 '#a52c60', 5 "
           "'#cf4446', "
           "6 '#ed6925', 7 '#fb9b06', 8 '#f7d13d', 9 '#fcffa4')\n";
}

std::string impulse_palette() {
    return "set palette defined (0 '#fdae61', 1 '#f46d43', 2 '#d73027', 3 '#8e0152', 4 '#2d004b')\n";
}

}  // namespace jawari::host::plot
