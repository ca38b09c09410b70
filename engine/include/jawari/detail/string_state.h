// Everything that changes while a scene is rendered: plain data, fully initialised by make_state().
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/detail/lcp.h"
#include "jawari/detail/string_model.h"
#include "jawari/scene/skipping.h"

namespace jawari {

/// What happened since make_state().
struct Counters {
    std::uint64_t steps = 0;       ///< contact steps simulated
    std::uint64_t candidates = 0;  ///< evaluated contacts that were candidates of their step's law
    std::uint64_t impulses = 0;    ///< impulses > 0
    std::uint64_t solves = 0;      ///< complementarity problems with a violated candidate
    std::uint64_t truncated_solves =
        0;                            ///< solves stopped by the bound on operations, made passive by scaling
    std::uint64_t flown_frames = 0;   ///< frames crossed by free flight
    std::uint64_t near_frames = 0;    ///< frames stepped finely for the contacts that might close
    std::uint64_t asleep_frames = 0;  ///< frames that cost nothing
    std::uint64_t nonfinite_resets =
        0;  ///< times the string was put to rest because its state was not finite
    double worst_residual_m =
        0;  ///< largest LCP residual max_c |min(y - tau, A_cc lambda)| of finished solves
    double worst_penetration_m = 0;  ///< largest -gap
};

/// Sums, and the worst of residuals and penetrations.
void accumulate(const Counters& more, Counters& sum) noexcept;

/// Energies in joules, accumulated while metering is on (Metering::Step).
struct EnergyMeter {
    double initial = 0;          ///< H at make_state()
    double highest = 0;          ///< largest H seen (each step with Metering::Step, else each frame)
    double dissipated = 0;       ///< by the string's own losses, >= 0
    double contact_work = 0;     ///< sum lambda (y+ - y_before)/(2h): work of impacts on the string
    double player_work = 0;      ///< sum lambda (b+ - b_before)/(2h): work of moving obstacles
    double worst_imbalance = 0;  ///< largest |H+ - H + losses - works| of one step
    double worst_rise = 0;       ///< largest H+ - H - player's work of one step
};

enum class Metering {
    Off,
    Frame,  ///< H at the end of each frame in which it may have risen
    Step    ///< the whole balance at each step; about twice the cost
};

/// Contact coordinates; arrays over the model's contacts, padded to contact_stride.
struct ContactState {
    AlignedVector<double> gap;                 ///< y [m]
    AlignedVector<double> gap_before;          ///< y one step earlier
    AlignedVector<double> height;              ///< b [m], starts from the model's contact_height
    AlignedVector<double> height_before;       ///< b one step earlier
    AlignedVector<double> height_rise_before;  ///< change of b in the step before [m]
    AlignedVector<double> height_rate;         ///< change of b per step while moving [m]
    std::vector<std::uint64_t> moving_steps;   ///< steps left of a movement
    AlignedVector<double> height_target;       ///< b at the end of the movement
    AlignedVector<double> impulse;             ///< lambda of the last step [N s]; also the warm start
    AlignedVector<double> frame_impulse;       ///< sum of lambda over the frame [N s]
    AlignedVector<double> gap_free;            ///< scratch: y_free
    AlignedVector<double> gap_rate;            ///< scratch: S v of the step's start (theta scheme)
    AlignedVector<double> offset;              ///< scratch: r = y_free - tau
    AlignedVector<double> residual;            ///< scratch: r + A lambda
    std::vector<std::uint32_t>
        near;  ///< contacts evaluated at each step; `near_count` are valid, gaps of others are stale
    std::vector<std::uint8_t> is_near;  ///< the same as flags
    std::size_t near_count = 0;
    std::vector<std::uint32_t> candidates;  ///< scratch: indices; `candidate_count` are valid
    std::size_t candidate_count = 0;
    std::size_t moving_count = 0;
    double left_open = 0;  ///< what the last solve left of a violation [m]; 0 if it was truncated
};

/// The low modes flown ahead, and what they show of contacts; see lookout.h.
struct LookoutState {
    AlignedVector<double> displacement, velocity;  ///< scratch over the low modes
    std::vector<double> group_detour;     ///< of the low modes, as CertificateState::group_detour [m]
    std::vector<double> group_overtones;  ///< what all other modes can displace a gap by [m]
    std::vector<double> gap, gap_end;     ///< per contact: of the low modes, at a frame's ends [m]
    std::vector<std::uint64_t> gap_at;    ///< frame at whose start `gap` holds, under excitation
    std::vector<std::uint32_t> watched;   ///< scratch: contacts that the odometer does not certify far enough
    std::vector<std::uint32_t> unknown;   ///< scratch
};

/// What the excitation adds to the bounds of every gap, docs/engine/certificate.md, section 4.
struct KickState {
    // by the frames since the last refresh, the coming one included
    double speed = 0;       ///< [m/s]
    double overtones = 0;   ///< [m]
    double detour = 0;      ///< [m]
    double low_detour = 0;  ///< [m]
    // within the coming frame alone
    double frame_detour = 0;      ///< [m]
    double frame_low_detour = 0;  ///< [m]
};

/// What a modal force of 1 N m^(-1/2) on each of the modes that forces reach does to the bounds in a unit of
/// time: sums over the low modes and over the others (docs/engine/certificate.md, section 4).
struct UnitKick {
    std::size_t modes = 0;   ///< that the sums cover; 0: not known since the last refresh
    double low_speed = 0;    ///< sum kick over the low modes [1/(kg m)]
    double low_detour = 0;   ///< sum kick detour [s/(kg m)]
    double high_speed = 0;   ///< of the others likewise [1/(kg m)]
    double high_extent = 0;  ///< sum kick extent [s/(kg m)]
    double high_detour = 0;  ///< [s/(kg m)]
};

/// Bounds that hold until an impulse, a force or an outside change of state (docs/engine/certificate.md).
struct CertificateState {
    AlignedVector<double> speed;  ///< scratch over modes: r_k, bound of |v_k|
    AlignedVector<double>
        detour;  ///< scratch over modes: how far q_k may leave the straight line between frame boundaries
    AlignedVector<double> extent;  ///< scratch over modes: bound of |q_k|
    // per group of contacts
    std::vector<double> group_speed;   ///< R: bound of the gaps' rate [m/s]
    std::vector<double> group_detour;  ///< D: how far a gap dips below both its values at a frame's ends [m]
    std::vector<double>
        group_clearance;  ///< lower bound of the gaps for as long as the string flies freely [m]
    std::vector<std::uint8_t> group_has_detour, group_has_clearance,
        group_has_lookout;               ///< known since the last refresh
    std::vector<double> group_odometer;  ///< integral of R since the last refresh [m]
    std::vector<double>
        group_push;  ///< what the frame's impulses so far may have moved the gaps until its end [m]
    std::vector<double> group_margin;  ///< smallest margin of the group's contacts this frame [m]
    // per contact
    std::vector<double> open_until;     ///< odometer reading up to which the gap is certainly open [m]
    std::vector<double> margin;         ///< this frame's lower bound of the gap without impulses [m]
    std::vector<double> frame_gap;      ///< S q - b at the coming frame's start, where frame_gap_at says so
    std::vector<double> frame_end_gap;  ///< scratch: the same at the frame's end in free flight
    std::vector<std::uint64_t> frame_gap_at;  ///< frame at whose start frame_gap holds
    std::vector<std::uint64_t> certified_at;  ///< frame for which the lookout certified it, with its margin
    LookoutState lookout;
    std::vector<std::uint32_t> expired;  ///< scratch: contacts whose certificate has run out
    std::vector<std::uint32_t> expired_groups, missing_groups;  ///< scratch
    std::size_t missing_count = 0;
    std::uint64_t free_frames = 0;  ///< coming frames in which no contact can close, already in the odometers
    std::uint64_t age = 0;          ///< frames since the last refresh
    bool outdated = true;           ///< an impulse has raised the bounds
    bool struck = false;            ///< the last frame had impulses: the coming one most likely has
    std::uint32_t presumed_near = 0;  ///< coming short frames under forces that are solved without looking
    std::uint32_t presumption = 0;    ///< how many there were after the last look, 0 if it was in order
    bool direct = false;   ///< the coming frame looks at all gaps at both its ends; odometers stand still
    bool excited = false;  ///< the last refresh was made under excitation
    /// The string has too little energy to reach any contact for as long as only passive forces act.
    bool clear = false;
    bool clear_limits_outdated = true;
    double clear_energy_J = 0;  ///< below this it is clear,
    double clear_force_N = 0;   ///< under passive forces of this strength together
    KickState kicks;
    UnitKick unit_kick;
    double strongest_speed = 0;   ///< largest r_k ever [m^(3/2)/s]
    double strongest_extent = 0;  ///< largest |q_k| bound ever
};

/// Scratch of a frame solved in contact space; contacts x steps, rows response_stride apart.
struct NearState {
    AlignedVector<double>
        rates_free;  ///< S v of free flight at each step, in the order of ContactState::near
    AlignedVector<double>
        rates;  ///< the same with the impulses so far; by step responses step by step, contact_stride apart
    AlignedVector<double> impulses;     ///< lambda at each step, in the order of `struck`
    std::vector<std::uint32_t> struck;  ///< contacts with impulses in the frame; `struck_count` are valid
    std::size_t struck_count = 0;
    AlignedVector<double> force_impulses;  ///< h and h n at each step n, for the held force and its ramp
    AlignedVector<double> force_rows;      ///< (w/mu) times the held force and its ramp, modes apart
    std::size_t first_impulse = 0;         ///< step of the frame's first impulse
    AlignedVector<double> lanes;
    AlignedVector<double> displacement, velocity;    ///< over modes
    AlignedVector<double> gap, gap_before, impulse;  ///< at the frame's start
    double left_open = 0;                            ///< the same
    std::vector<const double*> rows;
    Counters counters;
};

/// The Delassus operator with some contacts active, the others' gaps open: what sweep() of
/// contact_kernels.cpp makes of it.
struct PivotTable {
    std::uint64_t of = 0;               ///< StringShape::compliance_id, or 0 if the table is not made
    AlignedVector<double> values;       ///< contacts x contact_stride
    AlignedVector<double> sign;         ///< 1: active, -1: not; over contacts
    AlignedVector<double> scale;        ///< makes gaps of the solution: A_cc of active contacts, else 1
    AlignedVector<double> solution;     ///< scratch: impulses of active contacts, gaps above target of others
    std::vector<std::uint32_t> active;  ///< `active_count` are valid
    std::vector<std::uint32_t> kept;    ///< scratch
    std::size_t active_count = 0;
    std::size_t pivots = 0;  ///< since the table was made
};

/// Frames of few steps over few contacts, short_frame.h.
struct ShortFrameState {
    AlignedVector<double> velocities;   ///< scratch: v of free flight at each step, steps x stride
    AlignedVector<double> rates;        ///< scratch: S v at each step, steps x contact_stride
    AlignedVector<double> impulses;     ///< lambda at each step, steps x contact_stride
    std::vector<std::uint32_t> struck;  ///< contacts with impulses in the frame; `struck_count` are valid
    std::size_t struck_count = 0;
    /// What StringTuning::step_response is to a string that has none because its tension changes: rows of the
    /// contacts in `response_known` hold until forget_responses(), short_frame.h.
    AlignedVector<double> step_response;
    std::vector<std::uint8_t> response_known;
    std::uint64_t gaps_at = 0;  ///< frame at whose start contact.gap and gap_before hold for all contacts
    PivotTable table;
};

/// Forces of the player: sums over points of F phi_k(x), so that any number of them is two rows over modes.
/// The force at the coming step is held + elapsed ramp. Set by add_force(), excitation.h.
struct ExcitationState {
    AlignedVector<double> held;  ///< [N m^(-1/2)]
    AlignedVector<double> ramp;  ///< its change per step [N m^(-1/2)]; all zero unless `ramps`
    std::size_t elapsed = 0;     ///< steps since `held` was set
    std::size_t modes = 0;       ///< both are zero from here on (padded): higher modes may sleep
    bool active = false;         ///< false: `held` is all zero
    bool ramps = false;
    bool passive = false;   ///< the forces take energy over every frame in which no contact acts
    double strength_N = 0;  ///< sum of their sizes, if passive
};

struct StringState {
    AlignedVector<double> displacement;                          ///< q
    AlignedVector<double> velocity;                              ///< backward velocity v
    AlignedVector<double> displacement_before, velocity_before;  ///< scratch: one step earlier
    AlignedVector<double> displacement_flown, velocity_flown;    ///< scratch: the frame's end in free flight
    std::size_t active_modes = 0;  ///< modes in the sums (padded); those behind are at rest
    std::uint64_t frame = 0;       ///< frames since make_state()
    std::size_t steps_left = 0;    ///< of the current frame, including the current step
    bool asleep = false;
    bool leaves_obstacles = false;  ///< see leave_obstacles()
    CertificateState certificate;
    NearState near_frame;
    ShortFrameState short_frame;
    Skipping skipping;
    /// Frames with a contact that may close evaluate only such contacts, if `skipping` lets them; false at a
    /// tension for which it is not known how impulses push the others.
    bool steps_near = true;
    ExcitationState excitation;
    ContactState contact;
    LcpWorkspace lcp;
    EnergyMeter energy;
    Counters counters;
    Metering metering = Metering::Off;
};

struct SceneState {
    std::vector<StringState> strings;
    std::uint64_t frame = 0;  ///< frames rendered since the start; t = frame/output_rate
};

/// What the storage of a string's state depends on.
struct StringSizes {
    std::size_t stride = 0;
    std::size_t contacts = 0;
    std::size_t groups = 0;           ///< of contacts, in the certificate
    std::size_t response_stride = 0;  ///< 0: without a table of responses
    std::size_t short_contacts = 0;   ///< padded contacts of models with short frames
    std::size_t short_steps = 0;      ///< steps of their frames
};

StringSizes sizes_of(const StringModel& model);
/// The larger of each.
StringSizes larger(const StringSizes& a, const StringSizes& b);

/// A state with room for every model up to the sizes. To be reset() before use.
StringState allocate_string_state(const StringSizes& sizes);

/// A state at t = 0 for the model. Allocates all that rendering needs.
SceneState make_state(const SceneModel& model, Metering metering = Metering::Off,
                      Skipping skipping = skip_all);

/// One string of it.
StringState make_string_state(const StringModel& model, Metering metering = Metering::Off,
                              Skipping skipping = skip_all);

/// Back to t = 0, counters and meters cleared; does not allocate.
void reset(const StringModel& model, StringState& state) noexcept;

/// To be called when displacement, velocity, the model or the force row were changed from outside between
/// frames: the gaps are computed anew, every bound is forgotten, a sleeping string wakes.
void notice_change(const StringModel& model, StringState& state) noexcept;

/// From now on, until reset(), the string meets no obstacle: for motions that are being taken away.
void leave_obstacles(StringState& state) noexcept;

/// At rest against the obstacles at their initial heights, without excitation; counters and meters stay. Does
/// not allocate.
void put_to_rest(const StringModel& model, StringState& state) noexcept;

}  // namespace jawari
