// One output frame of a bridge that moves: its mean displacement, solved together with what all voices on it
// answer, and the body's motion (docs/engine/model.md, "The moving bridge").
#pragma once

#include <cstddef>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// BridgeState::mean <- the mean of free motion, without strings.
void begin_bridge_frame(const BridgeModel& bridge, BridgeState& state) JAWARI_REALTIME;

/// Sets `mean`, and zeta_m and the exciters' forces of all voices of the frame, from what they answer.
void solve_bridge_frame(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME;

/// Moves the body by the frame, and gives it what contacts have changed (VoiceOnBridge::left_N).
void end_bridge_frame(const BridgeModel& bridge, BridgeState& state) JAWARI_REALTIME;

/// Moves what string s alone has done to the body by the frame, for outputs of strings; before
/// end_bridge_frame().
void advance_body_of_string(const BridgeModel& bridge, BridgeState& state, std::size_t s) JAWARI_REALTIME;

/// Energy of the coupling: -weight z X + weight^2 kappa z^2/2 of each voice of the frame, z the bridge at its
/// start [J].
double coupling_energy(double weight, double bridge_m, double force_N,
                       double stiffness_N_per_m) JAWARI_REALTIME;

/// Where the bridge is under string s [m].
double bridge_under(const BridgeModel& bridge, const BridgeState& state, std::size_t s) JAWARI_REALTIME;

}  // namespace jawari
