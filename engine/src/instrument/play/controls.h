// Slow controls: bends, vibrato, slides, palm and gains, looked at every control_frames frames.
#pragma once

#include <cstdint>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

inline constexpr std::uint64_t control_frames = 32;
/// Gains and bends follow their controls with this time constant [s].
inline constexpr double gain_follow_s = 0.003;
inline constexpr double bend_follow_s = 0.004;

/// Once every control_frames frames.
void follow_controls(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
