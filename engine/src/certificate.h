// Which contacts can close within a frame: lower bounds of gaps that cost less than the gaps (proof:
// docs/certificate.md).
#pragma once

#include "jawari/model.h"
#include "jawari/realtime.h"
#include "jawari/state.h"

namespace jawari {

/// True if the bounds must be computed anew before the coming frame.
bool needs_refresh(const StringState& state) JAWARI_REALTIME;

/// Computes all bounds from the present state; lets weak modes leave the sums and a faded string fall asleep.
void refresh_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Chooses the contacts that may close in the coming frame as state.contact.near. displacement_flown holds
/// the frame's end in free flight. Returns true if there are any.
bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// True if the impulses just found may reach contacts that are not near; they are then near, with their gaps
/// in this step, and the step's impulses must be found again.
bool admit_pushed_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Charges the step's impulses to the margins of the other contacts, for the rest of the frame.
void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME;

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
