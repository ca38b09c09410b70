// Open strings that ring on a preset, with its bridge moving or rigid: for counts of instructions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "instrument/instrument_cache.h"
#include "jawari/jawari.h"

namespace jawari::benchmarks {

/// Half a second ago all strings have been struck, open.
class RingingStrings {
  public:
    /// `moves`: whether the preset's bridge may move.
    RingingStrings(const std::string& preset, bool moves);

    /// A tenth of a second in blocks of 64 frames.
    void play();

  private:
    void render(const std::vector<InstrumentEvent>& events, std::size_t blocks);

    host::SharedInstrument instrument_;
    InstrumentState state_;
    std::vector<double> left_, right_;
};

}  // namespace jawari::benchmarks
