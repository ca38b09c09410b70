// Rendering a scene: a function of (const model, state, block).
#pragma once

#include <cstddef>
#include <span>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "jawari/scene/reading.h"

namespace jawari {

/// Advances one string by one contact step with all its contacts: free prediction, gaps, candidates,
/// impulses, update. May be mixed with the functions below: the first step after a frame computes all gaps
/// from the modes. Threads: one at a time per state; realtime-safe.
void step(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Advances one string by one output frame: model.steps_per_frame contact steps, or what state.skipping
/// allows instead of them, then the check for non-finite state. Bounded work: at most model.steps_per_frame
/// steps with all contacts, and one flight. Threads: one at a time per state; realtime-safe.
void advance_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Advances one string by `frames` output frames and takes readings on the way. The bits are those of
/// advance_frame() called `frames` times, but frames of free flight are crossed together. A string that is
/// asleep reads 0. Threads: one at a time per state; realtime-safe.
void advance_frames(const StringModel& model, StringState& state, std::span<const Reading> readings,
                    ReadAt when, std::size_t frames) JAWARI_REALTIME;

/// Value of one probe at the state's time, in the unit of its Quantity. `probe`: index into model.probes;
/// `frame_s`: the output interval, over which contact force is averaged [s], above 0. Threads: one at a time
/// per state; realtime-safe.
double probe_value(const StringModel& model, const StringState& state, std::size_t probe,
                   double frame_s) JAWARI_REALTIME;

/// Renders `frames` output frames. Row n of the block holds the probes at t = (state.frame + n)/output_rate;
/// then the state advances by one frame. outputs[p] points to room for `frames` values of probe p, p <
/// model.probe_count, strings in order. The values do not depend on how frames are grouped into blocks.
/// Threads: one at a time per state; realtime-safe.
void render(const SceneModel& model, SceneState& state, std::span<double* const> outputs,
            std::size_t frames) JAWARI_REALTIME;

/// Starts moving a contact linearly to a new height. `contact`: index into StringDescription::contacts; a
/// contact that compile() dropped does not move. `height_m`: the height at the end, from the rest line [m];
/// any finite value. `steps`: contact steps of the movement; 0 counts as 1. Threads: one at a time per state;
/// realtime-safe.
void move_contact(const StringModel& model, StringState& state, std::size_t contact, double height_m,
                  std::size_t steps) JAWARI_REALTIME;

}  // namespace jawari
