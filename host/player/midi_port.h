// Where MIDI comes in: one queue for each thread that brings messages.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "midi/channel_message.h"

namespace jawari::host {

/// A MIDI message with the time at which it came in.
struct TimedMidi {
    ChannelMessage message;
    std::int64_t time_ns = 0;  ///< on the clock of LivePlayer::process(); 0: as early as possible
};

inline constexpr std::size_t midi_port_capacity = 4096;  ///< messages

/// One thread pushes, the audio thread takes.
class MidiPort {
  public:
    /// From the port's own thread. False if the queue is full: the message is lost and counted.
    bool push(const TimedMidi& message) noexcept {
        if (queue_.push(message)) return true;
        dropped_.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  private:
    friend class MidiInlet;
    boost::lockfree::spsc_queue<TimedMidi, boost::lockfree::capacity<midi_port_capacity>> queue_;
    std::atomic<std::uint64_t> dropped_{0};
    std::size_t last_offset_ = 0;  // of the audio thread: messages of a port keep their order
};

}  // namespace jawari::host
