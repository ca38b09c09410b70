#include "plot/scene_plot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/text.h"
#include "plot/figure.h"
#include "plot/gnuplot.h"

namespace jawari::host {
namespace {

using namespace plot;  // figures and gnuplot

constexpr std::size_t most_strings = 6;
constexpr std::size_t most_signals = 8;        // per panel
constexpr std::size_t points_per_line = 3000;  // beyond, the envelope
constexpr std::size_t most_events = 12000;     // beyond, neighbours in time are summed
constexpr std::size_t most_single_obstacles = 60;

constexpr int one_column_px = 1160;
constexpr int column_px = 760;
constexpr int heading_px = 46;
constexpr int panel_px = 318;
constexpr int left_px = 96;
constexpr int right_px = 184;
constexpr int above_px = 32;
constexpr int below_px = 62;
// Widths of characters, rounded up, in the sizes of gnuplot's fonts that are used here.
constexpr int heading_character_px = 12;
constexpr int title_character_px = 10;
constexpr std::size_t legend_characters = 14;  // what right_px has room for beside a line's sample

/// Where panels go: columns of strings, rows of panels, in pixels.
struct Layout {
    std::size_t columns = 1;
    std::size_t rows = 3;
    int column_width = one_column_px;
    [[nodiscard]] int width() const { return static_cast<int>(columns) * column_width; }
    [[nodiscard]] int height() const { return heading_px + static_cast<int>(rows) * panel_px; }
    /// Characters of the heading, and of a title, which is centred over its panel and may reach into the
    /// margins.
    [[nodiscard]] std::size_t heading_characters() const {
        return static_cast<std::size_t>(width() / heading_character_px);
    }
    [[nodiscard]] std::size_t title_characters() const {
        return static_cast<std::size_t>((column_width - right_px) / title_character_px);
    }

