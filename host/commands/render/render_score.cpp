#include "commands/render/render_score.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/cpu_clock.h"
#include "base/decibels.h"
#include "base/interrupt.h"
#include "commands/render/options.h"
#include "instrument/limiter.h"

namespace jawari::host {

namespace {

constexpr std::size_t block_frames = 1024;

std::uint64_t to_frames(double seconds, double rate_hz) {
    return static_cast<std::uint64_t>(std::llround(seconds * rate_hz));
}

/// Watches for the end of an automatic tail.
class SilenceDetector {
  public:
    SilenceDetector(double level_dbfs, double rate_hz)
        : level_(factor_of(level_dbfs)), wanted_(to_frames(silence_s, rate_hz)) {}

    void add(std::span<const double> left, std::span<const double> right) {
        for (std::size_t n = 0; n < left.size(); ++n) {
            const bool quiet = std::abs(left[n]) < level_ && std::abs(right[n]) < level_;
            quiet_ = quiet ? quiet_ + 1 : 0;
        }
    }
    [[nodiscard]] bool silent() const { return quiet_ >= wanted_; }

  private:
    double level_;
    std::uint64_t wanted_;
    std::uint64_t quiet_ = 0;
};

/// The mix on its way to the sink: limited, if asked for, without the limiter's delay.
class MixPath {
  public:
    MixPath(const ScoreSettings& settings, const SoundSink& sink, ScoreStatistics& statistics)
        : sink_(sink), statistics_(statistics), mono_(settings.mono) {
        if (settings.limiter_dbfs)
            limiter_ = make_limiter(factor_of(*settings.limiter_dbfs), settings.output_rate_hz);
    }

    MaybeError pass(std::vector<double>& left, std::vector<double>& right) {
        std::size_t skip = 0;
        if (mono_) mix_down(left, right);
        if (limiter_) {
            const std::uint64_t before = limiter_->frames;
            const double started = thread_cpu_s();
            for (std::size_t n = 0; n < left.size(); ++n) limit(*limiter_, left[n], right[n]);
            statistics_.render_cpu_s += thread_cpu_s() - started;
            if (before < limiter_->look_ahead)
                skip = std::min<std::size_t>(left.size(), limiter_->look_ahead - before);
        }
        return write(std::span(left).subspan(skip), std::span(right).subspan(skip));
    }

    /// What the limiter still holds back.
    MaybeError finish() {
        if (!limiter_) return std::nullopt;
        std::vector<double> left(limiter_->look_ahead, 0.0), right(limiter_->look_ahead, 0.0);
        auto error = pass(left, right);
        statistics_.limited_frames = limiter_->reduced;
        statistics_.least_gain = limiter_->least_gain;
        return error;
    }

  private:
    static void mix_down(std::vector<double>& left, std::vector<double>& right) {
        for (std::size_t n = 0; n < left.size(); ++n) left[n] = right[n] = (left[n] + right[n]) / 2;
    }

    void measure(std::span<const double> side) {
        for (const double sample : side) {
            statistics_.peak = std::max(statistics_.peak, std::abs(sample));
            if (std::abs(sample) > 1) statistics_.clipped += 1;
        }
    }

    MaybeError write(std::span<const double> left, std::span<const double> right) {
        if (left.empty()) return std::nullopt;
        measure(left);
        if (!mono_) measure(right);
        return sink_.mix(left, right);
    }

    const SoundSink& sink_;
    ScoreStatistics& statistics_;
    bool mono_;
    std::optional<Limiter> limiter_;
};

}  // namespace

std::uint64_t most_frames(const Score& score, const ScoreSettings& settings) {
    const double tail_s = settings.tail_s.value_or(automatic_tail_limit_s);
    return score.end_frame + to_frames(tail_s, settings.output_rate_hz);
}

Outcome<ScoreStatistics> render_score(Ensemble& ensemble, const Score& score, const ScoreSettings& settings,
                                      const SoundSink& sink) {
    ScoreStatistics statistics;
    SilenceDetector silence(settings.silence_dbfs, settings.output_rate_hz);
    MixPath mix(settings, sink, statistics);
    const std::uint64_t end = most_frames(score, settings);
    const auto progress_end =
        static_cast<double>(std::max<std::uint64_t>(1, settings.tail_s ? end : score.end_frame));
    while (statistics.frames < end) {
        if (auto stop = interruption()) return *stop;
        const auto count =
            static_cast<std::size_t>(std::min<std::uint64_t>(block_frames, end - statistics.frames));
        const double started = thread_cpu_s();
        render_block(ensemble, statistics.frames, count);
        statistics.render_cpu_s += thread_cpu_s() - started;
        silence.add(ensemble.left, ensemble.right);
        if (auto error = mix.pass(ensemble.left, ensemble.right)) return *error;
        if (sink.stems && !ensemble.stems.empty()) {
            if (auto error = sink.stems(ensemble.stems)) return *error;
        }
        statistics.frames += count;
        if (sink.progress)
            sink.progress(std::min(1.0, static_cast<double>(statistics.frames) / progress_end));
        if (!settings.tail_s && statistics.frames > score.end_frame && silence.silent()) break;
    }
    if (auto error = mix.finish()) return *error;
    return statistics;
}

}  // namespace jawari::host
