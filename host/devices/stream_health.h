// Whether a stream still runs, judged from its counters: drivers seldom say that a device is gone.
#pragma once

#include <cstdint>
#include <string>

namespace jawari::host {

enum class StreamState {
    Running,
    Silent,  ///< no block for silent_after_s: asleep, or stuck
    Lost     ///< closed, silent for lost_after_s, or asking for sound faster than it can play
};

inline constexpr double silent_after_s = 1;
inline constexpr double lost_after_s = 5;
/// A driver whose device was pulled out returns from writing at once, so blocks come as fast as the CPU goes.
inline constexpr double runaway_factor = 3;

struct StreamHealth {
    std::uint64_t frames = 0;         ///< at the last look at which they had changed
    double changed_s = 0;             ///< time of it
    std::uint64_t window_frames = 0;  ///< at the begin of the window that is watched for speed
    double window_s = 0;
    bool begun = false;
};

/// `frames`: that the stream has asked for so far, at the time `now_s`, seconds on any steady clock. To be
/// called several times a second. `freewheels`: the driver may rightly run faster than time (JACK does when
/// it exports), so speed tells nothing.
StreamState look(StreamHealth& health, bool is_open, std::uint64_t frames, double rate_hz, bool freewheels,
                 double now_s);

}  // namespace jawari::host
