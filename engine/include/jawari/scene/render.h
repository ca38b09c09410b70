// Rendering: a function of (const model, state, events, block). Nothing here allocates, locks, throws or
// makes system calls.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "jawari/scene/reading.h"

namespace jawari {

/// One contact step of one string with all its contacts: free prediction, gaps, candidates, impulses, update.
/// May be mixed with the functions below: the first step after a frame computes all gaps from the modes.
void step(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// One output frame of one string: model.steps_per_frame contact steps, or what state.skipping allows instead
/// of them, then the check for non-finite state. Bounded work: at most model.steps_per_frame steps with all
/// contacts, and one flight.
void advance_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// `frames` output frames of one string like advance_frame(), read on the way: the same bits, but frames of
/// free flight are crossed together. Asleep, it reads 0.
void advance_frames(const StringModel& model, StringState& state, std::span<const Reading> readings,
                    ReadAt when, std::size_t frames) JAWARI_REALTIME;

/// Value of one probe at the state's time. `frame_s`: the output interval, over which contact force is
/// averaged.
double probe_value(const StringModel& model, const StringState& state, std::size_t probe,
                   double frame_s) JAWARI_REALTIME;

/// Renders `frames` output frames: row n of the block holds the probes at t = (state.frame + n)/output_rate,
/// then the state advances one frame. outputs[p] points to room for `frames` values of probe p, p <
/// model.probe_count, strings in order. The numbers do not depend on how frames are grouped into blocks.
void render(const SceneModel& model, SceneState& state, std::span<double* const> outputs,
            std::size_t frames) JAWARI_REALTIME;

/// Starts moving contact `contact` (model index) to `height_m` linearly over `steps` contact steps (at least
/// 1).
void move_contact(const StringModel& model, StringState& state, std::size_t contact, double height_m,
                  std::size_t steps) JAWARI_REALTIME;

}  // namespace jawari
