// The invariants of the exact scheme, each with its bound and its source. docs/engine/stability.md has the
// proofs.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "jawari/detail/string_state.h"
#include "judge.h"

namespace jawari::stress {

/// Operations that round one after another in a sum over the modes.
double operations(const StringModel& model);

/// What rounding may change H by in one step, as a share of H; rounding_share() in reach.h.
double step_rounding(const StringModel& model);

/// Rounding of a sum over the modes, such as S q, whose result is at most `size`.
double sum_rounding(const StringModel& model, double size);

/// What forces may add to that [J]: q is rounded by eps |q|, and the force works along what it has moved by.
/// `work_J`: sum |F_k q_k|.
double force_rounding(const StringModel& model, double work_J);

/// What impulses may add to that [J]: each is rounded when it is applied, which changes H by 2 sqrt(H) times
/// its kick (reach.h). Counts where impulses nearly cancel: obstacles that pinch the string.
double kick_rounding(const StringModel& model, double kicks, double highest_J);

/// What rounding may add to the work of impulses [J]: a length that is known to eps times its size,
/// `length_m`, works by lambda/h.
double work_rounding(const StringModel& model, double impulses_Ns, double length_m);

/// Work of impulses [J] against what their solves have left of the gap's violation.
double residual_work(const StringModel& model, double impulses_Ns, double residual_m);

/// Rounding of a gap, relative to |S q| + |b|: sums over modes, and one rounding a step until the gap is
/// summed afresh (docs/engine/model.md, "The time step"; every 64 frames at most, docs/engine/certificate.md,
/// section 6).
double gap_rounding_share(const StringModel& model);

/// How far a gap may close, with `travel` what it changes by in a step at most (docs/engine/stability.md,
/// "Gaps").
double depth_of_law(ImpactLaw law, double restitution, double travel);

void check_finite(Judge& judge, std::span<const double> values, const std::string& where);

/// A string that is not finite is put to rest and counted: valid scenes never are (see
/// docs/engine/model.md, "The time step").
void check_resets(Judge& judge, std::uint64_t resets, const std::string& where);

/// H+ - H = - losses + work of impacts + work of the player, term by term from the states themselves
/// (docs/engine/model.md, "Energy"); any law, any h.
void check_balance(Judge& judge, const EnergyMeter& meter, double rounding_J, const std::string& where);

/// Impacts and losses only take: laws with tau <= y_before (docs/engine/model.md, "Passive laws").
void check_rise_of_step(Judge& judge, const EnergyMeter& meter, double rounding_J, const std::string& where);

/// The same over a block whose forces are held: their work is F (w_end - w_start), exactly.
void check_rise_of_block(Judge& judge, double rise_J, double rounding_J, const std::string& where);

void check_depth(Judge& judge, double depth, double allowed, const std::string& where);

/// Of solves that finished. `travel`: what a gap changes by in a step at most, the scale of the problem.
void check_residual(Judge& judge, double residual, double travel, double rounding, const std::string& where);

/// A solve is truncated only where more contacts press than the bound on active contacts, or where obstacles
/// move against one another so that the string does not fit (docs/engine/model.md, "The solver and its
/// bound"). Where contacts depend on one another (coincident but for rounding, or more than modes) rounding
/// may end one solve in a hundred; each stays passive.
void check_truncation(Judge& judge, const Counters& counters, bool independent, const std::string& where);

/// |u|, |v| <= reach sqrt(H), see reach.h.
void check_output(Judge& judge, std::span<const double> values, double allowed, const std::string& where);

/// Obstacles push.
void check_not_negative(Judge& judge, std::span<const double> values, const std::string& where);

/// Bit for bit.
void check_same(Judge& judge, std::span<const double> first, std::span<const double> second,
                const std::string& where);

}  // namespace jawari::stress
