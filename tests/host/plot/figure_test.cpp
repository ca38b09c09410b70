#include "plot/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace jawari::host::plot {
namespace {

TEST(PlotFigure, ScalesKeepValuesReadable) {
    EXPECT_EQ(scale_for(0.0036, "m").unit, "mm");
    EXPECT_EQ(scale_for(0.0036, "m").factor, 1e3);
    EXPECT_EQ(scale_for(3e-5, "N s").unit, "µN s");
    EXPECT_EQ(scale_for(2e-8, "J").unit, "nJ");
    EXPECT_EQ(scale_for(2, "s").unit, "s");
    EXPECT_EQ(scale_for(5e4, "N").unit, "kN");
    EXPECT_EQ(scale_for(0, "m").unit, "m");
    EXPECT_EQ(scale_for(NAN, "m").factor, 1);
}

TEST(PlotFigure, RangesHaveWidth) {
    Range range;
    range.include(NAN);
    EXPECT_TRUE(range.empty);
    range.include(3);
    EXPECT_GT(padded(range, 0.1).width(), 0);
    range.include(-1);
    EXPECT_DOUBLE_EQ(padded(range, 0.25).low, -2);
    EXPECT_DOUBLE_EQ(padded(range, 0.25).high, 4);
    EXPECT_GT(padded({0, 0, false}, 0.1).width(), 0);
}

TEST(PlotFigure, EnvelopeKeepsEveryPeak) {
    const std::size_t count = 100000;
    std::vector<double> x(count), y(count);
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = static_cast<double>(i);
        y[i] = std::sin(0.37 * x[i]);
    }
    y[31415] = 7;
    y[92653] = -5;
    const Polyline line = envelope(x, y, 2000);
    ASSERT_EQ(line.x.size(), 2000u);
    double highest = 0, lowest = 0;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        EXPECT_GE(line.x[i], line.x[i == 0 ? 0 : i - 1]);
        EXPECT_EQ(line.y[i], y[static_cast<std::size_t>(line.x[i])]);
        highest = std::max(highest, line.y[i]);
        lowest = std::min(lowest, line.y[i]);
    }
    EXPECT_EQ(highest, 7);
    EXPECT_EQ(lowest, -5);
    EXPECT_EQ(envelope(x, y, count).y, y);
}

TEST(PlotFigure, LongTextsKeepTheirBeginningAndTheirEnd) {
    EXPECT_EQ(shortened("x = 0.1 m", 9), "x = 0.1 m");
    EXPECT_EQ(shortened("0123456789", 5), "01…89");
    EXPECT_EQ(shortened("0123456789", 6), "012…89");
    EXPECT_EQ(shortened("éèéèéèéè", 3), "é…è");  // characters, not bytes
    EXPECT_EQ(shortened("", 3), "");
}

TEST(PlotFigure, NumbersAreForGnuplot) {
    EXPECT_EQ(number(-0.25), "-0.25");
    EXPECT_EQ(number(INFINITY), "NaN");
    EXPECT_EQ(number(1e-12), "1e-12");
}

}  // namespace
}  // namespace jawari::host::plot
