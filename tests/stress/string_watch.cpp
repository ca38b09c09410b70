#include "string_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "invariants.h"
#include "jawari/scene/energy.h"
#include "string/contact/impact_law.h"
#include "string/model/compliant_law.h"

namespace jawari::stress {
namespace {

std::span<const double> contact_row(const StringModel& model, std::size_t c) {
    return {model.shape->contact_rows.data() + c * model.shape->stride, model.shape->stride};
}

double dot(const StringModel& model, const double* row, const AlignedVector<double>& x) {
    double sum = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) sum += row[k] * x[k];
    return sum;
}

/// How far an impulse of 1 N s on the row moves it in a step: the diagonal of the compliance.
double answer_of(const StringModel& model, std::span<const double> row) {
    double sum = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        sum += row[k] * model.shape->mobility[k] * row[k];
    return model.shape->step_s * model.shape->theta * sum;
}

/// Contacts that move the string in different ways: fewer than modes, and half the shortest wave apart.
bool has_independent_contacts(const StringModel& model) {
    std::vector<double> places = model.shape->contact_position;
    std::sort(places.begin(), places.end());
    const double apart = model.shape->length_m / static_cast<double>(model.shape->mode_count + 1);
    if (places.empty()) return true;
    if (places.front() < apart || places.back() > model.shape->length_m - apart) return false;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] - places[i - 1] < apart) return false;
    }
    return true;
}

bool gives_way(const StringModel& model, std::size_t c) {
    return !model.shape->contact_compliance.empty() && !is_rigid(model.shape->contact_compliance[c]);
}

/// How often q and v have been rounded: in every step, but once in a frame that is flown.
std::uint64_t roundings_of(const StringModel& model, const Counters& counters) {
    const std::uint64_t crossed = counters.flown_frames + counters.asleep_frames;
    return counters.steps - crossed * model.shape->steps_per_frame + counters.flown_frames;
}

bool has_both_sides(const StringModel& model) {
    const auto above = [](Side side) { return side == Side::Above; };
    const auto n = std::count_if(model.shape->contact_side.begin(), model.shape->contact_side.end(), above);
    return n > 0 && static_cast<std::size_t>(n) < model.shape->contact_count;
}

/// Whether obstacles may contradict one another whatever the impulses are: where some mode moves gaps, but is
/// moved by no impulse (at multiples of twice the step's Nyquist rate), and impulses can cancel in all
/// others. In the first mode, whose shape has one sign, they cancel only from both sides.
bool may_contradict(const StringModel& model) {
    const auto end = model.shape->mobility.begin() + static_cast<std::ptrdiff_t>(model.shape->mode_count);
    const double immovable = 1e-12 * *std::max_element(model.shape->mobility.begin(), end);
    const auto stays = [immovable](double mobility) { return mobility < immovable; };
    return std::any_of(model.shape->mobility.begin(), end, stays) &&
           (stays(model.shape->mobility.front()) || has_both_sides(model));
}

}  // namespace

StringWatch::StringWatch(const StringModel& model, const StringState& start, std::string name)
    : model_(model), name_(std::move(name)) {
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const auto row = contact_row(model, c);
        contacts_.push_back(reach_of(model, row));
        kicks_.push_back(kick_of(model, row));
        largest_answer_ = std::max(largest_answer_, answer_of(model, row));
        longest_extent_ = std::max(longest_extent_, contacts_.back().extent);
        const double gap = dot(model, row.data(), start.displacement) - model.shape->contact_height[c];
        const double gap_before = gap - model.shape->step_s * dot(model, row.data(), start.velocity);
        start_depth_ = std::max({start_depth_, -gap, -gap_before});
    }
    for (std::size_t p = 0; p < model.shape->probes.size(); ++p)
        probes_.push_back(
            reach_of(model, {model.shape->probe_rows.data() + p * model.shape->stride, model.shape->stride}));
    step_rounding_ = step_rounding(model);
    may_be_unsolvable_ = model.shape->contact_count > largest_factor || may_contradict(model) ||
                         !model.shape->contact_compliance.empty();
    highest_ = energy(model, start);
}

/// F w of the forces that are held: their work over a span is its change, docs/engine/model.md, "Forces held
/// over a frame".
double StringWatch::lag_work(const StringState& state) const {
    if (!state.excitation.active) return 0;
    const double* force = state.excitation.held.data();
    return dot(model_, force, state.displacement) - lag_of(model_) * dot(model_, force, state.velocity);
}

