// What touches and the exciter exert over a frame, solved together from the free flight of their places:
//     F_i = -(c/T + k/2) (rise_i + sum_j G_ij F_j) - k (w_i - rest_i) + N_i
#pragma once

#include <array>
#include <cstddef>

#include "instrument/touch/touch_kernels.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/touches.h"
#include "jawari/realtime.h"

namespace jawari {

/// All touches, the exciter, and the bridge if it moves.
inline constexpr std::size_t most_forces = voice_forces;
inline constexpr std::size_t exciter_index = touch_slots;
inline constexpr std::size_t bridge_index = touch_slots + 1;

inline bool excites(const ActiveForces& active) {
    return active.excited;
}

/// Modes that the forces reach.
inline std::size_t reach_of(const StringModel& model, const ActiveForces& active) {
    return excites(active) || active.bridge != nullptr ? model.shape->stride : active.touched_modes;
}

/// Of the a-th active force.
inline const double* row_of(const TouchState& touches, const ActiveForces& active, std::size_t a) {
    const std::size_t i = active.index[a];
    if (i == bridge_index) return active.bridge;
    return i == exciter_index ? touches.exciter.row.data() : touches.touches[i].row.data();
}

/// Output frame [s].
inline double frame_s(const StringModel& model) {
    return model.shape->step_s * static_cast<double>(model.shape->steps_per_frame);
}

/// TouchState::compliance of the active forces, which is then no longer outdated.
void set_compliance_of_touches(const StringModel& model, TouchState& touches,
                               const ActiveForces& active) JAWARI_REALTIME;

/// With exciter and bridge.
TouchAnswer answer_to_bridge(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                             const kernels::TouchedRows& paths) JAWARI_REALTIME;

/// What acts over the coming frame.
struct HeldForces {  // NOLINT(cppcoreguidelines-pro-type-member-init): one force per force that acts is set
    std::array<double, most_forces> force_N;
    bool any = false;      ///< one of them is not 0
    bool passive = false;  ///< as hold_forces() has it
};

/// The forces of all touches and the exciter, which moves on.
HeldForces solve_forces(const StringModel& model, TouchState& touches, const ActiveForces& active,
                        const kernels::TouchedRows& paths) JAWARI_REALTIME;

}  // namespace jawari
