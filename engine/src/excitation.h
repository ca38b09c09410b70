// Forces on a string that are held over a frame or linear within it, added up over points and widths.
#pragma once

#include <algorithm>
#include <cstddef>

#include "jawari/model.h"
#include "jawari/realtime.h"
#include "jawari/state.h"

namespace jawari {

inline bool is_excited(const StringState& state) {
    return state.excitation.active;
}

/// No force from now on. Nothing is written while there is none.
inline void clear_excitation(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ExcitationState& excitation = state.excitation;
    if (excitation.active) std::fill_n(excitation.held.begin(), model.stride, 0.0);
    if (excitation.ramps) std::fill_n(excitation.ramp.begin(), model.stride, 0.0);
    excitation.active = false;
    excitation.ramps = false;
    excitation.elapsed = 0;
}

/// Adds force_N + rate_N n at step n from now on `row`, phi_k of the point [m^(-1/2)]. Forces that already
/// ramp must have been set at the same time.
inline void add_force(const StringModel& model, StringState& state, const double* row, double force_N,
                      double rate_N) JAWARI_REALTIME {
    ExcitationState& excitation = state.excitation;
    excitation.active = true;
    for (std::size_t k = 0; k < model.stride; ++k) excitation.held[k] += force_N * row[k];
    if (rate_N == 0) return;
    excitation.ramps = true;
    for (std::size_t k = 0; k < model.stride; ++k) excitation.ramp[k] += rate_N * row[k];
}

}  // namespace jawari
