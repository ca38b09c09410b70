// The instruments of a score, playing together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "commands/render/score.h"
#include "instrument/instrument_cache.h"
#include "jawari/instrument/state.h"

namespace jawari::host {

struct EnsemblePart {
    SharedInstrument instrument;
    InstrumentState state;
    const ScorePart* score = nullptr;
    std::size_t next = 0;  ///< event of the score
};

struct Ensemble {
    std::vector<EnsemblePart> parts;
    std::vector<std::string> stem_names;  ///< `1 bass-fretted E`: a stem per string of every part, in order
    double gain = 1;

    // Of the block rendered last:
    std::vector<double> left, right;
    std::vector<std::vector<double>> stems;  ///< empty unless asked for

    // Space to work in:
    std::vector<double> part_left, part_right;
    std::vector<double*> part_strings;
    std::vector<InstrumentEvent> events;
};

/// One instrument for each part of the score, in its order; the score must outlive the ensemble.
Ensemble make_ensemble(const Score& score, const std::vector<SharedInstrument>& instruments, bool with_stems,
                       double gain);

/// Renders the frames from `begin` on, the first one after those rendered before, into the ensemble's block.
void render_block(Ensemble& ensemble, std::uint64_t begin, std::size_t frames);

}  // namespace jawari::host
