#include "commands/bench_latency/event_delay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "player/player.h"

namespace jawari::host {

namespace {

constexpr std::size_t block = 64;
constexpr std::size_t warm_up_blocks = 4;
constexpr std::size_t listening_blocks = 12;
constexpr std::size_t most_keys = 5;

/// A message at an offset of the first block after the warm-up.
struct Probe {
    ChannelMessage message;
    std::size_t offset = 0;
};

std::vector<int> keys_of(const InstrumentModel& model) {
    std::vector<int> keys;
    for (const CourseModel& course : model.courses) {  // whose first string gives the keys
        for (const StoppedStringModel& stopped : model.strings[course.strings.front()].stopped) {
            if (stopped.key >= 0) keys.push_back(stopped.key);
        }
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

std::vector<double> performance(const SharedInstrument& instrument, double rate_hz, int held_key,
                                const Probe* probe) {
    LiveSettings settings;
    settings.rate_hz = rate_hz;
    settings.overload.enabled = false;
    LivePlayer player(settings);
    MidiPort& port = *player.add_port();
    player.publish(instrument);
    if (held_key >= 0) port.push({{0x90, static_cast<std::uint8_t>(held_key), 100}, 0});
    constexpr std::size_t blocks = warm_up_blocks + listening_blocks;
    std::vector<double> left(blocks * block), right(blocks * block);
    constexpr std::int64_t start_ns = 1'000'000'000;
    const auto time_of = [&](double frame) { return start_ns + std::llround(1e9 * frame / rate_hz); };
    for (std::size_t n = 0; n < blocks; ++n) {
        const auto begin = static_cast<double>(n * block);
        if (n == warm_up_blocks && probe != nullptr)
            port.push({probe->message, time_of(begin - block + static_cast<double>(probe->offset) + 0.5)});
        player.process(left.data() + n * block, right.data() + n * block, block, time_of(begin));
    }
    for (std::size_t n = 0; n < left.size(); ++n) left[n] += 0.5 * right[n];
    return left;
}

/// Frames from the probe's own to the first that differs.
std::optional<std::size_t> delay_of(const SharedInstrument& instrument, double rate_hz, int held_key,
                                    const Probe& probe) {
    const std::vector<double> with = performance(instrument, rate_hz, held_key, &probe);
    const std::vector<double> without = performance(instrument, rate_hz, held_key, nullptr);
    const std::size_t own = warm_up_blocks * block + probe.offset;
    for (std::size_t n = 0; n < with.size(); ++n) {
        if (with[n] != without[n]) return n >= own ? std::optional(n - own) : std::nullopt;
    }
    return std::nullopt;
}

void include(std::optional<std::size_t>& most, std::optional<std::size_t> delay) {
    most = most && delay ? std::optional(std::max(*most, *delay)) : std::nullopt;
}

}  // namespace

EventDelay measure_event_delay(const SharedInstrument& instrument, double rate_hz) {
    EventDelay delay{0, 0, 0};
    const std::vector<int> keys = keys_of(instrument->model);
    const std::size_t count = std::min(keys.size(), most_keys);
    for (std::size_t i = 0; i < count; ++i) {
        const int key = keys[i * (keys.size() - 1) / std::max<std::size_t>(1, count - 1)];
        const int other = keys[(i + 1) % count * (keys.size() - 1) / std::max<std::size_t>(1, count - 1)];
        const Probe note{{0x90, static_cast<std::uint8_t>(key), 100}, 13 * i % block};
        include(delay.at_rest, delay_of(instrument, rate_hz, -1, note));
        include(delay.sounding, delay_of(instrument, rate_hz, other, note));
        delay.events += 2;
    }
    return delay;
}

}  // namespace jawari::host
