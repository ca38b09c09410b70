// A chord of ten keys on a factory preset whose other courses ring: for counts of instructions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "instrument/instrument_cache.h"
#include "jawari/instrument/render.h"
#include "jawari/jawari.h"

namespace jawari::benchmarks {

/// All courses have been struck under the pedal, and ten of them are about to be struck again, or all if
/// there are fewer.
class PresetChord {
  public:
    explicit PresetChord(const std::string& preset);

    /// The block that begins with the chord.
    void play();

  private:
    static constexpr std::size_t block_frames = 64;

    [[nodiscard]] std::vector<int> keys() const;
    void render(const std::vector<InstrumentEvent>& events);

    host::SharedInstrument instrument_;
    InstrumentState state_;
    std::vector<InstrumentEvent> chord_;
    std::vector<double> left_, right_;
};

}  // namespace jawari::benchmarks
