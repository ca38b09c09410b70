// What a recording takes from the audio thread: its sound and the messages that made it.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "midi/channel_message.h"

namespace jawari::host {

struct StereoFrame {
    double left = 0;
    double right = 0;
};

struct CapturedMessage {
    std::uint64_t frame = 0;  ///< of the recording: the first that it could change
    ChannelMessage message;
};

/// Filled by the audio thread, emptied by one other thread.
struct CaptureRing {
    CaptureRing(std::size_t most_frames, std::size_t most_messages)
        : sound(most_frames), messages(most_messages) {}

    boost::lockfree::spsc_queue<StereoFrame> sound;
    boost::lockfree::spsc_queue<CapturedMessage> messages;
    std::atomic<std::uint64_t> frames{0};         ///< of the recording so far, lost ones included
    std::atomic<std::uint64_t> lost_frames{0};    ///< the ring was full
    std::atomic<std::uint64_t> lost_messages{0};  ///< likewise
    std::atomic<bool> ended{false};               ///< the audio thread has put its last frame in and let go
};

}  // namespace jawari::host
