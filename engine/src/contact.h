// The contact stage of a time step, in gap coordinates.
#pragma once

#include <cstddef>

#include "jawari/model.h"
#include "jawari/realtime.h"
#include "jawari/state.h"

namespace jawari {

/// gap <- S q - b, free of the rounding that steps add up.
void refresh_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Moves the obstacles that are on their way by one step.
void move_obstacles(ContactState& contact) JAWARI_REALTIME;

/// gap_rate <- S v at the step's start; needed by the theta scheme only.
void note_approach(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// gap_free <- the gaps at the step's end without impulses; state.velocity holds v_free.
void predict_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Fills candidates and offset = y_free - tau by the impact law. Returns true if one is violated (so that lambda > 0 somewhere).
bool select_candidates(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// impulse <- solution of the step's complementarity problem; a truncated solution is scaled until it is passive.
void solve_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// impulse <- 0 where the step needs none.
void clear_impulses(StringState& state) JAWARI_REALTIME;

/// velocity += (w/mu) S^T lambda.
void apply_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// gap_before <- gap, gap <- y_free + A lambda; accumulates frame impulses and penetration.
void accept_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