/// The size of the terms of lag_work(), which round.
double StringWatch::lag_work_size(const StringState& state) const {
    if (!state.excitation.active) return 0;
    double size = 0;
    for (std::size_t k = 0; k < model_.shape->mode_count; ++k) {
        const double reach = std::abs(state.displacement[k]) + lag_of(model_) * std::abs(state.velocity[k]);
        size += std::abs(state.excitation.held[k]) * reach;
    }
    return size;
}

void StringWatch::begin_block(const StringState& state) {
    before_ = energy(model_, state) - lag_work(state);
    force_arm_ = 0;
    force_work_size_ = lag_work_size(state);
    impulses_before_ = state.counters.impulses;
    block_impulses_ = 0;
    of_block_ = {};
    roundings_before_ = roundings_of(model_, state.counters);
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c) {
        if (state.contact.moving_steps[c] == 0) continue;
        rise_ = std::max(rise_, std::abs(state.contact.height_rate[c]));
        may_be_unsolvable_ = may_be_unsolvable_ || has_both_sides(model_);
    }
    if (!state.excitation.active) return;
    force_arm_ = reach_of(model_, state.excitation.held).middle;
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c) {
        double kick = 0;
        for (std::size_t k = 0; k < model_.shape->mode_count; ++k)
            kick +=
                std::abs(contact_row(model_, c)[k] * model_.shape->mobility[k] * state.excitation.held[k]);
        kick_ = std::max(kick_, model_.shape->step_s * model_.shape->step_s * kick);
    }
}

void StringWatch::note_frame(const StringState& state) {
    if (state.counters.impulses == impulses_before_) return;
    block_impulses_ += state.counters.impulses - impulses_before_;
    impulses_before_ = state.counters.impulses;
    Strikes frame;
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c) {
        frame.impulses_Ns += state.contact.frame_impulse[c];
        frame.kicks += kicks_[c] * state.contact.frame_impulse[c];
    }
    strongest_.impulses_Ns = std::max(strongest_.impulses_Ns, frame.impulses_Ns);
    strongest_.kicks = std::max(strongest_.kicks, frame.kicks);
    all_impulses_Ns_ += frame.impulses_Ns;
    of_block_.impulses_Ns += frame.impulses_Ns;
    of_block_.kicks += frame.kicks;
}

void StringWatch::raise_bounds(const StringState& state) {
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c)
        highest_obstacle_ = std::max(highest_obstacle_, std::abs(state.contact.height[c]));
    if (state.metering == Metering::Step) {
        highest_ = std::max(highest_, state.energy.highest);
    } else {
        // H - F w does not rise, and |F w| <= arm sqrt(H): a quadratic inequality for sqrt(H).
        const double half = force_arm_ / 2;
        const double root = half + std::sqrt(half * half + std::max(0.0, before_));
        highest_ = std::max(highest_, root * root);
    }
}

void StringWatch::end_block(const StringState& state, std::span<const std::span<const double>> outputs,
                            Judge& judge) {
    raise_bounds(state);
    if (has_burst()) return;
    check_finite(judge, state.displacement, name_ + " displacement");
    check_finite(judge, state.velocity, name_ + " velocity");
    check_resets(judge, state.counters.nonfinite_resets, name_);
    check_energy(state, judge);
    check_counters(state, judge);
    check_gaps(state, judge);
    check_outputs(state, outputs, judge);
}

bool StringWatch::has_burst() const {
    const bool may_grow =
        !is_passive(model_.shape->law) || model_.shape->scheme != Scheme::Exact || rise_ > 0;
    return may_grow && !(highest_ <= largest_energy_J);
}

void StringWatch::check_energy(const StringState& state, Judge& judge) const {
    const double of_step = step_rounding_ * highest_;
    const double gap_size = bound_of(longest_extent_, highest_) + highest_obstacle_;
    if (state.metering == Metering::Step) {
        const double allowed = of_step + kick_rounding(model_, strongest_.kicks, highest_) +
                               work_rounding(model_, strongest_.impulses_Ns, rise_) +
                               stored_rounding(gap_size);
        check_balance(judge, state.energy, allowed, name_);
        const bool passive = model_.shape->scheme == Scheme::Exact && is_passive(model_.shape->law);
        const double of_gaps = work_rounding(model_, strongest_.impulses_Ns, gap_size) +
                               residual_work(model_, strongest_.impulses_Ns, state.counters.worst_residual_m);
        if (passive) check_rise_of_step(judge, state.energy, allowed + of_gaps, name_);
        return;
    }
    const double rise = energy(model_, state) - lag_work(state) - before_;
    check_rise_of_block(judge, rise, rise_of_block_allowed(state), name_);
}

