// How a MIDI file is read: strictly, or as players read what is broken; and what was repaired.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jawari/result.h"

namespace jawari::host {

enum class MidiReading {
    Strict,  ///< the first departure from the standard is a failure
    Lenient  ///< what is missing or too much is repaired, as fluidsynth or TiMidity would, and noted
};

/// A departure from the standard that a lenient reading repaired.
struct MidiRepair {
    std::string place;      ///< `byte 40 (track 1)`: the first one
    std::string what;       ///< as a failure names it: `no End of Track`
    std::string assumed;    ///< `the track ends with its chunk`
    std::size_t count = 1;  ///< in this track, of this kind
};

/// `byte 40 (track 1): no End of Track; the track ends with its chunk`, with the count if it is above 1.
std::string text_of(const MidiRepair& repair);

/// What the chunks of a file share while it is read.
class MidiNotes {
  public:
    explicit MidiNotes(MidiReading reading) : reading_(reading) {}

    [[nodiscard]] bool strict() const { return reading_ == MidiReading::Strict; }

    /// True: go on, with what is assumed. False: reading is strict, failure() is set. `kind` joins repairs of
    /// a track into one. `track` counts from 0, negative outside tracks.
    bool repair(std::size_t offset, int track, int kind, const std::string& value, const std::string& allowed,
                const std::string& assumed);

    [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
    std::vector<MidiRepair>& repairs() { return repairs_; }

    /// Number of a device that tracks name (FF 09): in the order in which they come, from 0.
    std::uint8_t port_of_device(const std::string& name);

  private:
    MidiReading reading_;
    std::optional<Failure> failure_;
    std::vector<MidiRepair> repairs_;
    std::map<std::pair<int, int>, std::size_t> index_;  ///< of a track and a kind
    std::map<std::string, std::uint8_t> devices_;
};

/// A failure at a byte offset; `track` counts from 0, negative outside tracks.
Failure midi_failure(std::size_t offset, int track, std::string value, std::string allowed);

}  // namespace jawari::host
