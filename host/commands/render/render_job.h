// One MIDI file on its way to its WAV file.
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
    std::string midi;  ///< a file; `-`: standard input
    std::string out;   ///< a file; `-`: standard output
};

/// What all jobs of a run share.
struct RenderContext {
    const RenderOptions& options;
    const ScoreRules& rules;
    InstrumentCache& instruments;
    FilePlan& files;  ///< of the one job that writes a folder of stems
};

struct RenderedJob {
    RenderStats stats;
    std::vector<std::string> messages;  ///< notices and warnings, a line each
};

/// Everything the options ask for is written; nothing is printed. `progress` may be called often.
Outcome<RenderedJob> render_job(const RenderJob& job, const RenderContext& context,
                                const std::function<void(double fraction)>& progress);

}  // namespace jawari::host
