// Frames of a string that sleeps.
#pragma once

#include <cstddef>

#include "contact.h"
#include "jawari/model.h"
#include "jawari/realtime.h"
#include "jawari/state.h"

namespace jawari {

/// True if the string sleeps and nothing is about to wake it.
inline bool sleeps_on(const StringState& state) {
    return state.asleep && !is_excited(state) && state.contact.moving_count == 0;
}

/// Counts frames that cost nothing. Precondition: sleeps_on(state).
inline void pass_asleep(const StringModel& model, StringState& state, std::size_t frames) JAWARI_REALTIME {
    state.counters.asleep_frames += frames;
    state.counters.steps += frames * model.steps_per_frame;
    state.frame += frames;
}

}  // namespace jawari
