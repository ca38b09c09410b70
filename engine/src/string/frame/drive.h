// Forces and movements from outside, frame by frame.
#pragma once

#include <cstdint>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Sets the forces of the coming frame and starts what moves in it. Once or more often before a frame.
void drive_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Frames from the coming one on in which nothing is driven.
std::uint64_t undriven_frames(const StringModel& model, const StringState& state) JAWARI_REALTIME;

}  // namespace jawari
