// The loop of `jawari render`: an ensemble plays its score, block by block.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "commands/render/ensemble.h"

namespace jawari::host {

/// Receives every block in order. The mix may come later than the stems, but in the end as many frames; in
/// mono both sides are the same.
struct SoundSink {
    std::function<MaybeError(std::span<const double> left, std::span<const double> right)> mix;
    std::function<MaybeError(const std::vector<std::vector<double>>& stems)> stems;  ///< may be empty
    std::function<void(double fraction)> progress;                                   ///< may be empty
};

struct ScoreSettings {
    double output_rate_hz = 48000;
    std::optional<double> tail_s;  ///< nothing: until the sound has died away (options.h)
    double silence_dbfs = -90;
    std::optional<double> limiter_dbfs;
    bool mono = false;  ///< both sides are their mean
};

struct ScoreStatistics {
    std::uint64_t frames = 0;
    double peak = 0;                   ///< largest |sample| of the mix as it is written, full scale 1
    std::uint64_t clipped = 0;         ///< samples of the mix beyond full scale
    std::uint64_t limited_frames = 0;  ///< whose level the limiter reduced
    double least_gain = 1;             ///< of the limiter
    double render_cpu_s = 0;           ///< without the sinks
};

/// Frames that render_score() produces at most.
std::uint64_t most_frames(const Score& score, const ScoreSettings& settings);

/// Ends early with the interruption's error on SIGINT, SIGTERM or SIGHUP.
Outcome<ScoreStatistics> render_score(Ensemble& ensemble, const Score& score, const ScoreSettings& settings,
                                      const SoundSink& sink);

}  // namespace jawari::host
