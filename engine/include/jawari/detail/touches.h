// What hands do to one motion of a string: plain state, see instrument_touch.h and instrument_exciter.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "jawari/detail/aligned.h"

namespace jawari {

/// Every touch has a place of its own, so that one cannot displace another.
enum class TouchSlot : std::size_t {
    Release,        ///< the damping hand
    ReleaseSecond,  ///< its second place
    Palm,           ///< palm mute
    Left,           ///< dead note, or the light touch of a harmonic
    Finger,         ///< the exciting finger before it lets go
    SoftFirst,      ///< felt or cotton that always lies on the string
    SoftSecond
};
inline constexpr std::size_t touch_slots = 7;

/// Where a force acts over the current frame. With w = phi (q - h v/2) there:
struct TouchedPoint {
    double force_N = 0;  ///< held
    double start_m = 0;  ///< w at the frame's start
    double path_m = 0;   ///< its change over the frame if no contact acts
};

/// A dashpot and a spring at a place: F = -c dw/dt - k (w - rest).
struct Touch {
    bool active = false;
    double damping_kg_per_s = 0;    ///< c in force, following `pressed`
    double pressed_kg_per_s = 0;    ///< c as asked for
    double stiffness_N_per_m = 0;   ///< k
    double share = 1;               ///< of c and k in force: comes and leaves gradually
    double share_rate = 0;          ///< its change per frame
    double rest_m = 0;              ///< w at which the spring is relaxed
    std::uint64_t frames_left = 0;  ///< then it begins to leave; 0: it stays
    // A hand covers more than a point: its place sweeps over sweep_m to either side, so that no mode has a
    // node under it for long. The force of a frame dissipates wherever the touch lies in it.
    double x_m = 0, width_m = 0, sweep_m = 0;
    std::uint64_t age = 0;      ///< frames since it was laid
    std::size_t modes = 0;      ///< that it reaches (padded); `row` counts up to here
    AlignedVector<double> row;  ///< phi_k averaged over the width [m^(-1/2)]; 0 from `modes` on
    TouchedPoint point;
};

enum class ExciterPhase { None, Finger, Hammer, Tangent };

struct ExciterState {
    ExciterPhase phase = ExciterPhase::None;
    AlignedVector<double> row;  ///< as a touch's; of a tangent integral of (1 - x/L) phi_k [m^(1/2)]
    std::uint64_t frame = 0;    ///< since it began
    std::uint64_t rise_frames = 0;
    std::uint64_t release_frames = 0;
    double peak = 0;  ///< finger: force [N]; tangent: mu times height [kg]
    // hammer
    double position_m = 0;
    double speed_m_per_s = 0;
    double mass_kg = 0;
    double stiffness = 0;  ///< K [N/m^p]
    double exponent = 0;   ///< p
    double loss_s_per_m = 0;
    bool has_touched = false;
    TouchedPoint point;
};

struct TouchState {
    std::array<Touch, touch_slots> touches;
    ExciterState exciter;
    /// G_ij = displacement at i at a frame's end per newton held at j [m/N]; the exciter is last.
    std::array<double, (touch_slots + 1) * (touch_slots + 1)> compliance{};
    bool outdated = true;         ///< compliance must be computed anew
    AlignedVector<double> moved;  ///< scratch over modes
};

/// What players have done to the strings so far [J]. Each is measured as force times the path of its point.
struct PlayerWork {
    double exciters_J = 0;
    double touches_J = 0;    ///< dashpots and springs: not above 0 but for the springs' own store, unless a
                             ///< contact acted within the frame
    double bends_J = 0;      ///< parametric work of retuning
    double transfers_J = 0;  ///< legato: energy of the motion after less that before
    double rungs_J = 0;  ///< likewise of change_rung(): of the modes that are left out, but for rounding of
                         ///< the order of the step
};

}  // namespace jawari
