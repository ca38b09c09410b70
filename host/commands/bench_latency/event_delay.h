// How many frames pass from an event to the first sample that it changes.
#pragma once

#include <cstddef>
#include <optional>

#include "instrument/instrument_cache.h"

namespace jawari::host {

struct EventDelay {
    /// Largest found, beyond the event's own offset in its block; nothing if some event changed no sample.
    std::optional<std::size_t> at_rest;   ///< a note on an instrument that is silent
    std::optional<std::size_t> sounding;  ///< a note while another sounds
    std::size_t events = 0;               ///< tried
};

/// Compares performances with and without the event, at several offsets in a block, for keys all over the
/// compass.
EventDelay measure_event_delay(const SharedInstrument& instrument, double rate_hz);

}  // namespace jawari::host
