// The body under a bridge that moves: its modes over an output frame, and a state at rest.
#pragma once

#include <cstddef>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Empty unless the instrument's bridge moves.
BridgeModel bridge_model(const InstrumentDescription& instrument, double output_rate_hz);

/// At rest, with room for `voices` voices of `strings` strings.
BridgeState make_bridge_state(const BridgeModel& bridge, std::size_t strings, std::size_t voices);

/// At rest, and nothing has been counted.
void reset_bridge(BridgeState& state) JAWARI_REALTIME;

/// At rest.
void silence_bridge(BridgeState& state) JAWARI_REALTIME;

/// Energy of the body's modes [J].
double body_energy(const BridgeModel& bridge, const BridgeState& state) JAWARI_REALTIME;

/// kappa of a string's end, sum_k b_k^2/(mu omega_k^2) + T/L, at the string's tension. `growth`: of the
/// tension since it was compiled.
double end_stiffness(const StringModel& model, const double* end_row, double tension_N,
                     double growth) JAWARI_REALTIME;

/// StoppedStringModel::end_root and end_strength.
void set_end_bounds(StoppedStringModel& stopped);

inline bool bridge_moves(const InstrumentModel& model) {
    return model.bridge.count > 0;
}

}  // namespace jawari
