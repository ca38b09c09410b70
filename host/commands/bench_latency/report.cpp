#include "commands/bench_latency/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"

namespace jawari::host {

namespace {

using Json = nlohmann::ordered_json;

Json delay_json(const std::optional<std::size_t>& frames) {
    return frames ? Json(*frames) : Json(nullptr);
}

std::string delay_text(const std::optional<std::size_t>& frames) {
    return frames ? std::to_string(*frames) : "none";
}

Json distribution_json(const Distribution& distribution) {
    return {{"count", distribution.count}, {"mean", distribution.mean},     {"median", distribution.median},
            {"p99", distribution.p99},     {"p99_99", distribution.p99_99}, {"max", distribution.most}};
}

Json histogram_json(const ShareHistogram& histogram) {
    Json bins = Json::array();
    for (std::size_t i = 0; i < histogram.edge.size(); ++i) {
        if (histogram.count[i] > 0) bins.push_back({histogram.edge[i], histogram.count[i]});
    }
    return bins;
}

std::string playing_text(const LatencyReport& report) {
    return report.two_hands ? "two hands" : "all courses at once";
}

std::string table_row(std::size_t frames, const char* kind, const Distribution& distribution) {
    return formatted("  %6zu  %-8s %9zu  %7.2f %%  %7.2f %%  %7.2f %%  %7.2f %%\n", frames, kind,
                     distribution.count, 100 * distribution.median, 100 * distribution.p99,
                     100 * distribution.p99_99, 100 * distribution.most);
}

std::string csv_row(const PresetResult& preset, const BlockSizeResult& size, const char* kind,
                    const Distribution& distribution) {
    return printable(preset.preset) + "," + std::to_string(size.frames) + "," + kind + "," +
           std::to_string(distribution.count) + "," + std::to_string(size.passes) + "," +
           shortest(distribution.mean) + "," + shortest(distribution.median) + "," +
           shortest(distribution.p99) + "," + shortest(distribution.p99_99) + "," +
           shortest(distribution.most) + "\n";
}

}  // namespace

ShareHistogram histogram_of(const std::vector<float>& shares, double width, std::size_t bins) {
    ShareHistogram histogram;
    histogram.count.assign(bins, 0);
    for (std::size_t i = 0; i < bins; ++i) histogram.edge.push_back(width * static_cast<double>(i));
    for (const float share : shares) {
        const double bin = std::max(0.0, static_cast<double>(share) / width);
        histogram.count[static_cast<std::size_t>(std::min(bin, static_cast<double>(bins - 1)))] += 1;
    }
    return histogram;
}

std::string latency_text(const LatencyReport& report) {
    std::string text = "Event to first changed sample, frames beyond the event's own offset:\n";
    for (const PresetResult& preset : report.presets)
        text += formatted("  %-18s at rest %s, while sounding %s (%zu events)\n",
                          printable(preset.preset).c_str(), delay_text(preset.delay.at_rest).c_str(),
                          delay_text(preset.delay.sounding).c_str(), preset.delay.events);
    text += "\nCPU time of a block over its duration, adversarial playing, " + playing_text(report) + ", " +
            std::to_string(report.rate_hz) + " Hz, quality " + report.quality + ", " + report.processor +
            ":\n";
    text += "raw: every block of every pass; minimum: each block's least over the passes\n";
    for (const PresetResult& preset : report.presets) {
        if (preset.sizes.empty()) continue;
        text += printable(preset.preset) + "\n";
        text += "  frames  what        blocks     median        99 %     99.99 %       most\n";
        for (const BlockSizeResult& size : preset.sizes) {
            text += table_row(size.frames, "raw", size.raw);
            text += table_row(size.frames, "minimum", size.minimum);
            text += formatted("          late by the wall clock: %llu\n",
                              static_cast<unsigned long long>(size.late));
        }
    }
    return text;
}

std::string latency_json(const LatencyReport& report) {
    Json presets = Json::array();
    for (const PresetResult& preset : report.presets) {
        Json sizes = Json::array();
        for (const BlockSizeResult& size : preset.sizes)
            sizes.push_back({{"frames", size.frames},
                             {"blocks_per_pass", size.blocks},
                             {"passes", size.passes},
                             {"late_blocks", size.late},
                             {"raw", distribution_json(size.raw)},
                             {"minimum", distribution_json(size.minimum)},
                             {"raw_histogram", histogram_json(size.raw_histogram)},
                             {"minimum_histogram", histogram_json(size.minimum_histogram)}});
        presets.push_back({{"preset", preset.preset},
                           {"survey_p99_share", preset.survey_cost},
                           {"event_delay_frames",
                            {{"at_rest", delay_json(preset.delay.at_rest)},
                             {"sounding", delay_json(preset.delay.sounding)},
                             {"events", preset.delay.events}}},
                           {"block_share_of_deadline", sizes}});
    }
    const Json json{{"processor", report.processor},
                    {"rate_hz", report.rate_hz},
                    {"quality", report.quality},
                    {"playing", playing_text(report)},
                    {"presets", presets}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string latency_csv(const LatencyReport& report) {
    std::string text = "preset,frames,kind,blocks,passes,mean,median,p99,p99_99,max\n";
    for (const PresetResult& preset : report.presets) {
        for (const BlockSizeResult& size : preset.sizes) {
            text += csv_row(preset, size, "raw", size.raw);
            text += csv_row(preset, size, "minimum", size.minimum);
        }
    }
    return text;
}

}  // namespace jawari::host
