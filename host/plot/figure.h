// What figures have in common: units with prefixes, envelopes of long signals, layout, colours.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jawari::host::plot {

/// A factor and a unit in which the values of a plot are neither tiny nor huge: 0.0036 m becomes 3.6 mm.
struct Scale {
    double factor = 1;
    std::string unit;
};

/// `unit` with the prefix n, µ, m or none (k, M for large values) that suits values up to `largest` in
/// absolute value.
Scale scale_for(double largest, std::string_view unit);

/// Decimal text with nine significant digits, `.` as the decimal sign; NaN (which gnuplot skips) if not
/// finite.
std::string number(double value);

struct Range {
    double low = 0;
    double high = 0;
    void include(double value);
    [[nodiscard]] double width() const { return high - low; }
    bool empty = true;
};

/// The range widened by `share` of its width on both sides, and to something drawable if it has no width.
Range padded(Range range, double share);

/// `set xrange [low:high]` and the like.
std::string set_range(std::string_view axis, const Range& range);

/// Points of a line: at most about `most`; longer signals become their minimum and maximum per interval, in
/// order of time.
struct Polyline {
    std::vector<double> x, y;
};
Polyline envelope(std::span<const double> x, std::span<const double> y, std::size_t most);

/// A datablock `$name << EOD` of two columns; a block of lines separated by blank lines if there are several.
std::string datablock(std::string_view name, std::span<const Polyline> lines);

/// One panel's place in the figure, as fractions of its size.
struct Panel {
    double left = 0, right = 1, bottom = 0, top = 1;
    double margin = 0;  ///< free width at its right, for a colour bar or a legend
    double foot = 0;    ///< free height below it, for the labels of its x axis
    double edge = 0;    ///< free width at its left, for the labels of its y axis
    /// `set` commands that put it there, its colour bar beside it.
    [[nodiscard]] std::string place() const;
    /// Its legend beside it.
    [[nodiscard]] std::string legend_beside() const;
    /// Its legend of up to two short lines below its colour bar, where no curve is.
    [[nodiscard]] std::string legend_below_bar() const;
    /// The label of its y axis at the edge of its free width: gnuplot puts it beside the numbers, however
    /// long these are, and so outside the picture.
    [[nodiscard]] std::string y_label(const std::string& text) const;
};

/// The text, or its beginning and its end with an ellipsis between them, in at most `most` characters (at
/// least 3) of UTF-8.
std::string shortened(std::string_view text, std::size_t most);

/// Settings of every panel: fonts, thin grey borders and grids.
std::string common_style();

/// Colours that stay apart for colour-blind readers (Okabe and Ito 2008), cycling.
std::string line_colour(std::size_t index);

/// `set palette` of the viridis, respectively the inferno map.
std::string viridis_palette();
std::string inferno_palette();
/// From orange to nearly black: every point visible on white.
std::string impulse_palette();

}  // namespace jawari::host::plot
