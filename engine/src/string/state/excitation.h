// Forces on a string that are held over a frame or linear within it, added up over points and widths.
#pragma once

#include <algorithm>
#include <cstddef>

#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "string/kernels/mode_sums.h"

namespace jawari {

inline bool is_excited(const StringState& state) {
    return state.excitation.active;
}

/// Removes all forces. Writes nothing if there is none.
inline void clear_excitation(StringState& state) JAWARI_REALTIME {
    ExcitationState& excitation = state.excitation;
    if (excitation.active) std::fill_n(excitation.held.begin(), excitation.modes, 0.0);
    if (excitation.ramps) std::fill_n(excitation.ramp.begin(), excitation.modes, 0.0);
    excitation.active = false;
    excitation.ramps = false;
    excitation.passive = false;
    excitation.elapsed = 0;
    excitation.modes = 0;
}

/// `count` forces [N], each with the row phi_k of its point [m^(-1/2)].
struct PointForces {
    std::size_t count = 0;
    const double* force_N = nullptr;
    const double* const* rows = nullptr;
};

/// Replaces the excitation by these constant forces for the next frame. All forces act on modes [0, shared);
/// only the last force also acts on [shared, modes). Both numbers are padded. `passive`: together the forces
/// take energy from the string over every frame in which no contact acts.
void hold_forces(StringState& state, const PointForces& forces, std::size_t shared, std::size_t modes,
                 bool passive) JAWARI_REALTIME;

/// Adds force_N + rate_N n at step n from now on `row`, phi_k of the point [m^(-1/2)], to the first `modes`
/// (padded) modes. Forces that already ramp must have been set at the same time.
inline void add_force(StringState& state, const double* row, std::size_t modes, double force_N,
                      double rate_N = 0) JAWARI_REALTIME {
    ExcitationState& excitation = state.excitation;
    excitation.active = true;
    excitation.passive = false;
    excitation.modes = std::max(excitation.modes, modes);
    kernels::add_scaled(modes, force_N, row, excitation.held.data());
    if (rate_N == 0) return;
    excitation.ramps = true;
    kernels::add_scaled(modes, rate_N, row, excitation.ramp.data());
}

}  // namespace jawari
