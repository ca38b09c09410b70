#include "render/render_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/cpu_clock.h"
#include "common/interrupt.h"
#include "common/progress.h"
#include "render/options.h"

namespace jawari::host {

namespace {

constexpr std::size_t block_frames = 1024;

std::uint64_t to_frames(double seconds, double rate_hz) {
    return static_cast<std::uint64_t>(std::llround(seconds * rate_hz));
}

/// Watches for the end of an automatic tail.
class SilenceDetector {
  public:
    explicit SilenceDetector(double rate_hz) : wanted_(to_frames(silence_s, rate_hz)) {}

    void add(std::span<const double> block) {
        for (const double sample : block) quiet_ = std::abs(sample) < level_ ? quiet_ + 1 : 0;
    }
    [[nodiscard]] bool silent() const { return quiet_ >= wanted_; }

  private:
    double level_ = std::pow(10.0, silence_dbfs / 20);
    std::uint64_t wanted_;
    std::uint64_t quiet_ = 0;
};

/// The events of one block, with offsets in it.
class BlockEvents {
  public:
    explicit BlockEvents(const std::vector<TimedEvent>& events) : events_(events) {}

    std::span<const InstrumentEvent> take(std::uint64_t begin, std::uint64_t end) {
        block_.clear();
        for (; next_ < events_.size() && events_[next_].frame < end; ++next_) {
            block_.push_back(events_[next_].event);
            block_.back().frame = static_cast<std::size_t>(events_[next_].frame - begin);
        }
        return block_;
    }

  private:
    const std::vector<TimedEvent>& events_;
    std::size_t next_ = 0;
    std::vector<InstrumentEvent> block_;
};

void apply_gain(std::span<double> block, double gain, ScoreStatistics& statistics) {
    for (double& sample : block) {
        sample *= gain;
        statistics.peak = std::max(statistics.peak, std::abs(sample));
        if (std::abs(sample) > 1) statistics.clipped += 1;
    }
}

}  // namespace

std::uint64_t most_frames(const MidiScore& score, const ScoreSettings& settings, double rate_hz) {
    return score.end_frame + 1 + to_frames(settings.tail_s.value_or(automatic_tail_limit_s), rate_hz);
}

Outcome<ScoreStatistics> render_score(const InstrumentModel& model, const MidiScore& score,
                                      const ScoreSettings& settings, const SampleSink& sink) {
    InstrumentState state = make_instrument_state(model);
    ScoreStatistics statistics;
    SilenceDetector silence(model.output_rate_hz);
    BlockEvents events(score.events);
    ProgressBar progress("rendering");
    std::array<double, block_frames> samples{};
    const std::uint64_t end = most_frames(score, settings, model.output_rate_hz);
    const auto progress_end = static_cast<double>(settings.tail_s ? end : score.end_frame + 1);
    while (statistics.frames < end) {
        if (auto stop = interruption()) return *stop;
        const std::uint64_t begin = statistics.frames;
        const std::size_t count =
            static_cast<std::size_t>(std::min<std::uint64_t>(block_frames, end - begin));
        const std::span<double> block(samples.data(), count);
        const auto block_events = events.take(begin, begin + count);
        const double started = thread_cpu_s();
        render_instrument(model, state, block_events, block.data(), count);
        statistics.render_cpu_s += thread_cpu_s() - started;
        apply_gain(block, settings.gain, statistics);
        if (auto error = sink(block)) return *error;
        silence.add(block);
        statistics.frames += count;
        progress.update(std::min(1.0, static_cast<double>(statistics.frames) / progress_end));
        if (!settings.tail_s && statistics.frames > score.end_frame && silence.silent()) break;
    }
    statistics.notes = state.counters;
    statistics.contacts = contact_counters(state);
    return statistics;
}

}  // namespace jawari::host
