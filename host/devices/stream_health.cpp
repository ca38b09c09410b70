#include "devices/stream_health.h"

namespace jawari::host {

namespace {

constexpr double window_length_s = 1;

}  // namespace

StreamState look(StreamHealth& health, bool is_open, std::uint64_t frames, double rate_hz, bool freewheels,
                 double now_s) {
    if (!health.begun) health = {frames, now_s, frames, now_s, true};
    if (!is_open) return StreamState::Lost;
    if (frames != health.frames) {
        health.frames = frames;
        health.changed_s = now_s;
    }
    const double silent_s = now_s - health.changed_s;
    if (silent_s >= lost_after_s) return StreamState::Lost;

    const double window_s = now_s - health.window_s;
    if (window_s >= window_length_s) {
        const double asked_s = static_cast<double>(frames - health.window_frames) / rate_hz;
        health.window_frames = frames;
        health.window_s = now_s;
        // A large block more or less is no sign of anything.
        if (!freewheels && asked_s > runaway_factor * window_s + 1) return StreamState::Lost;
    }
    return silent_s >= silent_after_s ? StreamState::Silent : StreamState::Running;
}

}  // namespace jawari::host
