// A frame solved in contact space. One run over the modes computes the free gap rates of the near contacts, a
// loop over the steps solves for their impulses, and a second run over the modes applies the impulses.
#pragma once

#include <cstdint>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// How a frame in contact space ended.
enum class NearOutcome {
    Open,    ///< without impulses
    Struck,  ///< with impulses
    Crowded  ///< not: steps of all modes are cheaper, and the state is that of the frame's start
};

/// Whether a frame of that many impulses, summed over its steps, costs more in contact space, where each of
/// them spreads over the later steps of all near contacts, than steps of all modes do.
bool is_crowded(const StringModel& model, const StringState& state, std::uint64_t impulses) JAWARI_REALTIME;

/// Solves the frame with the contacts in state.contact.near from the state at its start. displacement_flown,
/// velocity_flown hold its end in free flight and receive its end with impulses.
NearOutcome solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
