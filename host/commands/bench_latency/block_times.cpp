#include "commands/bench_latency/block_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cpu_clock.h"
#include "base/interrupt.h"
#include "player/player.h"
#include "plugin/core/plugin_core.h"

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

/// One performance from its start, block by block, as jawari play has it.
class LivePass {
  public:
    LivePass(const SharedInstrument& instrument, const BlockTimeSettings& settings)
        : frames_(settings.frames),
          frame_ns_(1e9 / settings.rate_hz),
          adversary_(instrument->model, settings.seed, settings.reach),
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

    std::uint64_t notes() { return player_.statistics().notes; }
    std::uint64_t late() { return player_.statistics().late_blocks; }

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

/// The same as a plugin has it: events with their frames, and floats.
class PluginPass {
  public:
    PluginPass(const SharedInstrument& instrument, const BlockTimeSettings& settings)
        : frames_(settings.frames),
          block_ns_(1e9 * static_cast<double>(settings.frames) / settings.rate_hz),
          adversary_(instrument->model, settings.seed, settings.reach),
          left_(settings.frames),
          right_(settings.frames) {
        error_ = core_.load(settings.plugin_state);
        if (!error_) error_ = core_.activate(settings.rate_hz);
    }

    [[nodiscard]] const MaybeError& error() const { return error_; }

    double play_block() {
        const std::vector<AdversaryMessage>& messages = adversary_.next(frames_);
        PluginOutput output;
        output.main = {left_.data(), right_.data()};
        const double before = thread_cpu_s();
        const std::int64_t begun_ns = steady_clock_ns();
        core_.begin_block(output, frames_, 0);
        for (const AdversaryMessage& message : messages) core_.take(message.message, message.offset);
        core_.end_block();
        if (static_cast<double>(steady_clock_ns() - begun_ns) > block_ns_) late_ += 1;
        const double taken = thread_cpu_s() - before;
        for (const AdversaryMessage& message : messages)
            if (kind_of(message.message) == MessageKind::NoteOn && message.message.data2 > 0) notes_ += 1;
        return taken;
    }

    [[nodiscard]] std::uint64_t notes() const { return notes_; }
    [[nodiscard]] std::uint64_t late() const { return late_; }

  private:
    std::size_t frames_;
    double block_ns_;
    Adversary adversary_;
    PluginCore core_;
    MaybeError error_;
    std::vector<float> left_, right_;
    std::uint64_t notes_ = 0, late_ = 0;
};

/// Plays a pass, the `number`th.
template <class Pass>
MaybeError time_pass(Pass& pass, std::size_t number, const BlockTimeSettings& settings, BlockTimes& times) {
    const double available_s = static_cast<double>(settings.frames) / settings.rate_hz;
    for (std::uint64_t block = 0; block < settings.blocks; ++block) {
        const auto share = static_cast<float>(pass.play_block() / available_s);
        times.raw.push_back(share);
        times.minimum[block] = std::min(times.minimum[block], share);
        if (block % 256 != 0) continue;
        if (auto stop = interruption()) return stop;
        const double done = static_cast<double>(number * settings.blocks + block);
        if (settings.progress)
            settings.progress(done / static_cast<double>(settings.passes * settings.blocks));
    }
    times.notes = pass.notes();
    times.late += pass.late();
    return std::nullopt;
}

MaybeError time_plugin_pass(const SharedInstrument& instrument, std::size_t number,
                            const BlockTimeSettings& settings, BlockTimes& times) {
    PluginPass pass(instrument, settings);
    if (pass.error()) return pass.error();
    return time_pass(pass, number, settings, times);
}

MaybeError time_live_pass(const SharedInstrument& instrument, std::size_t number,
                          const BlockTimeSettings& settings, BlockTimes& times) {
    LivePass pass(instrument, settings);
    return time_pass(pass, number, settings, times);
}

}  // namespace

Outcome<BlockTimes> measure_blocks(const SharedInstrument& instrument, const BlockTimeSettings& settings) {
    BlockTimes times;
    times.raw.reserve(settings.blocks * settings.passes);
    times.minimum.assign(settings.blocks, std::numeric_limits<float>::infinity());
    for (std::size_t p = 0; p < settings.passes; ++p) {
        const auto error = settings.plugin ? time_plugin_pass(instrument, p, settings, times)
                                           : time_live_pass(instrument, p, settings, times);
        if (error) return *error;
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
