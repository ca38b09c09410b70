#include "commands/play/status_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/progress.h"
#include "base/text.h"

namespace jawari::host {

namespace {

constexpr double meter_bottom_dbfs = -60;
constexpr std::size_t meter_width = 16;

std::string percent(double share) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.0f%%", 100 * std::clamp(share, 0.0, 99.0));
    return text.data();
}

}  // namespace

std::string meter(double peak, std::size_t width) {
    const double dbfs = peak > 0 ? 20 * std::log10(peak) : meter_bottom_dbfs;
    const double share = std::clamp(1 - dbfs / meter_bottom_dbfs, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(std::floor(share * static_cast<double>(width)));
    return std::string(filled, '#') + std::string(width - filled, '-') + (peak > 1 ? "!" : "|");
}

std::string status_text(const StatusFacts& facts, std::size_t columns) {
    const LiveStatistics& live = facts.live;
    std::string text = meter(std::max(live.peak_left, live.peak_right), meter_width) + " ";
    if (!facts.audio_runs) text += "NO AUDIO  ";
    text += "load " + percent(live.mean_load) + " worst " + percent(facts.worst_load) + "  notes " +
            std::to_string(live.held_notes) + "  xruns " + std::to_string(live.xruns);
    if (live.overload_level > 0) text += "  OVERLOAD " + std::to_string(live.overload_level);
    if (facts.recorded_s >= 0) text += "  REC " + clock_text(facts.recorded_s);
    text += "  " + printable(facts.preset);
    for (char& c : text)
        if (static_cast<unsigned char>(c) >= 0x80) c = '?';  // names in other scripts: widths are unknown
    return text.substr(0, columns);
}

}  // namespace jawari::host
