// A VST 3 host hands over events, and values of each parameter, apart: here they come into the order of their
// frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "jawari/realtime.h"

namespace jawari::host::vst3 {

/// A value of a parameter, or the number of an event.
struct TimedChange {
    std::uint32_t frame = 0;
    std::uint32_t order = 0;  ///< at one frame, in which they were added
    bool is_event = false;
    std::uint32_t which = 0;  ///< parameter's id, or event's number
    double value = 0;         ///< of the parameter, 0 to 1
};

/// One thread at a time. Never allocates.
class TimedChanges {
  public:
    static constexpr std::size_t most_changes = 4096;

    void clear() JAWARI_REALTIME { count_ = 0; }
    [[nodiscard]] bool is_full() const JAWARI_REALTIME { return count_ == most_changes; }

    /// Frames before the block are its first. Precondition: not is_full().
    void add_value(std::int32_t frame, std::uint32_t parameter, double value) JAWARI_REALTIME {
        add({frame_of(frame), 0, false, parameter, value});
    }
    void add_event(std::int32_t frame, std::uint32_t number) JAWARI_REALTIME {
        add({frame_of(frame), 0, true, number, 0});
    }

    /// By frames, at one frame as added. Holds until the next call of anything else.
    std::span<const TimedChange> sorted() JAWARI_REALTIME;

  private:
    static std::uint32_t frame_of(std::int32_t frame) JAWARI_REALTIME {
        return frame < 0 ? 0 : static_cast<std::uint32_t>(frame);
    }
    void add(TimedChange change) JAWARI_REALTIME;

    std::array<TimedChange, most_changes> changes_{};
    std::size_t count_ = 0;
};

}  // namespace jawari::host::vst3
