#include "player/block_clock.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jawari::host {

namespace {

constexpr double bandwidth_hz = 1;
/// A block that begins this much off its time is a new start: the audio system has stood still.
constexpr double lost_s = 0.05;
/// Sound cards are this far off their nominal rate at most.
constexpr double largest_drift = 0.01;

}  // namespace

BlockClock make_block_clock(double rate_hz) {
    BlockClock clock;
    clock.nominal = 1 / rate_hz;
    clock.seconds_per_frame = clock.nominal;
    return clock;
}

void begin_block(BlockClock& clock, std::int64_t now_ns, std::size_t frames) JAWARI_REALTIME {
    clock.latency_frames = std::max(clock.latency_frames, frames);
    const double elapsed_s = static_cast<double>(clock.frames) * clock.seconds_per_frame;
    const double expected_s = clock.start_s + elapsed_s;
    const double error_s = 1e-9 * static_cast<double>(now_ns - clock.origin_ns) - expected_s;
    if (!clock.running || std::abs(error_s) > lost_s) {
        clock.running = true;
        clock.origin_ns = now_ns;
        clock.start_s = 0;
        clock.seconds_per_frame = clock.nominal;
    } else {
        const double omega = 2 * std::numbers::pi * bandwidth_hz * elapsed_s;
        clock.start_s = expected_s + std::min(1.0, std::numbers::sqrt2 * omega) * error_s;
        if (clock.frames > 0)
            clock.seconds_per_frame +=
                std::min(1.0, omega * omega) * error_s / static_cast<double>(clock.frames);
        clock.seconds_per_frame = std::clamp(clock.seconds_per_frame, (1 - largest_drift) * clock.nominal,
                                             (1 + largest_drift) * clock.nominal);
    }
    clock.frames = frames;
}

std::size_t offset_of(const BlockClock& clock, std::int64_t time_ns) JAWARI_REALTIME {
    if (time_ns == 0) return 0;
    const double late_s = 1e-9 * static_cast<double>(time_ns - clock.origin_ns) - clock.start_s;
    const double offset =
        static_cast<double>(clock.latency_frames) + std::floor(late_s / clock.seconds_per_frame);
    // A time that is more than a second ahead is wrong, and must not hold its message back.
    return offset > 0 && offset * clock.nominal <= 1 ? static_cast<std::size_t>(offset) : 0;
}

}  // namespace jawari::host
