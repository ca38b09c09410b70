#include "long_play.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <memory>
#include <numbers>

#include <unistd.h>

#include "base/cpu_clock.h"
#include "jawari/denormals.h"
#include "player/player.h"

namespace jawari::soak {
namespace {

using host::ChannelMessage;

constexpr std::size_t block_frames = 128;
constexpr double minute_s = 60;
/// The ringing string is plucked anew this often, long before it would be at rest.
constexpr double pluck_s = 15;
// It is alone in these two windows, by which its pitch is measured: after the minute's last pluck.
constexpr double first_window_s = 50, second_window_s = 54, window_s = 4;

struct Cue {
    double time_s = 0;
    ChannelMessage message;
};

ChannelMessage note_on(int key, int velocity) {
    return {0x90, static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(velocity)};
}
ChannelMessage note_off(int key) {
    return {0x80, static_cast<std::uint8_t>(key), 64};
}
ChannelMessage control(int number, int value) {
    return {0xB0, static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(value)};
}
ChannelMessage bend(int value) {
    return {0xE0, static_cast<std::uint8_t>(value & 127), static_cast<std::uint8_t>(value >> 7)};
}

/// The music of a minute, in order. `key`: of the string that rings on, the highest; the phrase is below it.
std::vector<Cue> minute_of_music(int key) {
    std::vector<Cue> cues;
    for (double t = 0; t < minute_s; t += pluck_s) cues.push_back({t, note_on(key, 80)});
    for (int i = 0; i < 4; ++i) {
        const int other = key - 5 - 3 * i;
        const double t = 2 + i;
        cues.push_back({t, note_on(other, 40 + 20 * i)});
        cues.push_back({t + 0.45, note_off(other)});
    }
    cues.push_back({3.1, control(1, 90)});  // vibrato
    cues.push_back({3.2, bend(8192 + 3000)});
    cues.push_back({3.7, bend(8192)});
    cues.push_back({4.1, control(1, 0)});
    cues.push_back({4.2, control(64, 127)});  // pedal
    cues.push_back({5.7, control(64, 0)});
    cues.push_back({5.8, control(7, 60)});  // volume
    cues.push_back({6.5, control(7, 127)});
    std::stable_sort(cues.begin(), cues.end(),
                     [](const Cue& a, const Cue& b) { return a.time_s < b.time_s; });
    return cues;
}

double resident_kib() {
    std::ifstream file("/proc/self/statm");
    double total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024;
}

/// Correlation with a turning phasor under a Hann window.
struct Correlation {
    double begin_s = 0;
    std::complex<double> sum = 0;

    void add(double t_s, double omega, double sample) {
        const double u = (t_s - begin_s) / window_s;
        if (u < 0 || u >= 1) return;
        const double weight = 1 - std::cos(2 * std::numbers::pi * u);
        sum += weight * sample * std::polar(1.0, -omega * t_s);
    }
};

/// Takes a minute's samples.
struct Ear {
    double nominal_hz = 0;
    double squares = 0;
    std::uint64_t frames = 0;
    Correlation first{first_window_s}, second{second_window_s};

    void hear(double t_s, double sample) {
        squares += sample * sample;
        frames += 1;
        const double omega = 2 * std::numbers::pi * nominal_hz;
        first.add(t_s, omega, sample);
        second.add(t_s, omega, sample);
    }
    [[nodiscard]] double level() const { return std::sqrt(squares / static_cast<double>(frames)); }
    /// By how much the phase has moved between the windows, less what it moves at the nominal pitch.
    [[nodiscard]] double pitch_hz() const {
        const double turned = std::arg(second.sum / first.sum) / (2 * std::numbers::pi);
        return nominal_hz + turned / (second_window_s - first_window_s);
    }
};

class Performance {
  public:
    Performance(const host::SharedInstrument& instrument, double rate_hz)
        : rate_hz_(rate_hz),
          key_(instrument->model.strings.back().stopped.front().key),
          nominal_hz_(instrument->model.strings.back().stopped.front().frequency_hz),
          cues_(minute_of_music(key_)),
          player_(settings(rate_hz)),
          port_(player_.add_port()) {
        player_.publish(instrument);
    }

