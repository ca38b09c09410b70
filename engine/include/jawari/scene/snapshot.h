// The state of a scene as bytes that outlive the process, and back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/result.h"

namespace jawari {

/// What a restored state is.
enum class Restored {
    Exactly,   ///< the model is that of the saved state: rendering goes on with the same bits
    Converted  ///< another rate or other settings: displacements, true velocities, heights, time and meters
};

/// Everything that rendering goes on from, between frames. Little-endian; the format belongs to this version
/// of the library. `state` must have been made for `model`. Threads: any that nothing else renders `state`
/// in. Allocates.
std::vector<std::uint8_t> save(const SceneModel& model, const SceneState& state);

/// The opposite: `state` is one of `model` (make_state()) and gets the saved one, with its own metering and
/// skipping. A state of another model is converted if that has the same modes, hammers and described contacts
/// in each string; the time becomes the nearest output frame. Fails on other bytes, and leaves the state as
/// it was. Threads: one at a time per state. Allocates.
Result<Restored> restore(const SceneModel& model, std::span<const std::uint8_t> bytes, SceneState& state);

}  // namespace jawari
