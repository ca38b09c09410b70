// Which frame of a block a time belongs to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "jawari/realtime.h"

namespace jawari::host {

/// Callbacks of audio systems come with jitter; a delay-locked loop estimates when each block really began
/// (F. Adriaensen, "Using a DLL to filter time", Linux Audio Conference 2005). A message that came in at time
/// t sounds `latency_frames` frames after the frame that was due at t: all are late alike.
struct BlockClock {
    double seconds_per_frame = 1.0 / 48000;  ///< estimate
    double nominal = 1.0 / 48000;
    double start_s = 0;              ///< of the coming block, estimate, after `origin_ns`
    std::int64_t origin_ns = 0;      ///< of the first block
    std::size_t latency_frames = 0;  ///< largest block so far
    std::size_t frames = 0;          ///< of the block before
    bool running = false;
};

BlockClock make_block_clock(double rate_hz);

/// At the start of a block of `frames` frames.
void begin_block(BlockClock& clock, std::int64_t now_ns, std::size_t frames) JAWARI_REALTIME;

/// Offset in the block, possibly past its end; 0 for times before it.
std::size_t offset_of(const BlockClock& clock, std::int64_t time_ns) JAWARI_REALTIME;

}  // namespace jawari::host