    Minute play_minute() {
        Ear ear{.nominal_hz = nominal_hz_};
        Minute minute;
        const auto frames = static_cast<std::size_t>(minute_s * rate_hz_);
        std::size_t next = 0;
        for (std::size_t done = 0; done < frames; done += block_frames) {
            const double now_s = static_cast<double>(done) / rate_hz_;
            for (; next < cues_.size() && cues_[next].time_s <= now_s; ++next)
                port_->push({cues_[next].message, 0});
            process();
            for (std::size_t n = 0; n < block_frames; ++n)
                ear.hear(static_cast<double>(done + n) / rate_hz_, (left_[n] + right_[n]) / 2);
            if (minute.energy_J == 0 && now_s >= first_window_s)
                minute.energy_J = player_.statistics().energy_J;
        }
        minute.pitch_hz = ear.pitch_hz();
        minute.level = ear.level();
        minute.resident_kib = resident_kib();
        return minute;
    }

    host::LiveStatistics statistics() { return player_.statistics(); }

  private:
    static host::LiveSettings settings(double rate_hz) {
        host::LiveSettings settings;
        settings.rate_hz = rate_hz;
        settings.overload.enabled = false;  // nobody waits for it
        settings.limiter_dbfs = -1;
        return settings;
    }

    void process() {
        player_.process(left_.data(), right_.data(), block_frames, now_ns_);
        now_ns_ += static_cast<std::int64_t>(1e9 * block_frames / rate_hz_);
        player_.collect();
        while (player_.notice()) {
        }
    }

    double rate_hz_;
    int key_;
    double nominal_hz_;
    std::vector<Cue> cues_;
    host::LivePlayer player_;
    host::MidiPort* port_;
    std::array<double, block_frames> left_{}, right_{};
    std::int64_t now_ns_ = 1000000000;
};

Minute mean_of(std::vector<Minute>::const_iterator begin, std::size_t count) {
    Minute mean;
    for (auto minute = begin; minute != begin + static_cast<std::ptrdiff_t>(count); ++minute) {
        mean.pitch_hz += minute->pitch_hz / static_cast<double>(count);
        mean.level += minute->level / static_cast<double>(count);
        mean.energy_J += minute->energy_J / static_cast<double>(count);
        mean.resident_kib += minute->resident_kib / static_cast<double>(count);
    }
    return mean;
}

}  // namespace

LongPlay play_long(const host::SharedInstrument& instrument, double rate_hz, std::uint64_t minutes,
                   const std::function<bool(const LongPlay&)>& goes_on) {
    const NoDenormals guard;  // as jawari plays
    LongPlay played;
    played.minutes.reserve(minutes);  // what grows must be the player's
    const double start_s = host::thread_cpu_s();
    Performance performance(instrument, rate_hz);
    for (std::uint64_t m = 0; m < minutes; ++m) {
        played.minutes.push_back(performance.play_minute());
        const host::LiveStatistics statistics = performance.statistics();
        played.notes = statistics.notes;
        played.nonfinite_resets = statistics.nonfinite_resets;
        played.dropped_messages = statistics.dropped_messages;
        played.cpu_s = host::thread_cpu_s() - start_s;
        if (!goes_on(played)) break;
    }
    return played;
}

Drift drift_of(const std::vector<Minute>& minutes, std::size_t count) {
    if (minutes.size() < count + 1) return {};
    const Minute first = mean_of(minutes.begin() + 1, count);
    const Minute last = mean_of(minutes.end() - static_cast<std::ptrdiff_t>(count), count);
    Drift drift;
    drift.pitch_cents = 1200 * std::log2(last.pitch_hz / first.pitch_hz);
    drift.level_db = 20 * std::log10(last.level / first.level);
    drift.energy_db = 10 * std::log10(last.energy_J / first.energy_J);
    drift.resident_kib = last.resident_kib - first.resident_kib;
    return drift;
}

}  // namespace jawari::soak
