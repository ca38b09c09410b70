// The broad phase: which contacts can close within a frame. It is a conservative advancement: lower bounds of
// the gaps, which cost less than the gaps, certify most contacts (proof: docs/engine/certificate.md).
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Plans the coming frames in which no contact can close and no bound is needed anew: planned_frames(), by
/// which the odometers move on at once. Precondition: nothing is planned, no force acts, the bounds are
/// fresh.
void plan_free_frames(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Makes the contacts near that may close in the coming frame, of which displacement_flown holds the end in
/// free flight. Returns true if there are any.
bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Moves the odometers on by one frame.
void advance_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// After a frame with impulses, its bounds already advanced: replaces the gaps that free flight predicted by
/// those that stepping found.
void note_stepped_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Forgets every bound and every known gap.
void forget_bounds(StringState& state) JAWARI_REALTIME;

/// Makes all contacts near, or none if the string leaves the obstacles.
void choose_all_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
