#include "commands/bench_latency/block_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cpu_clock.h"
#include "base/interrupt.h"
#include "commands/bench_latency/adversary.h"
#include "player/player.h"

namespace jawari::host {

namespace {

constexpr std::int64_t start_ns = 1'000'000'000;

LiveSettings settings_of(const BlockTimeSettings& wanted) {
    LiveSettings settings;
    settings.rate_hz = wanted.rate_hz;
    settings.interpreter.map = adversary_map();
    settings.overload.enabled = wanted.governor;
    return settings;
}

/// One performance from its start, block by block.
class Pass {
  public:
    Pass(const SharedInstrument& instrument, const BlockTimeSettings& settings)
        : frames_(settings.frames),
          frame_ns_(1e9 / settings.rate_hz),
          adversary_(instrument->model, settings.seed),
          player_(settings_of(settings)),
          port_(player_.add_port()),
          left_(settings.frames),
          right_(settings.frames) {
        player_.publish(instrument);
    }

    /// CPU seconds of the next block.
    double play_block() {
        const double begin = static_cast<double>(frame_);
        for (const AdversaryMessage& message : adversary_.next(frames_)) {
            // Came in while the block before was played; half a frame keeps rounding away.
            const double came =
                begin + static_cast<double>(message.offset) + 0.5 - static_cast<double>(frames_);
            port_->push({message.message, time_of(came)});
        }
        const std::int64_t now = time_of(begin);
        const double before = thread_cpu_s();
        player_.process(left_.data(), right_.data(), frames_, now);
        const double taken = thread_cpu_s() - before;
        frame_ += frames_;
        return taken;
    }

    LiveStatistics statistics() { return player_.statistics(); }

  private:
    [[nodiscard]] std::int64_t time_of(double frame) const {
        return start_ns + std::llround(frame * frame_ns_);
    }

    std::size_t frames_;
    double frame_ns_;
    Adversary adversary_;
    LivePlayer player_;
    MidiPort* port_;
    std::vector<double> left_, right_;
    std::uint64_t frame_ = 0;
};

}  // namespace

Outcome<BlockTimes> measure_blocks(const SharedInstrument& instrument, const BlockTimeSettings& settings) {
    BlockTimes times;
    times.raw.reserve(settings.blocks * settings.passes);
    times.minimum.assign(settings.blocks, std::numeric_limits<float>::infinity());
    const double available_s = static_cast<double>(settings.frames) / settings.rate_hz;
    for (std::size_t p = 0; p < settings.passes; ++p) {
        Pass pass(instrument, settings);
        for (std::uint64_t block = 0; block < settings.blocks; ++block) {
            const auto share = static_cast<float>(pass.play_block() / available_s);
            times.raw.push_back(share);
            times.minimum[block] = std::min(times.minimum[block], share);
            if (block % 256 != 0) continue;
            if (auto stop = interruption()) return *stop;
            const double done = static_cast<double>(p * settings.blocks + block);
            if (settings.progress)
                settings.progress(done / static_cast<double>(settings.passes * settings.blocks));
        }
        const LiveStatistics statistics = pass.statistics();
        times.notes = statistics.notes;
        times.late += statistics.late_blocks;
    }
    return times;
}

Distribution distribution_of(std::vector<float> values) {
    Distribution distribution;
    distribution.count = values.size();
    if (values.empty()) return distribution;
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double rank = std::ceil(share * static_cast<double>(values.size()));
        return static_cast<double>(values[static_cast<std::size_t>(std::max(1.0, rank)) - 1]);
    };
    distribution.median = at(0.5);
    distribution.p99 = at(0.99);
    distribution.p99_99 = at(0.9999);
    distribution.most = static_cast<double>(values.back());
    distribution.mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    return distribution;
}

}  // namespace jawari::host
