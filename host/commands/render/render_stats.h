// What a rendering did and what it cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/render/options.h"
#include "commands/render/render_score.h"

namespace jawari::host {

struct PartStats {
    std::string preset;
    int port = 0;              ///< from 1
    int channel = 0;           ///< from 1
    std::uint64_t played = 0;  ///< notes that sounded; a course of several strings is one
    double contact_rate_hz = 0;
    InstrumentCounters notes;
    Counters contacts;
};

struct RenderStats {
    std::string midi, preset, quality;
    double output_rate_hz = 0;
    double score_s = 0;  ///< last event or end of track
    std::vector<PartStats> parts;
    std::uint64_t silent_notes = 0;
    std::vector<IgnoredKind> ignored;
    std::vector<LentNotes> lent_notes;
    std::vector<MidiRepair> repairs;
    ScoreStatistics score;
    double cpu_compile_s = 0;
    double cpu_output_s = 0;
};

/// Everything but the score's statistics and the CPU times, after rendering.
void describe_job(const std::string& midi, const RenderOptions& options, const Score& score,
                  const Ensemble& ensemble, RenderStats& stats);

/// Seconds of sound per CPU second of rendering; empty if no time was measured.
std::optional<double> real_time_factor(const RenderStats& stats);

/// 20 log10 of the peak; empty for silence.
std::optional<double> peak_dbfs(const RenderStats& stats);

/// docs/commands/render.md, section "Statistics". Ends with a newline.
std::string stats_json(const RenderStats& stats);

/// A few lines for a person.
std::string stats_summary(const RenderStats& stats);

}  // namespace jawari::host
