#include "string/state/excitation.h"

#include <cmath>

#include "base/assert.h"

namespace jawari {

void hold_forces(StringState& state, const PointForces& forces, std::size_t shared, std::size_t modes,
                 bool passive) JAWARI_REALTIME {
    JAWARI_ASSERT(shared <= modes && modes <= state.displacement.size());
    JAWARI_ASSERT(forces.count > 0 || shared == modes);
    ExcitationState& excitation = state.excitation;
    AlignedVector<double>& held = excitation.held;
    if (excitation.modes > modes) {
        std::fill(held.begin() + static_cast<std::ptrdiff_t>(modes),
                  held.begin() + static_cast<std::ptrdiff_t>(excitation.modes), 0.0);
    }
    if (excitation.ramps) std::fill_n(excitation.ramp.begin(), excitation.modes, 0.0);
    kernels::sum_rows(shared, forces.count, forces.force_N, forces.rows, held.data());
    if (modes > shared) {
        const double* beyond = forces.rows[forces.count - 1] + shared;
        kernels::sum_rows(modes - shared, 1, forces.force_N + forces.count - 1, &beyond,
                          held.data() + shared);
    }
    excitation.active = false;
    excitation.strength_N = 0;
    for (std::size_t i = 0; i < forces.count; ++i) {
        excitation.active = excitation.active || forces.force_N[i] != 0;
        excitation.strength_N += std::abs(forces.force_N[i]);
    }
    excitation.passive = passive;
    excitation.root = -1;
    excitation.ramps = false;
    excitation.elapsed = 0;
    excitation.modes = excitation.active ? modes : 0;
}

}  // namespace jawari
