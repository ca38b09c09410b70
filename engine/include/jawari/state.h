// Everything that changes while a scene is rendered: plain data, fully initialised by make_state().
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/aligned.h"
#include "jawari/lcp.h"
#include "jawari/model.h"

namespace jawari {

/// What happened since make_state().
struct Counters {
    std::uint64_t steps = 0;             ///< contact steps simulated
    std::uint64_t candidates = 0;        ///< contacts that entered a complementarity problem
    std::uint64_t impulses = 0;          ///< impulses > 0
    std::uint64_t solves = 0;            ///< complementarity problems with a violated candidate
    std::uint64_t truncated_solves = 0;  ///< solves stopped by the bound on operations, made passive by scaling
    std::uint64_t nonfinite_resets = 0;  ///< times the string was put to rest because its state was not finite
    double worst_residual_m = 0;         ///< largest LCP residual max_c |min(y - tau, A_cc lambda)| of finished solves
    double worst_penetration_m = 0;      ///< largest -gap
};

/// Energies in joules, accumulated while metering is on (Metering::Step).
struct EnergyMeter {
    double initial = 0;             ///< H at make_state()
    double highest = 0;             ///< largest H seen (each step with Metering::Step, else each frame)
    double dissipated = 0;          ///< by the string's own losses, >= 0
    double contact_work = 0;        ///< sum lambda (y+ - y_before)/(2h): work of impacts on the string
    double player_work = 0;         ///< sum lambda (b+ - b_before)/(2h): work of moving obstacles
    double worst_imbalance = 0;     ///< largest |H+ - H + losses - works| of one step
    double worst_rise = 0;          ///< largest H+ - H - player's work of one step
};

enum class Metering {
    Off,
    Frame,  ///< H at the end of each frame
    Step    ///< the whole balance at each step; about twice the cost
};

/// Contact coordinates; arrays over the model's contacts, padded to contact_stride.
struct ContactState {
    AlignedVector<double> gap;            ///< y [m]
    AlignedVector<double> gap_before;     ///< y one step earlier
    AlignedVector<double> height;         ///< b [m], starts from the model's contact_height
    AlignedVector<double> height_before;  ///< b one step earlier
    AlignedVector<double> height_rise_before;  ///< change of b in the step before [m]
    AlignedVector<double> height_rate;    ///< change of b per step while moving [m]
    std::vector<std::uint64_t> moving_steps;  ///< steps left of a movement
    AlignedVector<double> height_target;  ///< b at the end of the movement
    AlignedVector<double> impulse;        ///< lambda of the last step [N s]; also the warm start
    AlignedVector<double> frame_impulse;  ///< sum of lambda over the frame [N s]
    AlignedVector<double> gap_free;       ///< scratch: y_free
    AlignedVector<double> gap_rate;       ///< scratch: S v of the step's start (theta scheme)
    AlignedVector<double> offset;         ///< scratch: r = y_free - tau
    AlignedVector<double> residual;       ///< scratch: r + A lambda
    std::vector<std::uint32_t> candidates;    ///< scratch: indices; `candidate_count` are valid
    std::size_t candidate_count = 0;
    std::size_t moving_count = 0;
};

struct StringState {
    AlignedVector<double> displacement;  ///< q
    AlignedVector<double> velocity;      ///< backward velocity v
    AlignedVector<double> displacement_before, velocity_before;  ///< scratch for metering and the theta scheme
    AlignedVector<double> force_row;     ///< phi_k(x) of the excitation [m^(-1/2)]
    double force = 0;                    ///< excitation at the step [N]
    double force_rate = 0;               ///< its change per step [N]
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

/// A state at t = 0 for the model. Allocates all that rendering needs.
SceneState make_state(const SceneModel& model, Metering metering = Metering::Off);

/// One string of it.
StringState make_string_state(const StringModel& model, Metering metering = Metering::Off);

/// Back to t = 0, counters and meters cleared; does not allocate.
void reset(const StringModel& model, StringState& state) noexcept;

/// At rest against the obstacles at their initial heights, without excitation; counters and meters stay. Does not allocate.
void put_to_rest(const StringModel& model, StringState& state) noexcept;

}  // namespace jawari
