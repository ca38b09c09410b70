// Which notes the events of a block will begin, known before the block is rendered: hosts that must not be
// late weigh what they cost (scene/cost.h).
#pragma once

#include <cstddef>
#include <span>

#include "jawari/instrument/events.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// A note that begins on one string.
struct ExpectedNote {
    std::size_t string = 0;  ///< index into InstrumentModel::strings
    std::size_t fret = 0;    ///< index into InstrumentStringModel::stopped
};

/// Writes one note for each string that `events`, those of a block in the order of their frames, will
/// strike, as far as `notes` has room; returns how many. Where a chord is moved to other strings so that all
/// of its notes sound, some of its strings may be others than those written; their number is not. Nothing of
/// the state changes. Threads: one at a time per state; realtime-safe.
std::size_t expected_notes(const InstrumentModel& model, InstrumentState& state,
                           std::span<const InstrumentEvent> events,
                           std::span<ExpectedNote> notes) JAWARI_REALTIME;

}  // namespace jawari
