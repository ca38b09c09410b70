// The MIDI file of a performance that is being recorded. Its tick is one output frame, so that `jawari
// render` plays every message at the very frame at which it was played.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "player/capture_ring.h"

namespace jawari::host {

/// division ticks make a quarter note of us_per_quarter microseconds: division 10^6/us_per_quarter = rate.
struct FrameTicks {
    std::uint16_t division = 0;  ///< 1 to 32767
    std::uint32_t us_per_quarter = 0;
};

/// Nothing if no tempo gives the rate exactly (an odd rate above 32767 Hz, say).
std::optional<FrameTicks> ticks_per_frame(std::uint32_t rate_hz);

class TakeMidi {
  public:
    /// A file of type 0 without events. An existing file is an error unless `overwrite`.
    static Outcome<TakeMidi> create(const std::string& path, std::uint32_t rate_hz, bool overwrite);

    TakeMidi(TakeMidi&& other) noexcept;
    TakeMidi& operator=(TakeMidi&& other) noexcept;
    TakeMidi(const TakeMidi&) = delete;
    TakeMidi& operator=(const TakeMidi&) = delete;
    ~TakeMidi();

    /// In order of frames.
    void add(const CapturedMessage& captured);
    /// Writes what was added, and that the piece lasts until `end_frame`, where keys that are down go up:
    /// afterwards the file is whole.
    MaybeError update(std::uint64_t end_frame);
    MaybeError close(std::uint64_t end_frame);

  private:
    TakeMidi(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
    void note_key(const ChannelMessage& message);
    MaybeError write_at(std::uint64_t offset, const std::string& bytes);

    std::string path_;
    int descriptor_ = -1;
    std::string pending_;          // bytes of events not yet in the file
    std::uint64_t track_end_ = 0;  // offset behind the last event in the file, where the end of track stands
    std::uint64_t frame_ = 0;      // of the last event
    std::vector<std::uint16_t> open_ = std::vector<std::uint16_t>(16 * 128);  // notes held, of each key
};

}  // namespace jawari::host
