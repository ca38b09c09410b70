// The loop of `jawari render`: a score played on an instrument, block by block.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "common/error.h"
#include "jawari/instrument_model.h"
#include "jawari/instrument_state.h"
#include "render/midi_events.h"

namespace jawari::host {

/// Receives every block in order: the audio file, pictures.
using SampleSink = std::function<MaybeError(std::span<const double>)>;

struct ScoreSettings {
    double gain = 1;               ///< factor
    std::optional<double> tail_s;  ///< nothing: until the sound has died away (options.h)
};

struct ScoreStatistics {
    std::uint64_t frames = 0;
    double peak = 0;            ///< largest |sample|, full scale 1
    std::uint64_t clipped = 0;  ///< samples beyond full scale
    double render_cpu_s = 0;    ///< without the sinks
    InstrumentCounters notes;
    Counters contacts;
};

/// Frames that render_score() produces at most.
std::uint64_t most_frames(const MidiScore& score, const ScoreSettings& settings, double rate_hz);

/// Ends early with the interruption's error on SIGINT or SIGTERM. Draws a progress bar on a terminal.
Outcome<ScoreStatistics> render_score(const InstrumentModel& model, const MidiScore& score,
                                      const ScoreSettings& settings, const SampleSink& sink);

}  // namespace jawari::host
