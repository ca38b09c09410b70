// What hands and exciters do to one voice of a string: plain state, which engine/src/instrument/touch writes.
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
/// Number of places for touches.
inline constexpr std::size_t touch_slots = 7;
/// Most forces that act on a voice together: all touches, the exciter, the moving bridge.
inline constexpr std::size_t voice_forces = touch_slots + 2;

/// Where a force acts over the current frame. With w = phi (q - h v/2) there:
struct TouchedPoint {
    double force_N = 0;  ///< held over the frame [N]
    double noise_N = 0;  ///< the part of it that is a touch's noise [N]
    double start_m = 0;  ///< w at the frame's start [m]
    double path_m = 0;   ///< change of w over the frame if no contact acts [m]
};

/// What a hand, a damper or a jack sounds like as it comes to the string: a random force that swells and
/// ends.
struct TouchNoise {
    double level_N = 0;        ///< rms in the middle [N]; 0: none
    std::uint64_t frame = 0;   ///< output frames since it began
    std::uint64_t frames = 0;  ///< output frames that it lasts
    std::uint64_t seed = 0;    ///< of its samples
};

/// A dashpot and a spring at a place, and a noise N: F = -c dw/dt - k (w - rest) + N.
struct Touch {
    bool active = false;
    double damping_kg_per_s = 0;    ///< c in force, follows pressed_kg_per_s [kg/s]
    double pressed_kg_per_s = 0;    ///< c as asked for [kg/s]
    double stiffness_N_per_m = 0;   ///< k [N/m]
    double share = 1;               ///< share of c and k in force, 0 to 1: a touch comes and leaves gradually
    double share_rate = 0;          ///< change of `share` per output frame
    double rest_m = 0;              ///< w at which the spring is relaxed [m]
    std::uint64_t frames_left = 0;  ///< output frames after which it begins to leave; 0: it stays
    double x_m = 0;                 ///< place, from the start of the speaking length [m]
    double width_m = 0;             ///< over which the force is spread [m]
    /// A hand covers more than a point: its place sweeps by this much to either side, so that no mode has a
    /// node under it for long [m]. The force of a frame dissipates wherever the touch lies in it.
    double sweep_m = 0;
    std::uint64_t age = 0;      ///< output frames since it was laid
    std::size_t modes = 0;      ///< number of modes that it reaches (padded); `row` counts up to here
    AlignedVector<double> row;  ///< phi_k averaged over the width [m^(-1/2)]; 0 from `modes` on
    TouchNoise noise;           ///< of its coming
    TouchedPoint point;
};

/// What excites the string now.
enum class ExciterPhase { None, Finger, Hammer, Tangent };

/// An exciter at work.
struct ExciterState {
    ExciterPhase phase = ExciterPhase::None;  ///< what excites the string
    /// phi_k averaged over the exciter's width [m^(-1/2)]; of a tangent integral of (1 - x/L) phi_k
    /// [m^(1/2)].
    AlignedVector<double> row;
    std::uint64_t frame = 0;           ///< output frames since it began
    std::uint64_t rise_frames = 0;     ///< finger, tangent: output frames of the rise
    std::uint64_t release_frames = 0;  ///< finger: output frames of the release
    double peak = 0;                   ///< finger: force [N]; tangent: mu times height [kg]
    double roughness = 0;              ///< finger: rms of the force's noise, as a share of the force
    std::uint64_t seed = 0;            ///< finger: of that noise
    double position_m = 0;             ///< hammer: its place z on the axis of w [m]
    double speed_m_per_s = 0;          ///< hammer: speed at the frame's start [m/s]
    double mass_kg = 0;                ///< hammer [kg]
    double stiffness = 0;              ///< hammer: K [N/m^p]
    double exponent = 0;               ///< hammer: p
    double loss_s_per_m = 0;           ///< hammer: HammerDescription::loss_s_per_m [s/m]
    bool has_touched = false;          ///< hammer: it has met the string
    TouchedPoint point;
};

