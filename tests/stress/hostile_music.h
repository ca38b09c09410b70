// Hostile playing of an instrument: note storms, every parameter in motion, wide bends, pedals, changes of
// quality level, in blocks of random length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dice.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/render.h"

namespace jawari::stress {

struct QualityChange {
    std::size_t string = 0;
    std::size_t quality_level = 0;
};

struct MusicBlock {
    std::size_t frames = 1;
    std::vector<QualityChange> quality_changes;  ///< before the block
    std::vector<InstrumentEvent> events;         ///< in order
};

/// The blocks of a performance, one after another: the same for the same seed.
class HostileMusic {
  public:
    HostileMusic(const InstrumentModel& model, std::uint64_t seed);
    MusicBlock next();

  private:
    InstrumentEvent event();
    InstrumentEvent note();
    InstrumentEvent bend();
    InstrumentEvent parameter();
    InstrumentEvent nonsense();
    int key();

    Dice dice_;
    std::vector<int> keys_;
    std::size_t strings_ = 0, lower_qualities_ = 0;
    std::size_t most_events_ = 1;
    int channels_ = 1;
    double bend_range_ = 2;
    double notes_ = 0.5, bends_ = 0.1, parameters_ = 0.2;  ///< shares of all events
};

}  // namespace jawari::stress
