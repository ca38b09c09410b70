// What `jawari bench-latency` has measured, as text, JSON, CSV and a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "commands/bench_latency/block_times.h"
#include "commands/bench_latency/event_delay.h"
#include "commands/bench_latency/options.h"

namespace jawari::host {

/// A histogram of shares of the deadline.
struct ShareHistogram {
    std::vector<double> edge;          ///< lower edges, equally spaced
    std::vector<std::uint64_t> count;  ///< the last one takes everything beyond
};

struct BlockSizeResult {
    std::size_t frames = 0;
    std::uint64_t blocks = 0;  ///< of a pass
    std::uint64_t passes = 0;
    std::uint64_t late = 0;  ///< longer than they last by the wall clock, of all passes
    Distribution raw, minimum;
    ShareHistogram raw_histogram, minimum_histogram;
};

struct PresetResult {
    std::string preset;
    double survey_cost = 0;  ///< 99th percentile of a short run, by which presets are chosen
    EventDelay delay;
    std::vector<BlockSizeResult> sizes;  ///< empty: only surveyed
};

struct LatencyReport {
    std::string processor;
    std::uint32_t rate_hz = 48000;
    std::string quality;
    bool two_hands = false;
    std::vector<PresetResult> presets;
};

ShareHistogram histogram_of(const std::vector<float>& shares, double width, std::size_t bins);

std::string latency_text(const LatencyReport& report);
std::string latency_json(const LatencyReport& report);
std::string latency_csv(const LatencyReport& report);
MaybeError plot_latency(const LatencyReport& report, const std::string& path);

}  // namespace jawari::host
