// What messages before an excerpt of a piece leave behind: controllers, bends and pedals, but no notes.
#pragma once

#include <cstdint>
#include <vector>

#include "jawari/instrument/events.h"
#include "midi/interpreter.h"

namespace jawari::host {

class ChasedState {
  public:
    /// Events of one instrument, in order of time.
    void add(const InstrumentEvent& event);

    /// The last event of each kind and channel, in the order in which they came.
    [[nodiscard]] const std::vector<InstrumentEvent>& events() const { return events_; }

  private:
    std::vector<InstrumentEvent> events_;
};

/// Notes that are down on channels that are no drums.
std::uint64_t open_notes(const MidiInterpreter& interpreter);

}  // namespace jawari::host
