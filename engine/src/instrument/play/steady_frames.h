// Output frames of a moving bridge in which all voices on it go on in their runs, and nothing about them
// changes but their motion: the same numbers as frame by frame, with less to do in each.
#pragma once

#include <cstddef>

#include "instrument/play/coupled_frames.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Advances from frame n of the run on as far as frames are steady. BridgeState::voices are those that sound.
/// Returns how many frames that were. Pickups, string outputs but for the body's part, and bridge_N are
/// complete afterwards; the modes that listen are the caller's.
std::size_t pass_steady_frames(const InstrumentModel& model, InstrumentState& state,
                               const StringOutputs& outputs, double smoothing, std::size_t n,
                               const StereoRun& run) JAWARI_REALTIME;

}  // namespace jawari
