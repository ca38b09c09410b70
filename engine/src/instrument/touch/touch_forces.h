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

/// All touches and the exciter, which is last.
inline constexpr std::size_t most_forces = touch_slots + 1;
inline constexpr std::size_t exciter_index = touch_slots;

// Of the arrays in the structures below only the first entries, one per force that acts, are ever set or
// read: this runs for every voice in every frame, and clearing them takes a tenth of its time.

/// The touches and, if it acts, the exciter.
struct ActiveForces {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<std::size_t, most_forces> index;
    std::size_t count = 0;
    std::size_t touches = 0;        ///< those in front
    std::size_t touched_modes = 0;  ///< that any of them reaches
    bool sprung = false;            ///< one of them has a spring
    bool noisy = false;             ///< one of them makes a noise
};

inline bool excites(const ActiveForces& active) {
    return active.count > active.touches;
}

/// Modes that the forces reach.
inline std::size_t reach_of(const StringModel& model, const ActiveForces& active) {
    return excites(active) ? model.shape->stride : active.touched_modes;
}

inline const AlignedVector<double>& row_of(const TouchState& touches, std::size_t i) {
    return i == exciter_index ? touches.exciter.row : touches.touches[i].row;
}

/// Output frame [s].
inline double frame_s(const StringModel& model) {
    return model.shape->step_s * static_cast<double>(model.shape->steps_per_frame);
}

/// TouchState::compliance of the active forces, which is then no longer outdated.
void set_compliance_of_touches(const StringModel& model, TouchState& touches,
                               const ActiveForces& active) JAWARI_REALTIME;

/// What acts over the coming frame.
struct HeldForces {  // NOLINT(cppcoreguidelines-pro-type-member-init): the first `count` are set
    std::array<double, most_forces> force_N;
    bool any = false;      ///< one of them is not 0
    bool passive = false;  ///< as hold_forces() has it
};

/// The forces of all touches and the exciter, which moves on.
HeldForces solve_forces(const StringModel& model, TouchState& touches, const ActiveForces& active,
                        const kernels::TouchedRows& paths) JAWARI_REALTIME;

}  // namespace jawari
