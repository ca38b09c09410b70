// One output frame, or many that are flown together.
#pragma once

#include <cstddef>
#include <span>

#include "base/assert.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "jawari/scene/render.h"
#include "string/frame/frame_kind.h"
#include "string/kernels/touched_flight.h"

namespace jawari {

/// Counts frames that cost nothing. Precondition: sleeps_on(state).
inline void pass_asleep(const StringModel& model, StringState& state, std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(sleeps_on(state));
    state.counters.asleep_frames += frames;
    state.counters.steps += frames * model.shape->steps_per_frame;
    state.frame += frames;
}

/// Asks the broad phase for frames that can be flown together, where that makes sense: Planned, PlanFailed or
/// NotAsked. May put a faded string to sleep. What is about to act on the string besides may bring it nearer
/// to its obstacles by reserve_m [m].
BroadPhaseAnswer plan_frames(const StringModel& model, StringState& state,
                             double reserve_m = 0) JAWARI_REALTIME;

/// Crosses `frames` frames in free flight; the readings go to out[first], ... Precondition: plan_frames() has
/// just answered Planned, and 1 <= frames <= planned_frames(state).
void fly_ahead(const StringModel& model, StringState& state, std::span<const Reading> readings, ReadAt when,
               std::size_t first, std::size_t frames) JAWARI_REALTIME;

/// Whether nothing can strike the string and its frames may be flown: what cross_touched_frame() needs.
bool flies_always(const StringModel& model, const StringState& state) JAWARI_REALTIME;

/// What forces that are no hands may do in a frame.
struct FrameBounds {
    double strength_N = 0;  ///< point forces that would bend the string as far within the frame [N]
    double root = -1;  ///< by how much they raise the root of its energy at most [J^(1/2)]; below 0: unknown
};

/// Whether the string cannot reach an obstacle in the coming frame under forces with these bounds, whatever
/// they are. It has no excitation. Then cross_touched_frame() may follow.
bool flies_clear(const StringModel& model, StringState& state, double strength_N,
                 double root) JAWARI_REALTIME;

/// One frame of such a string under the forces of `flight`, of which the caller sets `count`, `row`,
/// `force_N`, `read_row` and `looks_ahead`; not all of them are 0. They act on the first `modes` (padded)
/// modes. `passive`: as hold_forces() has it. The string must have no other excitation, and has none
/// afterwards.
void cross_touched_frame(const StringModel& model, StringState& state, kernels::TouchedFlight& flight,
                         std::size_t modes, bool passive, const FrameBounds& bounds = {}) JAWARI_REALTIME;

/// Crosses one frame. `answer`: what plan_frames() has just said.
void cross_frame(const StringModel& model, StringState& state, BroadPhaseAnswer answer) JAWARI_REALTIME;

}  // namespace jawari
