#include "commands/render/humanise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "formats/tuning/tuning.h"

namespace jawari::host {

namespace {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the library's distributions differ between machines.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// 0 to 1, 53 bits.
    double uniform() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
    }
    /// 0 to 1, most often 1/2.
    double triangular() { return (uniform() + uniform()) / 2; }

  private:
    std::uint64_t state_;
};

/// What a key's events need to stay in order.
struct Key {
    std::uint64_t delay = 0;   ///< of the note that is down
    std::uint64_t latest = 0;  ///< frame of the key's last event
};

void move(TimedEvent& timed, Key& key, std::uint64_t delay) {
    key.delay = delay;
    timed.frame = std::max(timed.frame + delay, key.latest);
    key.latest = timed.frame;
}

void humanise_part(ScorePart& part, Random& random, double rate_hz) {
    std::array<std::array<Key, midi_keys>, midi_channel_count> keys{};
    for (TimedEvent& timed : part.events) {
        InstrumentEvent& event = timed.event;
        const bool on = event.type == InstrumentEventType::NoteOn;
        const bool own_bend = event.type == InstrumentEventType::Bend && event.key != every_key;
        if (!on && !own_bend && event.type != InstrumentEventType::NoteOff) continue;
        Key& key = keys[static_cast<std::size_t>(event.channel)][static_cast<std::size_t>(event.key)];
        std::uint64_t delay = key.delay;
        if (on) {
            delay = static_cast<std::uint64_t>(std::llround(random.triangular() * latest_human_s * rate_hz));
            const double factor = 1 + human_velocity * (2 * random.triangular() - 1);
            event.value = std::clamp(event.value * factor, 1.0 / 127, 1.0);
        }
        move(timed, key, delay);
    }
    std::stable_sort(part.events.begin(), part.events.end(),
                     [](const TimedEvent& a, const TimedEvent& b) { return a.frame < b.frame; });
}

}  // namespace

void humanise(Score& score, std::uint64_t seed, double rate_hz) {
    Random random(seed);
    for (ScorePart& part : score.parts) {
        humanise_part(part, random, rate_hz);
        if (!part.events.empty()) score.end_frame = std::max(score.end_frame, part.events.back().frame);
    }
}

}  // namespace jawari::host
