// What a rendering did and what it cost.
#pragma once

#include <optional>
#include <string>

#include "render/options.h"
#include "render/render_score.h"

namespace jawari::host {

struct RenderStats {
    std::string midi, preset;
    double output_rate_hz = 0;
    double contact_rate_hz = 0;
    std::uint64_t pitch_bends = 0;
    ScoreStatistics score;
    double cpu_compile_s = 0;
    double cpu_output_s = 0;
};

/// Seconds of sound per CPU second of rendering; empty if no time was measured.
std::optional<double> real_time_factor(const RenderStats& stats);

/// 20 log10 of the peak; empty for silence.
std::optional<double> peak_dbfs(const RenderStats& stats);

/// docs/preset-format.md, section "Statistics". Ends with a newline.
std::string stats_json(const RenderStats& stats);

/// A few lines for a person.
std::string stats_summary(const RenderStats& stats);

}  // namespace jawari::host
