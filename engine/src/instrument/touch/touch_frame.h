// What a frame under touches consists of: the touches move on, their places are followed in free flight, and
// what the forces do is noted.
#pragma once

#include <array>

#include "instrument/touch/touch_forces.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/realtime.h"

namespace jawari {

/// Moves the touches on by a frame; those that are left, and the exciter.
ActiveForces move_touches(TouchState& touches) JAWARI_REALTIME;

/// The touch begins to leave.
void leave(Touch& touch) JAWARI_REALTIME;

/// Moves the touches that sweep. Returns whether one of them was moved.
bool sweep_touches(const StringModel& model, TouchState& touches, const ActiveForces& active) JAWARI_REALTIME;

/// Whether a touch is about to be moved.
bool will_sweep(const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME;

/// Where the touch has lain since its row was written last.
double place_of(const StringModel& model, const Touch& touch) JAWARI_REALTIME;

/// TouchedPoint::noise_N of the coming frame; noises swell and end as half a sine.
void make_noises(const StringModel& model, TouchState& touches, const ActiveForces& active) JAWARI_REALTIME;

/// w = phi (q - h v/2) under each force at the frame's start, and its change over the frame in free flight.
kernels::TouchedRows free_paths(const StringModel& model, const StringState& string,
                                const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME;

/// The same in one sweep over the modes that move, in the order of kernels::fly_touched().
kernels::TouchedRows paths_of_all(const StringModel& model, const StringState& string,
                                  const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME;

/// How far the place of the a-th force moves over a frame in which no contact acts.
double path_under(const TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                  const std::array<double, most_forces>& force_N, std::size_t a) JAWARI_REALTIME;

/// What the frame's forces are, and how far their points go if no contact acts.
void note_paths(TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                const std::array<double, most_forces>& force_N) JAWARI_REALTIME;

/// The string's excitation for the coming frame.
void hold(const StringModel& model, StringState& string, const ActiveForces& active,
          const kernels::TouchedRows& paths, const HeldForces& held) JAWARI_REALTIME;

/// What the forces of a frame without contacts do, as meter_touches() has it.
void meter_flight(const TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                  const std::array<double, most_forces>& force_N, PlayerWork& work) JAWARI_REALTIME;

}  // namespace jawari
