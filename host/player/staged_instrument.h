// An instrument on its way through a live performance: published by the control thread, played and given back
// by the audio thread, destroyed by the control thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "instrument/instrument_cache.h"
#include "jawari/instrument/state.h"

namespace jawari::host {

struct LiveInstrument {
    SharedInstrument loaded;
    InstrumentState state;
    std::vector<double> left, right;  ///< of the block
    std::uint64_t ring_frames = 0;    ///< since another instrument took its place
    bool fading = false;              ///< its sound is being taken away
    std::size_t fade_frame = 0;

    // Looked at string by string, one a block:
    std::size_t surveyed = 0;            ///< the next string
    double energy_sum_J = 0;             ///< energy of the strings before it [J]
    std::uint64_t nonfinite_sum = 0;     ///< nonfinite resets of the strings before it
    double energy_J = 0;                 ///< energy of all strings, as of the last round [J]
    std::uint64_t nonfinite_resets = 0;  ///< nonfinite resets of all strings, as of the last round
};

}  // namespace jawari::host
