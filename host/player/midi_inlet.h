// All MIDI ports, merged by time on the audio thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "jawari/realtime.h"
#include "player/block_clock.h"
#include "player/midi_port.h"

namespace jawari::host {

struct ArrivedMessage {
    std::size_t offset = 0;  ///< frame of the block
    ChannelMessage message;
};

class MidiInlet {
  public:
    static constexpr std::size_t most_ports = 16;

    /// Control thread, at any time. Null if there are most_ports already. Ports live as long as the inlet.
    MidiPort* add_port();

    /// Audio thread: the earliest waiting message that is due before `frames`; of messages at the same frame
    /// that of the port added first. A port's messages keep their order. False if none is due.
    bool next(const BlockClock& clock, std::size_t frames, ArrivedMessage& arrived) JAWARI_REALTIME;

    /// Audio thread, before the first next() of a block.
    void begin_block() JAWARI_REALTIME;

    /// Any thread.
    [[nodiscard]] std::uint64_t dropped() const noexcept;

  private:
    std::array<std::unique_ptr<MidiPort>, most_ports> ports_;
    std::atomic<std::size_t> count_{0};  // ports_ up to here may be read by any thread
};

}  // namespace jawari::host
