// The ways in which an output frame is crossed, and which of them the next frame takes.
#pragma once

#include <optional>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

enum class FrameKind {
    Asleep,              ///< the string is at rest: nothing is computed
    Planned,             ///< free flight, certified together with the frames that follow
    Checked,             ///< free flight, or free stepping, of a frame that was tested by itself
    NearInContactSpace,  ///< contacts that may close are solved by their response table
    NearStepped,         ///< contacts that may close are solved step by step over all modes
    Short,               ///< all contacts are solved side by side, which few steps and contacts make cheap
    Uniform              ///< all contacts are solved step by step over all modes; nothing is skipped
};

/// What the broad phase has said about the coming frame.
enum class BroadPhaseAnswer {
    NotAsked,
    Planned,     ///< no contact can close within planned_frames() frames
    PlanFailed,  ///< no frames could be planned; the coming one has not been tested by itself
    Open,        ///< no contact can close in the coming frame
    MayClose     ///< the contacts in ContactState::near may close in the coming frame
};

/// True if the string sleeps and nothing is about to wake it.
bool sleeps_on(const StringState& state) JAWARI_REALTIME;

/// Whether frames with contacts that may close leave out all other contacts.
inline bool evaluates_near_alone(const StringState& state) noexcept {
    return state.skipping.near;
}

/// Whether frames with contact are solved as short ones.
bool solves_short_frames(const StringModel& model, const StringState& state) JAWARI_REALTIME;

/// Whether every contact must be evaluated at every step: for the scheme, the metering, the options, or
/// because obstacles move.
bool steps_uniformly(const StringModel& model, const StringState& state) JAWARI_REALTIME;

/// The kind of the coming frame, or nothing if it depends on a test of the frame (BroadPhaseAnswer::Open or
/// MayClose). The first row that applies decides:
///
/// | the string                                          | the broad phase says | kind               |
/// |-----------------------------------------------------|----------------------|--------------------|
/// | sleeps, without a force or a moving obstacle        |                      | Asleep             |
/// | must be stepped uniformly                           |                      | Uniform            |
/// | any                                                 | Planned              | Planned            |
/// | any                                                 | Open                 | Checked            |
/// | short frames, had impulses in the last frame        |                      | Short              |
/// | short frames, a force acts and backs off from tests |                      | Short              |
/// | short frames                                        | PlanFailed, MayClose | Short              |
/// | a response table, near frames allowed, the last one |                      |                    |
/// | not crowded with impulses (NearState::crowded)      | MayClose             | NearInContactSpace |
/// | any                                                 | MayClose             | NearStepped        |
/// | any                                                 | NotAsked, PlanFailed | (test the frame)   |
std::optional<FrameKind> choose_frame_kind(const StringModel& model, const StringState& state,
                                           BroadPhaseAnswer answer) JAWARI_REALTIME;

}  // namespace jawari
