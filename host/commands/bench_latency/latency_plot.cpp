#include <algorithm>
#include <set>

#include "commands/bench_latency/report.h"
#include "plot/figure.h"
#include "plot/gnuplot.h"

namespace jawari::host {

namespace {

using namespace plot;

constexpr int width_px = 900;
constexpr int panel_px = 260;

/// Filled bins; steps need their left edges only.
Polyline steps_of(const ShareHistogram& histogram) {
    Polyline points;
    for (std::size_t i = 0; i < histogram.edge.size(); ++i) {
        if (histogram.count[i] == 0) continue;
        points.x.push_back(100 * histogram.edge[i]);
        points.y.push_back(static_cast<double>(histogram.count[i]));
    }
    return points;
}

struct Curves {
    std::string data, plot;
};

void add_curve(Curves& curves, const std::string& name, const ShareHistogram& histogram,
               const std::string& title, std::size_t colour, bool dashed) {
    const Polyline points = steps_of(histogram);
    if (points.x.empty()) return;
    curves.data += datablock(name, {&points, 1});
    curves.plot += (curves.plot.empty() ? "plot " : ", ") + ("$" + name) + " using 1:2 with points pt " +
                   (dashed ? "6" : "7") + " ps 0.4 lc rgb " + quote(line_colour(colour)) + " title " +
                   quote(title);
}

std::string panel_of(const LatencyReport& report, std::size_t frames, const Panel& panel) {
    Curves curves;
    for (std::size_t p = 0; p < report.presets.size(); ++p) {
        for (const BlockSizeResult& size : report.presets[p].sizes) {
            if (size.frames != frames) continue;
            const std::string name = "d" + std::to_string(p) + "_" + std::to_string(frames);
            add_curve(curves, name + "raw", size.raw_histogram, report.presets[p].preset + ", raw", 2 * p,
                      true);
            add_curve(curves, name + "min", size.minimum_histogram,
                      report.presets[p].preset + ", minimum of " + std::to_string(size.passes), 2 * p + 1,
                      false);
        }
    }
    return curves.data + panel.place() + panel.legend_beside() + "set title " +
           quote(std::to_string(frames) + " frames") +
           "\nset logscale y\nset xlabel 'CPU time of a block / its duration (%)'\nset ylabel 'blocks'\n" +
           curves.plot + "\n";
}

}  // namespace

MaybeError plot_latency(const LatencyReport& report, const std::string& path) {
    std::set<std::size_t> frames;
    for (const PresetResult& preset : report.presets) {
        for (const BlockSizeResult& size : preset.sizes) frames.insert(size.frames);
    }
    std::string script = common_style() + "set multiplot\n";
    const double height = 1.0 / static_cast<double>(std::max<std::size_t>(1, frames.size()));
    double top = 1;
    for (const std::size_t size : frames) {
        script += panel_of(report, size, {0.1, 0.7, top - 0.78 * height, top - 0.12 * height, 0.28});
        top -= height;
    }
    return draw(path, width_px, panel_px * static_cast<int>(frames.size()), script + "unset multiplot\n");
}

}  // namespace jawari::host
