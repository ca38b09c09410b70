// An instrument on its way over a stage: made by a control thread, played and given back by the audio thread,
// destroyed by the control thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "instrument/instrument_cache.h"
#include "jawari/instrument/state.h"
#include "stage/settings.h"

namespace jawari::host {

struct StagedInstrument {
    SharedInstrument loaded;
    InstrumentState state;
    /// Fresh, with settings of its own, in force from its entrance on. Null: those before it stay.
    std::unique_ptr<const MidiInterpreter> interpreter;

    std::vector<double> left, right;           ///< of the block
    std::vector<std::vector<double>> strings;  ///< of the block, one a string; empty unless asked for
    std::vector<double*> string_places;        ///< where they are, for InstrumentOutput
    std::uint64_t ring_frames = 0;             ///< since another instrument took its place
    bool fading = false;                       ///< its sound is being taken away
    std::size_t fade_frame = 0;

    // Looked at string by string, one a block:
    std::size_t surveyed = 0;            ///< the next string
    double energy_sum_J = 0;             ///< energy of the strings before it [J]
    std::uint64_t nonfinite_sum = 0;     ///< nonfinite resets of the strings before it
    double energy_J = 0;                 ///< energy of all strings, as of the last round [J]
    std::uint64_t nonfinite_resets = 0;  ///< nonfinite resets of all strings, as of the last round
};

/// At rest, with room for all that rendering needs. Threads: any. Allocates.
std::unique_ptr<StagedInstrument> make_staged(const SharedInstrument& loaded, const StageSettings& settings);

}  // namespace jawari::host
