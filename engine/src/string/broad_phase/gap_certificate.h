// Which contacts can close within a frame: lower bounds of gaps that cost less than the gaps (proof:
// docs/engine/certificate.md).
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Frames from now on, at least that many, in which no contact can close and no bound is needed anew.
/// state.certificate.free_frames receives them, and the odometers move on by them at once. Bounds must be
/// fresh.
void plan_free_frames(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Chooses the contacts that may close in the coming frame as state.contact.near. displacement_flown holds
/// the frame's end in free flight. Returns true if there are any.
bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Moves the odometers on by one frame.
void advance_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// After a frame with impulses, its bounds already advanced: what stepping found replaces what free flight
/// predicted.
void note_stepped_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Nothing is known of any gap.
void forget_bounds(StringState& state) JAWARI_REALTIME;

/// All contacts are near.
void choose_all_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