namespace kernels {

/// Rows that touch a string, and what the string does under them: the first `count` of each array are set.
struct TouchedRows {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    std::array<const double*, voice_forces> row;
    std::array<double, voice_forces> middle;  ///< row (q - lag v)
    std::array<double, voice_forces> rise;    ///< its change over the frame in free flight
};

}  // namespace kernels

/// All touches and the exciter of one voice.
struct TouchState {
    std::array<Touch, touch_slots> touches;  ///< by TouchSlot
    ExciterState exciter;
    /// G_ij = displacement at i at a frame's end per newton held at j [m/N]; behind the touches the exciter,
    /// then the bridge, whose "force" is its displacement [m] and whose "displacement" a force [N].
    std::array<double, voice_forces * voice_forces> compliance{};
    bool outdated = true;         ///< compliance must be computed anew
    std::uint64_t noises = 0;     ///< that have begun: no two are alike
    AlignedVector<double> moved;  ///< scratch over modes
    kernels::TouchedRows
        known;  ///< of the coming frame on a moving bridge, but for the rows, unless `count` is 0
    std::uint64_t known_frame = 0;  ///< StringState::frame for which `known` holds
};

// Scratch of a frame. Of the arrays below only the first entries, one per force that acts, are ever set or
// read: this runs for every voice in every frame, and clearing them takes a tenth of its time.

/// The touches and, if they act, the exciter and the moving bridge, in this order.
struct ActiveForces {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<std::size_t, voice_forces> index;
    std::size_t count = 0;
    std::size_t touches = 0;         ///< those in front
    bool excited = false;            ///< the exciter acts
    const double* bridge = nullptr;  ///< row of a moving bridge, or none
    std::size_t touched_modes = 0;   ///< that any of them reaches
    bool sprung = false;             ///< one of them has a spring
    bool noisy = false;              ///< one of them makes a noise
};

/// What the touches answer to what is not known yet: force_i = alone_i + by_exciter_i F_exciter + by_bridge_i
/// zeta, zeta the bridge's mean displacement.
struct TouchAnswer {  // NOLINT(cppcoreguidelines-pro-type-member-init): as far as it was asked for
    std::array<double, touch_slots> alone;
    std::array<double, touch_slots> by_exciter;
    std::array<double, touch_slots> by_bridge;
};

/// A voice's frame on a moving bridge (docs/engine/model.md, "The moving bridge"). While the bridge is at
/// zeta in the mean of the frame, the voice pulls at it by force_N + by_exciter F_exciter - stiffness zeta in
/// the mean.
struct BridgeEndFrame {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    ActiveForces active;
    kernels::TouchedRows paths;  ///< of the active forces, the bridge last
    TouchAnswer answer;
    double start_N = 0;            ///< force at the frame's start [N]
    double force_N = 0;            ///< mean force if the bridge rests and no exciter acts [N]
    double stiffness_N_per_m = 0;  ///< by which the bridge's displacement lowers it [N/m]
    double by_exciter = 0;         ///< by which a newton of the exciter raises it [1]
    double exciter_N = 0;          ///< force of the exciter [N]
};

/// Energies that players have given to the strings since make_instrument_state() or reset() [J]. Those of
/// forces are measured as force times the path of its point.
struct PlayerWork {
    double exciters_J = 0;   ///< work of fingers, hammers and tangents [J]
    double touches_J = 0;    ///< work of dashpots and springs [J]: not above 0 but for what the springs hold,
                             ///< unless a contact acted within the frame
    double bends_J = 0;      ///< parametric work of retuning [J]
    double transfers_J = 0;  ///< legato: energy of the new voice less that of the old one [J]
    /// change_quality(): energy after less energy before, of the modes that are left out, but for rounding of
    /// the order of the step [J].
    double quality_changes_J = 0;
    double noises_J = 0;  ///< work of the noise of touches; that of a rough finger is in exciters_J [J]
    /// Moving bridge: what voices that begin, fade, rise, end, bend or change their quality give to the
    /// coupling [J].
    double couplings_J = 0;
};

}  // namespace jawari