    [[nodiscard]] Panel panel(std::size_t column, std::size_t row) const {
        const double left = static_cast<double>(column) * column_width;
        const double top = height() - heading_px - static_cast<double>(row) * panel_px;
        Panel place;
        place.left = (left + left_px) / width();
        place.right = (left + column_width - right_px) / width();
        place.margin = static_cast<double>(right_px) / width();
        place.edge = static_cast<double>(left_px) / width();
        place.foot = static_cast<double>(below_px) / height();
        place.top = (top - above_px) / height();
        place.bottom = (top - panel_px + below_px) / height();
        return place;
    }
};

/// The commands of one panel, each panel starting from the same settings.
struct PanelScript {
    Panel place;
    std::string commands;
    [[nodiscard]] std::string text() const { return "reset\n" + common_style() + place.place() + commands; }
};

/// A recording of a single row has no duration, but an axis needs one.
Range time_range(const SceneRecording& recording, const Scale& time) {
    return {0, recording.duration_s > 0 ? recording.duration_s * time.factor : 1, false};
}

Range range_of(const Snapshot& snapshot, Range range) {
    for (const double value : snapshot.displacement_m) range.include(value);
    return range;
}

/// The string's own range, and obstacles as far as they are within half of it: a deep recess does not flatten
/// the string.
Range shape_range(const StringRecording& string) {
    Range range;
    for (const Snapshot& snapshot : string.snapshots) range = range_of(snapshot, range);
    if (range.empty) range.include(0);
    Range wide = padded(range, 0.5);
    for (const ObstaclePoint& obstacle : string.obstacles) {
        if (obstacle.height_m > wide.low && obstacle.height_m < wide.high) range.include(obstacle.height_m);
    }
    return padded(range, 0.08);
}

/// Obstacles of one side: posts up (or down) to their height, or a filled profile if there are many.
void add_obstacles(const StringRecording& string, Side side, const Scale& height, const Range& axis,
                   std::string& data, std::vector<std::string>& curves) {
    Polyline profile;
    for (const ObstaclePoint& obstacle : string.obstacles) {
        if (obstacle.side != side) continue;
        profile.x.push_back(obstacle.position_m);
        profile.y.push_back(std::clamp(obstacle.height_m * height.factor, axis.low, axis.high));
    }
    if (profile.x.empty()) return;
    const bool below = side == Side::Below;
    const std::string name = below ? "$below" : "$above";
    data += datablock(name.substr(1), {&profile, 1});
    const std::string edge = number(below ? axis.low : axis.high);
    if (profile.x.size() > most_single_obstacles) {
        curves.push_back(name + " using 1:2:(" + edge + ") with filledcurves fc rgb '#c9bfae' notitle");
        curves.push_back(name + " using 1:2 with lines lw 1.5 lc rgb '#7a6a50' title 'obstacle'");
        return;
    }
    curves.push_back(name + " using 1:2:(0):(" + edge +
                     "-$2) with vectors nohead lw 3 lc rgb '#cfc4b0' notitle");
    curves.push_back(name + " using 1:2 with points pt 7 ps 0.7 lc rgb " +
                     (below ? "'#6b5b3e'" : "'#a04040'") + " title " +
                     (below ? "'obstacle below'" : "'obstacle above'"));
}

std::string joined(const std::vector<std::string>& curves) {
    std::string text = "plot ";
    for (std::size_t i = 0; i < curves.size(); ++i) text += (i > 0 ? ", \\\n     " : "") + curves[i];
    return text + "\n";
}

std::string snapshots_panel(const StringRecording& string, const Scale& time, const Panel& place,
                            std::size_t most_title) {
    const Range metres = shape_range(string);
    const Scale height = scale_for(std::max(std::abs(metres.low), std::abs(metres.high)), "m");
    const Range axis{metres.low * height.factor, metres.high * height.factor, false};

    std::string data = "$shapes << EOD\n";
    Range times;
    for (const Snapshot& snapshot : string.snapshots) {
        times.include(snapshot.time_s * time.factor);
        for (std::size_t i = 0; i < snapshot.displacement_m.size(); ++i) {
            data += number(string.grid_m[i]) + ' ' + number(snapshot.displacement_m[i] * height.factor) +
                    ' ' + number(snapshot.time_s * time.factor) + '\n';
        }
        data += "\n";
    }
    data += "EOD\n";

    std::vector<std::string> curves;
    add_obstacles(string, Side::Below, height, axis, data, curves);
    add_obstacles(string, Side::Above, height, axis, data, curves);
    curves.emplace_back("0 with lines lw 1 dt 3 lc rgb '#909090' notitle");
    if (!times.empty) curves.emplace_back("$shapes using 1:2:3 with lines lw 1.4 lc palette notitle");

    Range along{0, string.length_m, false};
    const std::string what = string.is_string ? ": string and obstacles" : ": obstacles";
    const std::string title = shortened(string.name, most_title - what.size()) + what;
    std::string commands = data + "set title " + quote(title) + "\n" + set_range("x", along) +
                           set_range("y", axis) + viridis_palette() + place.legend_below_bar() +
                           "set xlabel 'position x (m)'\n" +
                           place.y_label("displacement (" + height.unit + ")");
    if (!times.empty && times.width() > 0) commands += set_range("cb", times);
    commands += "set cblabel " + quote("time (" + time.unit + ")") + "\n";
    return commands + joined(curves);
}

std::string quantity_name(Quantity quantity) {
    switch (quantity) {
        case Quantity::Displacement:
            return "displacement";
        case Quantity::Velocity:
            return "velocity";
        case Quantity::Acceleration:
            return "acceleration";
        case Quantity::Slope:
            return "slope";
        case Quantity::NutForce:
            return "nut force";
        case Quantity::BridgeForce:
            return "bridge force";
        case Quantity::ModeDisplacement:
            return "modal displacement";
        case Quantity::ModeVelocity:
            return "modal velocity";
        case Quantity::ModeEnergy:
            return "modal energy";
        case Quantity::ContactForce:
            return "contact force";
        case Quantity::HammerForce:
            return "hammer force";
        case Quantity::HammerDisplacement:
            return "hammer displacement";
        case Quantity::Energy:
            return "energy";
    }
    return "";
}

/// `displacement_m@0.1#2` says what the axis says already: what remains is where, and the number of a
/// repetition.
std::string place_of(const ProbeSignal& signal) {
    const auto hash = signal.name.rfind('#');
    const bool repeated = hash != std::string::npos && signal.name.find('@', hash) == std::string::npos;
    const std::string repetition = repeated ? " " + signal.name.substr(hash) : "";
    const std::string name = repeated ? signal.name.substr(0, hash) : signal.name;
    const auto at = name.rfind('@');
    if (at == std::string::npos) return (signal.quantity == Quantity::Energy ? "H" : name) + repetition;
    const std::string place = name.substr(at + 1);
    for (const std::string numbered : {"contact", "hammer", "mode", "point"}) {
        if (place.rfind(numbered, 0) == 0)
            return std::string(numbered).append(" ").append(place.substr(numbered.size())).append(repetition);
    }
    const auto position_m = parse_number(place);
    return "x = " + (position_m ? formatted("%.6g", *position_m) : place) + " m" + repetition;
}

std::string signals_panel(const SceneRecording& recording, const std::vector<const ProbeSignal*>& signals,
                          const Scale& time, const Panel& place) {
    const std::size_t shown = std::min(signals.size(), most_signals);
    Range range;
    for (std::size_t i = 0; i < shown; ++i) {
        for (const double value : signals[i]->values) range.include(value);
    }
    if (range.empty) range.include(0);
    const Scale scale = scale_for(std::max(std::abs(range.low), std::abs(range.high)), signals[0]->unit);
    const Range axis = padded({range.low * scale.factor, range.high * scale.factor, false}, 0.08);

    std::string data;
    std::vector<std::string> curves;
    for (std::size_t i = 0; i < shown; ++i) {
        Polyline line = envelope(recording.times_s, signals[i]->values, points_per_line);
        for (double& t : line.x) t *= time.factor;
        for (double& y : line.y) y *= scale.factor;
        const std::string name = "signal" + std::to_string(i);
        data += datablock(name, {&line, 1});
        curves.push_back("$" + name + " using 1:2 with lines lw 1.2 lc rgb '" + line_colour(i) + "' title " +
                         quote(shortened(place_of(*signals[i]), legend_characters)));
    }
    std::string title = "probes: " + quantity_name(signals[0]->quantity);
    if (shown < signals.size()) {
        title += " (" + std::to_string(shown) + " of " + std::to_string(signals.size()) + ")";
    }
    return data + "set title " + quote(title) + "\n" + set_range("x", time_range(recording, time)) +
           set_range("y", axis) + place.legend_beside() + "set xlabel " + quote("time (" + time.unit + ")") +
           "\n" + place.y_label(quantity_name(signals[0]->quantity) + (" (" + scale.unit + ")")) +
           joined(curves);
}

/// Events of the same contact within one bin of time are summed, so that pictures of long recordings stay
/// small.
std::vector<ContactEvent> thinned(const SceneRecording& recording, const StringRecording& string) {
    std::vector<ContactEvent> events = string.events;
    for (double bins = 4096; events.size() > most_events && bins >= 1; bins /= 2) {
        const double bin = recording.duration_s / bins;
        std::map<std::pair<std::size_t, long>, ContactEvent> sums;
        for (const ContactEvent& event : string.events) {
            const auto key = std::make_pair(event.contact, static_cast<long>(event.time_s / bin));
            auto [entry, fresh] = sums.try_emplace(key, event);
            if (!fresh) entry->second.impulse_Ns += event.impulse_Ns;
        }
        events.clear();
        for (const auto& [key, event] : sums) events.push_back(event);
    }
    // Light ones first, so that heavy ones are drawn over them.
    std::sort(events.begin(), events.end(),
              [](const ContactEvent& a, const ContactEvent& b) { return a.impulse_Ns < b.impulse_Ns; });
    return events;
}

std::string contactogram_panel(const SceneRecording& recording, const StringRecording& string,
                               const Scale& time, const Panel& place) {
    const std::vector<ContactEvent> events = thinned(recording, string);
    const double largest = events.empty() ? 0 : events.back().impulse_Ns;
    const Scale impulse = scale_for(largest, "N s");

    // A point for each of many neighbours must leave them apart.
    const double largest_point = string.obstacles.size() > most_single_obstacles ? 0.6 : 1.35;

    std::string data = "$events << EOD\n";
    for (const ContactEvent& event : events) {
        data += number(event.time_s * time.factor) + ' ' +
                number(string.obstacles[event.contact].position_m) + ' ' +
                number(event.impulse_Ns * impulse.factor) + ' ' +
                number(0.25 + largest_point * std::sqrt(event.impulse_Ns / largest)) + '\n';
    }
    data += "EOD\n";

    std::string commands = data + set_range("x", time_range(recording, time)) + impulse_palette() +
                           "set xlabel " + quote("time (" + time.unit + ")") + "\n" +
                           place.y_label(string.is_string ? "contact position x (m)" : "contact");
    Range positions;
    for (const ObstaclePoint& obstacle : string.obstacles) positions.include(obstacle.position_m);
    if (positions.empty) positions = {0, string.length_m, false};
    commands += set_range("y", padded(positions, 0.06));

    std::vector<std::string> curves;
    std::string title = "contactogram: ";
    if (string.obstacles.size() <= most_single_obstacles && !string.obstacles.empty()) {
        commands += "unset grid\nset grid xtics lw 1 lc rgb '#e4e4e4'\n$contacts << EOD\n";
        for (const ObstaclePoint& obstacle : string.obstacles) commands += number(obstacle.position_m) + "\n";
        commands += "EOD\n";
        curves.push_back("$contacts using (0):1:(" + number(time_range(recording, time).high) +
                         "):(0) with vectors nohead lw 1 lc rgb '#d8d0c0' notitle");
    }
    if (events.empty()) {
        title += string.obstacles.empty() ? "this string has no obstacle" : "the string struck nothing";
        curves.emplace_back("NaN notitle");
    } else {
        title += "impulses from " + std::to_string(string.obstacles.size()) +
                 (string.obstacles.size() == 1 ? " contact" : " contacts");
        if (recording.interval_s > 0) {
            const Scale interval = scale_for(recording.interval_s, "s");
            char text[32];
            std::snprintf(text, sizeof text, "%.3g ", recording.interval_s * interval.factor);
            title += ", summed over " + (text + interval.unit);
        }
        commands += "set cblabel " + quote("impulse (" + impulse.unit + ")") + "\n" +
                    set_range("cb", {0, largest * impulse.factor, false});
        curves.emplace_back("$events using 1:2:4:3 with points pt 7 ps variable lc palette notitle");
    }
    return commands + "set title " + quote(title) + "\n" + joined(curves);
}

/// Probes by quantity, in the order in which quantities first appear.
std::vector<std::vector<const ProbeSignal*>> by_quantity(const StringRecording& string) {
    std::vector<std::vector<const ProbeSignal*>> groups;
    for (const ProbeSignal& probe : string.probes) {
        const auto same = [&](const auto& group) { return group[0]->quantity == probe.quantity; };
        const auto found = std::find_if(groups.begin(), groups.end(), same);
        if (found == groups.end()) {
            groups.push_back({&probe});
        } else {
            found->push_back(&probe);
        }
    }
    return groups;
}

std::string heading(const SceneRecording& recording, std::size_t strings, std::size_t most) {
    std::string shown;
    if (strings < recording.strings.size())
        shown =
            " (" + std::to_string(strings) + " of " + std::to_string(recording.strings.size()) + " strings)";
    return shortened(recording.title, most - shown.size()) + shown;
}

}  // namespace

SceneFigure scene_figure(const SceneRecording& recording) {
    Layout layout;
    layout.columns = std::clamp<std::size_t>(recording.strings.size(), 1, most_strings);
    layout.column_width = layout.columns == 1 ? one_column_px : column_px;
    std::size_t groups = 0;
    for (std::size_t s = 0; s < std::min(layout.columns, recording.strings.size()); ++s) {
        groups = std::max(groups, by_quantity(recording.strings[s]).size());
    }
    layout.rows = 2 + groups;

    const Scale time = scale_for(recording.duration_s > 2 ? 1 : recording.duration_s / 2, "s");
    std::string script = "set multiplot title " +
                         quote(heading(recording, layout.columns, layout.heading_characters())) +
                         " font ',16' offset 0,0.1\n";
    for (std::size_t s = 0; s < std::min(layout.columns, recording.strings.size()); ++s) {
        const StringRecording& string = recording.strings[s];
        std::size_t row = 0;
        const Panel first = layout.panel(s, row++);
        script += PanelScript{first, snapshots_panel(string, time, first, layout.title_characters())}.text();
        for (const auto& group : by_quantity(string)) {
            const Panel place = layout.panel(s, row++);
            script += PanelScript{place, signals_panel(recording, group, time, place)}.text();
        }
        const Panel last = layout.panel(s, layout.rows - 1);
        script += PanelScript{last, contactogram_panel(recording, string, time, last)}.text();
    }
    return {layout.width(), layout.height(), script + "unset multiplot\n"};
}

MaybeError plot_scene(const SceneRecording& recording, const std::string& path) {
    const SceneFigure figure = scene_figure(recording);
    return draw(path, figure.width, figure.height, figure.script);
}

}  // namespace jawari::host
