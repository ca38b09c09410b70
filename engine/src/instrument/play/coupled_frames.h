// Output frames of an instrument whose bridge moves: strings and body meet in each of them.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Outputs of strings, and where in them the frames begin.
struct StringOutputs {
    std::span<double* const> strings;
    std::size_t first = 0;
};

/// Outputs of the instrument; the samples are 0 before.
struct StereoRun {
    std::size_t frames = 0;
    double* left = nullptr;
    double* right = nullptr;
    double* bridge_N = nullptr;  ///< force that the modes that listen hear [N]
};

/// The factor of the body's sound follows volume, expression and body mix of the last note's channel.
void follow_level(InstrumentState& state, double smoothing) JAWARI_REALTIME;

/// Adds to each string's output what of the body's motion it has caused, in the mean of both channels, at
/// frame n.
void hear_strings(const BridgeModel& bridge, const BridgeState& state, const StringOutputs& outputs,
                  std::size_t n) JAWARI_REALTIME;

/// Advances by run.frames frames. The numbers do not depend on how frames are divided into runs.
void advance_coupled(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                     double smoothing, const StereoRun& run) JAWARI_REALTIME;

}  // namespace jawari
