#include "live_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/cpu_clock.h"
#include "commands/bench_latency/adversary.h"
#include "dice.h"
#include "invariants.h"
#include "player/player.h"

namespace jawari::stress {
namespace {

/// Share of the budget for the first pass; the second takes as long.
constexpr double first_share = 0.55;
constexpr double ceiling_dbfs = -1;

using Instruments = std::vector<host::SharedInstrument>;

/// All for the rate of the first; why there are none is left in report.refused.
Instruments compile_instruments(const PresetShelf& shelf, Report& report, double& rate_hz) {
    Instruments instruments;
    for (std::uint64_t n = 0; n < 3; ++n) {
        HostileInstrument hostile = make_hostile_instrument(shelf, report.seed + (n << 40));
        if (n == 0) rate_hz = hostile.output_rate_hz;
        auto compiled = compile_instrument(hostile.description, rate_hz);
        if (!compiled) {
            report.refused = compiled.failure().line();
            return {};
        }
        auto loaded = std::make_shared<host::LoadedInstrument>();
        loaded->preset = {"stress", std::move(hostile.description)};
        loaded->model = std::move(compiled.value());
        instruments.push_back(std::move(loaded));
    }
    return instruments;
}

struct Sound {
    std::vector<double> left, right;
};

/// The performance of a seed, block by block: the same whenever it is given.
class Performance {
  public:
    Performance(const Instruments& instruments, double rate_hz, std::uint64_t seed)
        : instruments_(instruments),
          rate_hz_(rate_hz),
          dice_(~seed),
          limited_(dice_.chance(0.5)),
          player_(settings()),
          port_(player_.add_port()),
          adversary_(instruments.front()->model, static_cast<std::uint32_t>(seed)) {
        player_.publish(instruments_.front());
    }

    void next(Sound& sound) {
        const std::size_t frames = dice_.spread_whole(1, 512);
        command();
        for (const host::AdversaryMessage& message : adversary_.next(frames))
            port_->push({message.message, 0});
        sound.left.resize(sound.left.size() + frames);
        sound.right.resize(sound.right.size() + frames);
        player_.process(sound.left.data() + sound.left.size() - frames,
                        sound.right.data() + sound.right.size() - frames, frames, now_ns_);
        now_ns_ += static_cast<std::int64_t>(1e9 * static_cast<double>(frames) / rate_hz_);
        player_.collect();
    }

    void check(const Sound& sound, std::size_t from, Judge& judge) {
        const auto left = std::span(sound.left).subspan(from);
        const auto right = std::span(sound.right).subspan(from);
        check_finite(judge, left, "left");
        check_finite(judge, right, "right");
        check_resets(judge, player_.statistics().nonfinite_resets, "strings and bodies");
        if (!limited_) return;
        const double ceiling = std::pow(10, ceiling_dbfs / 20);
        check_output(judge, left, ceiling, "left of the limiter");
        check_output(judge, right, ceiling, "right of the limiter");
    }

    [[nodiscard]] std::uint64_t notes() { return player_.statistics().notes; }

  private:
    host::LiveSettings settings() const {
        host::LiveSettings settings;
        settings.rate_hz = rate_hz_;
        settings.interpreter.map = host::adversary_map();
        settings.overload.enabled = false;  // what is played must not depend on the machine
        if (limited_) settings.limiter_dbfs = ceiling_dbfs;
        return settings;
    }

    /// Instruments change mid-note; parameters and panic come from the shell.
    void command() {
        if (dice_.chance(0.1)) player_.publish(instruments_[dice_.whole(0, instruments_.size() - 1)]);
        if (dice_.chance(0.01)) player_.send({.kind = host::LiveCommand::Kind::Panic});
        if (!dice_.chance(0.3)) return;
        const ParameterDeclaration& declared = parameter_table()[dice_.whole(0, parameter_count - 1)];
        player_.send({.kind = host::LiveCommand::Kind::SetParameter,
                      .parameter = declared.id,
                      .channel = static_cast<int>(dice_.whole(0, 16)) - 1,
                      .value = parameter_value(declared, dice_.unit())});
    }

    const Instruments& instruments_;
    double rate_hz_;
    Dice dice_;
    bool limited_;
    host::LivePlayer player_;
    host::MidiPort* port_;
    host::Adversary adversary_;
    std::int64_t now_ns_ = 1000000000;
};

void play(const Instruments& instruments, double rate_hz, const Budget& budget, double start_cpu_s,
          Report& report) {
    const auto goes_on = [&] {
        if (budget.blocks > 0) return report.blocks < budget.blocks;
        return report.blocks == 0 || host::thread_cpu_s() - start_cpu_s < first_share * budget.cpu_s;
    };
    Performance performance(instruments, rate_hz, report.seed);
    Sound sound, again;
    while (goes_on()) {
        const std::size_t from = sound.left.size();
        performance.next(sound);
        performance.check(sound, from, report.judge);
        report.blocks += 1;
    }
    report.frames = sound.left.size();
    report.notes = performance.notes();
    Performance repeated(instruments, rate_hz, report.seed);
    for (std::uint64_t b = 0; b < report.blocks; ++b) repeated.next(again);
    check_same(report.judge, sound.left, again.left, "left");
    check_same(report.judge, sound.right, again.right, "right");
}

}  // namespace

Report run_live(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget) {
    const double start_cpu_s = host::thread_cpu_s();
    Report report;
    report.seed = seed;
    report.kind = "live";
    double rate_hz = 0;
    const Instruments instruments = compile_instruments(shelf, report, rate_hz);
    if (!instruments.empty()) {
        play(instruments, rate_hz, budget, start_cpu_s, report);
        report.sound_s = static_cast<double>(report.frames) / rate_hz;
        for (const host::SharedInstrument& instrument : instruments)
            report.strings += instrument->model.strings.size();
    }
    report.cpu_s = host::thread_cpu_s() - start_cpu_s;
    return report;
}

}  // namespace jawari::stress
