// What a live performance is told at its start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "midi/interpreter.h"
#include "player/governor.h"
#include "stage/settings.h"

namespace jawari::host {

/// Nanoseconds of a clock that never goes back: std::chrono::steady_clock, which is read without a system
/// call.
std::int64_t steady_clock_ns() noexcept;

struct LiveSettings {
    double rate_hz = 48000;
    std::size_t most_frames = 1024;  ///< rendered at once; longer blocks are rendered in several goes
    InterpreterSettings interpreter;
    double gain = 1;                     ///< factor of everything, 0 or more
    std::optional<double> limiter_dbfs;  ///< ceiling; delays everything by limiter_look_ahead_s
    double ring_out_s = 10;  ///< longest time that an instrument sounds on after another took its place
    OverloadSettings overload;
    StageLink* link = nullptr;  ///< to a window; null: there is none. Outlives the player
    std::int64_t (*clock)() noexcept = steady_clock_ns;  ///< measures how long blocks take
};

}  // namespace jawari::host
