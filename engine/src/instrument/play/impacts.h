// Impulses of one frame of one voice, added up by the place at which they act.
#pragma once

#include <algorithm>
#include <cstddef>

#include "instrument/model/played_string.h"
#include "jawari/instrument/state.h"

namespace jawari {

/// After a frame of string `s` in which its voice struck something.
inline void log_impacts(const InstrumentStringModel& string, const Voice& voice, std::size_t s,
                        ImpactLog& log) {
    const StringShape& shape = *voice_model(string, voice).shape;
    float* const sums = log.sums_Ns.data() + s * impact_places;
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        const double impulse_Ns = voice.string.contact.frame_impulse[c];
        if (!(impulse_Ns > 0)) continue;
        const double from_bridge_m = std::max(0.0, shape.length_m - shape.contact_position[c]);
        const auto place = static_cast<std::size_t>(from_bridge_m * log.places_per_metre[s]);
        sums[std::min(place, impact_places - 1)] += static_cast<float>(impulse_Ns);
        log.struck[s] = 1;
    }
}

}  // namespace jawari