/// What compliant contacts store is known as well as their depth is: a force works along that doubt.
double StringWatch::stored_rounding(double gap_size) const {
    return model_.shape->contact_compliance.empty()
               ? 0.0
               : 4 * work_rounding(model_, strongest_.impulses_Ns, gap_size);
}

double StringWatch::rise_of_block_allowed(const StringState& state) const {
    const double gap_size = bound_of(longest_extent_, highest_) + highest_obstacle_;
    const std::uint64_t roundings = roundings_of(model_, state.counters) - roundings_before_;
    const auto steps = static_cast<double>(1 + roundings + block_impulses_);
    return steps * (step_rounding_ * highest_ + force_rounding(model_, force_work_size_)) +
           kick_rounding(model_, of_block_.kicks, highest_) +
           work_rounding(model_, of_block_.impulses_Ns, gap_size) +
           residual_work(model_, of_block_.impulses_Ns, state.counters.worst_residual_m);
}

double StringWatch::gap_rounding(std::size_t contact) const {
    const double size = bound_of(contacts_[contact].extent, highest_) + highest_obstacle_;
    return gap_rounding_share(model_) * size;
}

/// Impulses of obstacles that pinch the string nearly cancel, and round as what they are: the law lifts what
/// lies too deep for that by gap_rounding_m a step, which may be less.
double StringWatch::sinking() const {
    return sum_rounding(model_, largest_answer_ * all_impulses_Ns_);
}

double StringWatch::depth_bound(std::size_t contact) const {
    const double travel = model_.shape->step_s * bound_of(contacts_[contact].speed, highest_) + rise_;
    return std::max(start_depth_,
                    depth_of_law(model_.shape->law, model_.shape->contact_restitution[contact], travel)) +
           1e-9 * travel + gap_rounding(contact) + sinking();
}

void StringWatch::check_gaps(const StringState& state, Judge& judge) const {
    const bool proven = model_.shape->scheme == Scheme::Exact && state.counters.truncated_solves == 0;
    if (!proven || model_.shape->contact_count == 0) return;
    double deepest_allowed = 0;
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c) {
        if (gives_way(model_, c)) continue;
        const double allowed = depth_bound(c);
        deepest_allowed = std::max(deepest_allowed, allowed);
        const double gap =
            dot(model_, contact_row(model_, c).data(), state.displacement) - state.contact.height[c];
        if (!state.asleep) check_depth(judge, -gap, allowed, name_ + " contact " + std::to_string(c));
    }
    check_depth(judge, state.counters.worst_penetration_m, deepest_allowed, name_ + " within the block");
}

void StringWatch::check_counters(const StringState& state, Judge& judge) const {
    if (!may_be_unsolvable_) check_truncation(judge, state.counters, has_independent_contacts(model_), name_);
    double travel = 0;
    double rounding = 0;
    for (std::size_t c = 0; c < model_.shape->contact_count; ++c) {
        travel = std::max(travel, contacts_[c].speed);
        rounding = std::max(rounding, gap_rounding(c));
    }
    travel = model_.shape->step_s * bound_of(travel, highest_);
    check_residual(judge, state.counters.worst_residual_m, 2 * travel + rise_ + kick_, rounding, name_);
}

void StringWatch::check_outputs(const StringState& state, std::span<const std::span<const double>> outputs,
                                Judge& judge) const {
    // H itself may have risen by as much since the block began.
    const double energy_J = highest_ + rise_of_block_allowed(state);
    for (std::size_t p = 0; p < outputs.size(); ++p) {
        const std::string where = name_ + " probe " + std::to_string(p);
        check_finite(judge, outputs[p], where);
        switch (model_.shape->probes[p].quantity) {
            case Quantity::Displacement:
                check_output(judge, outputs[p], bound_of(probes_[p].extent, energy_J), where);
                break;
            case Quantity::Velocity:
                check_output(judge, outputs[p], bound_of(probes_[p].speed, energy_J), where);
                break;
            case Quantity::Energy:
                check_output(judge, outputs[p], energy_J, where);
                break;
            case Quantity::ContactForce:
                check_not_negative(judge, outputs[p], where);
                break;
            default:  // hostile scenes read no others
                break;
        }
    }
}

}  // namespace jawari::stress
