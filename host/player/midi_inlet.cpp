#include "player/midi_inlet.h"

#include <algorithm>

namespace jawari::host {

MidiPort* MidiInlet::add_port() {
    const std::size_t count = count_.load(std::memory_order_relaxed);
    if (count == most_ports) return nullptr;
    ports_[count] = std::make_unique<MidiPort>();
    count_.store(count + 1, std::memory_order_release);
    return ports_[count].get();
}

void MidiInlet::begin_block() JAWARI_REALTIME {
    const std::size_t count = count_.load(std::memory_order_acquire);
    for (std::size_t i = 0; i < count; ++i) ports_[i]->last_offset_ = 0;
}

bool MidiInlet::next(const BlockClock& clock, std::size_t frames, ArrivedMessage& arrived) JAWARI_REALTIME {
    const std::size_t count = count_.load(std::memory_order_acquire);
    MidiPort* earliest = nullptr;
    std::size_t offset = frames;
    for (std::size_t i = 0; i < count; ++i) {
        MidiPort& port = *ports_[i];
        if (port.queue_.read_available() == 0) continue;
        const std::size_t due = std::max(port.last_offset_, offset_of(clock, port.queue_.front().time_ns));
        if (due >= offset) continue;
        earliest = &port;
        offset = due;
    }
    if (earliest == nullptr) return false;
    arrived = {offset, earliest->queue_.front().message};
    earliest->last_offset_ = offset;
    earliest->queue_.pop();
    return true;
}

std::uint64_t MidiInlet::dropped() const noexcept {
    std::uint64_t sum = 0;
    const std::size_t count = count_.load(std::memory_order_acquire);
    for (std::size_t i = 0; i < count; ++i) sum += ports_[i]->dropped();
    return sum;
}

}  // namespace jawari::host
