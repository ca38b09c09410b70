// Everything that changes while a scene is rendered: plain data, fully initialised by make_state(). A copy is
// a snapshot. Structs have up to four sections: state (must survive), bounds (what the broad phase has proven
// of the state), scratch (holds within one frame or step) and counters. A comment ends with who writes the
// array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/detail/index_list.h"
#include "jawari/detail/lcp.h"
#include "jawari/detail/string_model.h"
#include "jawari/scene/counters.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/skipping.h"

namespace jawari {

/// The number of no frame: a value stamped with it holds nowhere.
inline constexpr std::uint64_t unknown_frame = std::numeric_limits<std::uint64_t>::max();

/// What a frame that is solved again must find as it was at the frame's start.
struct ContactGaps {
    AlignedVector<double> gap;            ///< y [m]; place_gaps(), accept_gaps(), short frames
    AlignedVector<double> gap_before;     ///< y one step earlier; the same functions
    AlignedVector<double> impulse;        ///< lambda of the last step [N s], the next warm start; the solvers
    AlignedVector<double> frame_impulse;  ///< sum of lambda over the frame [N s]; accept_gaps(), short frames
    double left_open = 0;  ///< what the last solve left of a violation [m]; 0 if it was truncated
};

/// Contact coordinates; arrays over the model's contacts, padded to contact_stride.
struct ContactState : ContactGaps {
    // -- state
    AlignedVector<double> height;         ///< b [m]; move_obstacles(), from the model's contact_height on
    AlignedVector<double> height_before;  ///< b one step earlier; move_obstacles()
    AlignedVector<double> height_rise_before;  ///< change of b in the step before [m]; move_obstacles()
    AlignedVector<double> height_rate;         ///< change of b per step while moving [m]; move_contact()
    AlignedVector<double> height_target;       ///< b at the end of the movement; move_contact()
    std::vector<std::uint64_t> moving_steps;   ///< steps left of a movement; move_contact(), move_obstacles()
    std::size_t moving_count = 0;              ///< contacts that move; move_contact(), move_obstacles()
    /// While StringState::frame has this value, step() continues the gaps of all contacts; else it first
    /// computes them from the modes. notice_change() and forget_bounds() write it.
    std::uint64_t stepping_in_frame = unknown_frame;
    // -- broad phase
    IndexList near;  ///< contacts evaluated at each step, the gaps of others are stale; make_near()
    std::vector<std::uint8_t> is_near;  ///< 1 for the contacts in `near`; make_near()
    // -- scratch of a step
    IndexList candidates;  ///< contacts that may have an impulse; select_candidates()
    IndexList rigid;       ///< those on which the impact law acts, where others are compliant; the same
    IndexList compliant;   ///< the others; the same
    AlignedVector<double> compliant_impulse;  ///< their lambda; solve_compliant_contacts()
    AlignedVector<double> gap_free;           ///< y_free; predict_gaps()
    AlignedVector<double> gap_rate;           ///< S v of the step's start (theta scheme); note_approach()
    AlignedVector<double> offset;             ///< r = y_free - tau; select_candidates()
    AlignedVector<double> residual;           ///< r + A lambda; the solvers
};

/// What the excitation adds to the bounds of every gap, docs/engine/certificate.md, section 4; add_kicks().
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
/// time: sums over the low modes and over the others (docs/engine/certificate.md, section 4); add_kicks().
struct UnitKick {
    std::size_t modes = 0;   ///< that the sums cover; 0: not known since the last refresh
    double low_speed = 0;    ///< sum kick over the low modes [1/(kg m)]
    double low_detour = 0;   ///< sum kick detour over the low modes [s/(kg m)]
    double high_speed = 0;   ///< sum kick over the other modes [1/(kg m)]
    double high_extent = 0;  ///< sum kick extent over the other modes [s/(kg m)]
    double high_detour = 0;  ///< sum kick detour over the other modes [s/(kg m)]
};

/// Bounds of modes and gaps, which hold until an impulse, a force or an outside change of state
/// (docs/engine/certificate.md). Validity says which of them are known.
struct GapBounds {
    // -- per mode; refresh_bounds()
    AlignedVector<double> speed;   ///< r_k, bound of |v_k|
    AlignedVector<double> detour;  ///< how far q_k may leave the straight line between frame boundaries
    AlignedVector<double> extent;  ///< bound of |q_k|
    // -- per group of contacts
    std::vector<double> group_speed;   ///< R: bound of the gaps' rate [m/s]; refresh_bounds()
    std::vector<double> group_detour;  ///< D: how far a gap dips below both its values at a frame's ends [m];
                                       ///< complete_detours()
    std::vector<double> group_clearance;  ///< lower bound of the gaps for as long as the string flies freely
                                          ///< [m]; complete_clearances()
    std::vector<double> group_odometer;   ///< integral of R since the last refresh [m]; plan_free_frames(),
                                          ///< advance_bounds()
    std::vector<double> group_push;  ///< what the frame's impulses so far may have moved the gaps until its
                                     ///< end [m]; charge_impulses(), near frames
    std::vector<double> group_step_push;  ///< scratch: the same of the present step's impulses [m];
                                          ///< weigh_pushes()
    std::vector<double> group_margin;     ///< smallest margin of the group's contacts that are not near [m];
                                          ///< choose_near_contacts(), admit_pushed_contacts()
    // -- per contact
    std::vector<double> open_until;     ///< odometer reading up to which the gap is certainly open [m]; the
                                        ///< functions of gap_certificate.h, forecast.h and short_frame.h
    std::vector<double> margin;         ///< this frame's lower bound of the gap without impulses [m];
                                        ///< choose_near_contacts(), the forecast
    std::vector<double> frame_gap;      ///< S q - b at the start of frame Validity::frame_gap_at;
                                        ///< choose_near_contacts(), note_stepped_gaps(), note_short_frame()
    std::vector<double> frame_end_gap;  ///< scratch: the same at the frame's end in free flight
    // -- of the forces
    KickState kicks;
    UnitKick unit_kick;
    // -- over the string's past; refresh_bounds()
    double strongest_speed = 0;   ///< largest r_k ever [m^(3/2)/s]
    double strongest_extent = 0;  ///< largest |q_k| bound ever
};

/// Which bounds are known, and since when.
struct Validity {
    bool outdated = true;   ///< an impulse has raised the bounds, or they were forgotten
    bool excited = false;   ///< the last refresh was made under excitation
    std::uint64_t age = 0;  ///< frames since the last refresh, the planned ones included
    /// The coming frame tests all gaps at both its ends; odometers stand still. refresh_bounds()
    bool direct = false;
    /// Odometers and readings hold at the start of this frame. It is later than StringState::frame while
    /// planned frames are left; planned_frames() says how many.
    std::uint64_t odometers_at_frame = 0;
    // -- per group: known since the last refresh
    std::vector<std::uint8_t> group_has_detour;     ///< GapBounds::group_detour
    std::vector<std::uint8_t> group_has_clearance;  ///< GapBounds::group_clearance
    std::vector<std::uint8_t> group_has_forecast;   ///< both bounds of ForecastState
    // -- per contact
    std::vector<std::uint64_t> frame_gap_at;  ///< frame at whose start GapBounds::frame_gap holds
    std::vector<std::uint64_t> certified_at;  ///< frame for which the forecast certified it, with its margin
};

/// Frames under forces that are solved without a contact test, because tests have failed (exponential
/// back-off); cross_frame().
struct Backoff {
    std::uint32_t granted = 0;  ///< by the last failed test; 0 after a test that succeeded
    std::uint32_t left = 0;     ///< of them
};

/// The string has too little energy to reach any contact for as long as only passive forces act;
/// refresh_bounds().
struct ClearState {
    bool valid = false;         ///< it is so
    bool limits_valid = false;  ///< the limits hold for the obstacles' present heights
    double energy_J = 0;        ///< limit of the string's energy
    double root =
        0;  ///< bound of the root of the string's energy, with all that bounded forces gave [J^(1/2)]
    double force_N = 0;  ///< limit of the strength of all passive forces together
};

/// The low modes advanced into the future, and the gaps they predict; forecast.h writes it.
struct ForecastState {
    // -- bounds
    std::vector<double> group_detour;     ///< how far the low modes let a gap dip below both its ends [m]
    std::vector<double> group_overtones;  ///< what all other modes can displace a gap by [m]
    std::vector<double> gap;              ///< per contact: of the low modes, at the frame's start [m]
    std::vector<std::uint64_t> gap_at;    ///< frame at whose start `gap` holds, under excitation
    // -- scratch
    AlignedVector<double> displacement, velocity;  ///< over the low modes
    std::vector<double> gap_end;                   ///< per contact: `gap` at the frame's end [m]
    IndexList watched;                             ///< contacts that the odometer does not certify far enough
    IndexList unknown;                             ///< watched contacts whose `gap` is not known
};

/// The broad phase: which contacts can close (docs/engine/certificate.md).
struct CertificateState {
    // -- state
    bool struck = false;  ///< the last frame had impulses: the coming one most likely has
    Backoff backoff;
    // -- bounds
    GapBounds bounds;
    Validity validity;
    ClearState clear;
    ForecastState forecast;
    // -- scratch
    IndexList expired;         ///< contacts whose certificate has run out
    IndexList expired_groups;  ///< groups of such contacts
    IndexList missing_groups;  ///< groups whose bound is computed for the first time since the last refresh
    IndexList unknown_gaps;    ///< contacts whose GapBounds::frame_gap is computed
};

/// All that solving a frame once more with more contacts starts from.
struct FrameStart {
    ContactGaps gaps;
    Counters counters;
};

/// Scratch of a frame solved in contact space, near_frame.h; contacts x steps, rows response_stride apart.
struct NearState {
    // -- state
    /// Whether the last near frame had so many impulses that steps of all modes are cheaper; pass_near()
    bool crowded = false;
    // -- scratch
    AlignedVector<double>
        rates_free;  ///< S v of free flight at each step, in the order of ContactState::near
    AlignedVector<double>
        rates;  ///< S v with the impulses so far; by step responses step by step, contact_stride apart
    AlignedVector<double> impulses;        ///< lambda at each step, in the order of `struck`
    IndexList struck;                      ///< contacts with impulses in the frame
    std::size_t first_impulse = 0;         ///< step of the frame's first impulse
    AlignedVector<double> force_impulses;  ///< h and h n at each step n, for the held force and its ramp
    AlignedVector<double> force_rows;      ///< (w/mu) times the held force and its ramp, modes apart
    AlignedVector<double> lanes;           ///< of kernels::run_modes()
    AlignedVector<double> displacement, velocity;  ///< over modes, of kernels::run_modes()
    std::vector<const double*> rows;               ///< of kernels::run_modes()
    FrameStart start;                              ///< solve_near_frame()
};

/// The Delassus operator with some contacts active, the others' gaps open: what sweep() of pivot_table_inl.h
/// makes of it.
struct PivotTable {
    std::uint64_t of = 0;            ///< StringShape::compliance_id, or 0 if the table is not made
    AlignedVector<double> values;    ///< contacts x contact_stride
    AlignedVector<double> sign;      ///< 1: active, -1: not; over contacts
    AlignedVector<double> scale;     ///< makes gaps of the solution: A_cc of active contacts, else 1
    IndexList active;                ///< the active set, in the order in which contacts entered it
    std::size_t pivots = 0;          ///< since the table was made
    AlignedVector<double> solution;  ///< scratch: impulses of active contacts, gaps above target of others
    IndexList kept;                  ///< scratch: the active set while the table is made anew
};

/// Frames of few steps over few contacts, short_frame.h.
struct ShortFrameState {
    // -- state
    std::uint64_t gaps_at = unknown_frame;  ///< frame at whose start contact.gap and gap_before hold for all
    PivotTable table;
    /// What StringTuning::step_response is to a string that has none because its tension changes: rows of the
    /// contacts in `response_known` hold until forget_responses(), short_frame.h.
    AlignedVector<double> step_response;
    std::vector<std::uint8_t> response_known;  ///< kernels::find_response(), forget_responses()
    // -- scratch of a frame
    AlignedVector<double> velocities;  ///< v of free flight at each step, steps x stride
    AlignedVector<double> rates;       ///< S v at each step, steps x contact_stride
    AlignedVector<double> impulses;    ///< lambda at each step, steps x contact_stride
    IndexList struck;                  ///< contacts with impulses in the frame
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
    double strength_N = 0;  ///< sum of their sizes, if passive or bounded
    /// By how much the forces raise the root of the string's energy in the frame at most [J^(1/2)]; below 0:
    /// unknown.
    double root = -1;
};

struct StringState {
    // -- state
    AlignedVector<double> displacement;  ///< q; each frame or step
    AlignedVector<double> velocity;      ///< backward velocity v; each frame or step
    std::size_t active_modes = 0;        ///< modes in the sums (padded); those behind are at rest
    std::uint64_t frame = 0;             ///< frames since make_state()
    std::size_t steps_left = 0;          ///< of the current frame, including the current step
    bool asleep = false;                 ///< refresh_bounds(), notice_change()
    bool leaves_obstacles = false;       ///< leave_obstacles(), reset()
    Skipping skipping;
    Metering metering = Metering::Off;
    ExcitationState excitation;
    ContactState contact;
    LcpWorkspace lcp;
    ShortFrameState short_frame;
    // -- bounds
    CertificateState certificate;
    // -- scratch
    AlignedVector<double> displacement_before, velocity_before;  ///< one step earlier; step()
    AlignedVector<double> displacement_flown, velocity_flown;    ///< the frame's end in free flight
    NearState near_frame;
    // -- counters
    EnergyMeter energy;
    Counters counters;
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

/// Sets the whole scene back to t = 0: every string and SceneState::frame. `state` must have been made for
/// `model`. Threads: one at a time per state; realtime-safe.
void reset(const SceneModel& model, SceneState& state) noexcept;

/// To be called when displacement, velocity, the model or the force row were changed from outside between
/// frames: the gaps are computed anew, every bound is forgotten, a sleeping string wakes.
void notice_change(const StringModel& model, StringState& state) noexcept;

/// From now on, until reset(), the string meets no obstacle: for motions that are being taken away.
void leave_obstacles(StringState& state) noexcept;

/// At rest against the obstacles at their initial heights, without excitation; counters and meters stay. Does
/// not allocate.
void put_to_rest(const StringModel& model, StringState& state) noexcept;

}  // namespace jawari
