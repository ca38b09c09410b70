// MIDI files on their way to a sound file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file_plan.h"
#include "commands/render/options.h"
#include "commands/render/render_stats.h"
#include "commands/render/score.h"
#include "instrument/instrument_cache.h"

namespace jawari::host {

struct RenderJob {
    std::vector<std::string> midi;  ///< files, played one after the other; `-`: standard input
    std::string out;                ///< a file; `-`: standard output
};

/// What all jobs of a run share.
struct RenderContext {
    const RenderOptions& options;
    const ScoreRules& rules;
    InstrumentCache& instruments;
    FilePlan& files;  ///< of the one job that writes a folder of stems
};

struct RenderedJob {
    std::vector<RenderStats> stats;     ///< of each MIDI file
    std::vector<std::string> messages;  ///< notices and warnings, a line each
};

/// Everything the options ask for is written; nothing is printed. `progress` may be called often.
Outcome<RenderedJob> render_job(const RenderJob& job, const RenderContext& context,
                                const std::function<void(double fraction)>& progress);

}  // namespace jawari::host
