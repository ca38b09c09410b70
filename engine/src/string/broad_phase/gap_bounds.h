// Bounds of how fast and how far modes and gaps can move from the present state on. The broad phase
// (gap_certificate.h) certifies gaps with them (docs/engine/certificate.md, sections 1, 2 and 4).
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/index_range.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "string/contact/compliant_contacts.h"
#include "string/contact/contact_stage.h"
#include "string/contact/impact_law.h"

namespace jawari {

/// Bounds are widened by this share, far above the rounding of the sums that make them.
inline constexpr double bound_safety = 1 + 1e-9;

/// Length of an output frame [s].
inline double frame_length(const StringModel& model) {
    return model.shape->step_s * static_cast<double>(model.shape->steps_per_frame);
}

/// How far ahead of a frame's end, or back before its start, the law looks for candidates [s]: a gap that is
/// further from closing than its rate covers in that time is none (docs/engine/certificate.md, section 3).
inline double lookahead(const StringModel& model) {
    // A compliant contact's force spans the two steps around its own.
    if (looks_back(model.shape->law) || has_compliant_contacts(model)) return model.shape->step_s;
    return looks_ahead(model.shape->law) ? model.shape->step_s / 2 : 0.0;
}

/// The share of the way to the nearest contact that passive forces may bend a clear string by within a frame.
inline constexpr double share_of_forces = 0.1;

/// Up to this many contacts each has bounds of its own; more share them in groups of neighbours.
inline constexpr std::size_t contacts_with_own_bounds = 64;

/// Modes that the forecast advances into the future.
inline constexpr std::size_t forecast_modes = 64;

/// Frames that are planned at a time.
inline constexpr std::uint64_t longest_plan = 16;

inline std::size_t low_modes(const StringModel& model) {
    return std::min(forecast_modes, model.shape->stride);
}

inline std::size_t group_of(const StringModel& model, std::size_t contact) {
    const std::size_t size = model.shape->certificate.group_begin[1];
    return size == 1 ? contact : contact / size;  // a division for each contact of a fretboard would be felt
}

inline std::size_t group_count(const StringModel& model) {
    return model.shape->certificate.group_begin.size() - 1;
}

/// The contacts of a group.
inline IndexRange contacts_of(const StringModel& model, std::size_t group) {
    return {model.shape->certificate.group_begin[group], model.shape->certificate.group_begin[group + 1]};
}

/// Bound of the rate of a group's gaps over the coming frame [m/s].
inline double gap_speed(const StringState& state, std::size_t g) {
    return state.certificate.bounds.group_speed[g] + state.certificate.bounds.kicks.speed;
}

/// Coming frames in which no contact can close; the odometers already include them.
inline std::uint64_t planned_frames(const StringState& state) {
    const std::uint64_t held_at = state.certificate.validity.odometers_at_frame;
    return held_at > state.frame ? held_at - state.frame : 0;
}

/// True if the bounds must be computed anew before the coming frame.
bool needs_refresh(const StringState& state) JAWARI_REALTIME;

/// Frames for which the bounds stay as they are if the string flies.
std::uint64_t frames_until_refresh(const StringState& state) JAWARI_REALTIME;

/// Computes the bounds of modes and the groups' speeds from the present state; lets weak modes leave the sums
/// and a faded string fall asleep.
void refresh_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// The first `modes` (padded) modes, which forces reach, join the sums; until then they are at rest.
void wake_modes(StringState& state, std::size_t modes) JAWARI_REALTIME;

/// Adds what the excitation of the coming frame does to the bounds.
void add_kicks(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// group_clearance of the groups listed, where it is not known since the last refresh.
void complete_clearances(const StringModel& model, StringState& state,
                         const IndexList& groups) JAWARI_REALTIME;

/// group_detour of the groups listed, where it is not known since the last refresh.
void complete_detours(const StringModel& model, StringState& state, const IndexList& groups) JAWARI_REALTIME;

}  // namespace jawari
