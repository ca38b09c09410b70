// Frames that cost little: those of a string that sleeps, and those it flies through.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "jawari/scene/render.h"
#include "string/contact/contact_stage.h"

namespace jawari {

/// True if the string sleeps and nothing is about to wake it.
inline bool sleeps_on(const StringState& state) {
    return state.asleep && !is_excited(state) && state.contact.moving_count == 0;
}

/// Counts frames that cost nothing. Precondition: sleeps_on(state).
inline void pass_asleep(const StringModel& model, StringState& state, std::size_t frames) JAWARI_REALTIME {
    state.counters.asleep_frames += frames;
    state.counters.steps += frames * model.shape->steps_per_frame;
    state.frame += frames;
}

/// Frames from now on in which the string flies and no contact can close; 0 if the coming one must be looked
/// at. May put a faded string to sleep (and returns 0).
std::size_t frames_to_fly(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Crosses `frames` <= frames_to_fly() frames; the readings go to out[first], ...
void fly_ahead(const StringModel& model, StringState& state, std::span<const Reading> readings, ReadAt when,
               std::size_t first, std::size_t frames) JAWARI_REALTIME;

/// Crosses one frame that cannot be flown: frames_to_fly() has just returned 0.
void look_at_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
