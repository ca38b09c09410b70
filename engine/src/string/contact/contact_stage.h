// The contact stage of a time step, in gap coordinates.
#pragma once

#include <cstddef>

#include "base/assert.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "string/state/excitation.h"

namespace jawari {

/// Depth [m] that rounding and the residual of the last solve explain: ContactMoment::excused.
inline double excused_depth(const StringModel& model, const ContactState& contact) {
    return model.shape->gap_rounding_m + contact.left_open;
}

/// Contact `c` joins the near contacts. Precondition: it is not one of them.
inline void make_near(ContactState& contact, std::size_t c) noexcept {
    JAWARI_ASSERT(contact.is_near[c] == 0);
    contact.near.push(c);
    contact.is_near[c] = 1;
}

/// gap <- S q - b and gap_before <- the same one step earlier, for the near contacts.
void place_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Contact `c` becomes near in the middle of a step: its gap, gap_before and gap_free are computed. velocity
/// holds v_free, velocity_before the step's v.
void join_step(const StringModel& model, StringState& state, std::size_t c) JAWARI_REALTIME;

/// Moves the moving obstacles by one step.
void move_obstacles(ContactState& contact) JAWARI_REALTIME;

/// gap_rate <- S v of the step's start at the near contacts; needed by the theta scheme only.
void note_approach(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// gap_free <- the gaps at the step's end without impulses; state.velocity holds v_free.
void predict_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Fills candidates and offset = y_free - tau by the impact law; compliant contacts are candidates too.
/// Returns true if one is violated or presses (so that lambda > 0 somewhere).
bool select_candidates(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// impulse <- solution of the step's complementarity problem; a truncated solution is scaled until it is
/// passive.
void solve_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Scales a truncated solution by clamp(-lambda'(y_free - y_before)/(lambda' A lambda), 0, 1): impacts then
/// do no work > 0.
void make_passive(const StringModel& model, ContactState& contact) JAWARI_REALTIME;

/// impulse <- 0 at all near contacts.
void clear_impulses(StringState& state) JAWARI_REALTIME;

/// velocity += (w/mu) S^T lambda.
void apply_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// gap_before <- gap, gap <- y_free + A lambda; accumulates frame impulses and penetration.
void accept_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
