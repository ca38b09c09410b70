#include "instrument_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "instrument/voice/bridge_model.h"
#include "instrument/voice/voice.h"
#include "invariants.h"
#include "jawari/instrument/render.h"
#include "jawari/scene/energy.h"
#include "reach.h"
#include "string/contact/impact_law.h"

namespace jawari::stress {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
/// A string does not come closer to a magnet than a fifth of its distance (pickup_signal,
/// pickups.cpp).
constexpr double strongest_magnet = 125;

double total(const PlayerWork& work) {
    return work.exciters_J + work.touches_J + work.bends_J + work.transfers_J + work.quality_changes_J +
           work.noises_J + work.couplings_J;
}

double size_of(const PlayerWork& work) {
    return std::abs(work.exciters_J) + std::abs(work.touches_J) + std::abs(work.bends_J) +
           std::abs(work.transfers_J) + std::abs(work.quality_changes_J) + std::abs(work.noises_J) +
           std::abs(work.couplings_J);
}

/// Sum of the amounts by which each kind of work has changed.
double moved_since(const PlayerWork& before, const PlayerWork& now) {
    return size_of({now.exciters_J - before.exciters_J, now.touches_J - before.touches_J,
                    now.bends_J - before.bends_J, now.transfers_J - before.transfers_J,
                    now.quality_changes_J - before.quality_changes_J, now.noises_J - before.noises_J});
}

ContactReach contact_reach(const StringModel& model) {
    ContactReach largest;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const std::span<const double> row{model.shape->contact_rows.data() + c * model.shape->stride,
                                          model.shape->stride};
        largest.impulse = std::max(largest.impulse, 2 / kick_of(model, row));
        largest.extent = std::max(largest.extent, reach_of(model, row).extent);
        largest.height_m = std::max(largest.height_m, std::abs(model.shape->contact_height[c]));
    }
    return largest;
}

std::vector<std::vector<ContactReach>> contact_reaches(const std::vector<InstrumentStringModel>& strings) {
    std::vector<std::vector<ContactReach>> all;
    for (const InstrumentStringModel& string : strings) {
        all.emplace_back();
        for (const StoppedStringModel& stopped : string.stopped)
            all.back().push_back(contact_reach(stopped.string));
    }
    return all;
}

/// Forces held over a frame, with the rounding of their paths.
double touch_rounding(const StringModel& model, const Voice& voice, double energy_J) {
    double sum = 0;
    const auto add = [&](double force_N, const AlignedVector<double>& row) {
        if (force_N != 0) sum += std::abs(force_N) * bound_of(reach_of(model, row).extent, energy_J);
    };
    for (const Touch& touch : voice.touches.touches) add(touch.point.force_N, touch.row);
    add(voice.touches.exciter.point.force_N, voice.touches.exciter.row);
    return eps * operations(model) * sum;
}

/// Of the bridge under a string [m], by the body's energy.
double largest_under(const BridgeModel& bridge, const BridgeState& state, std::size_t s) {
    const double energy_J = body_energy(bridge, state);
    double sum = 0;
    for (std::size_t j = 0; j < bridge.count; ++j)
        sum += std::abs(bridge.shape[s * bridge.stride + j]) * std::sqrt(2 * energy_J / bridge.stiffness[j]);
    return sum;
}

/// A mode of mass m is no faster than sqrt(2 E/m).
void add_moving_body(const BridgeModel& bridge, const BridgeState& state, double& left, double& right) {
    if (bridge.count == 0) return;
    const double energy_J = body_energy(bridge, state);
    for (std::size_t j = 0; j < bridge.count; ++j) {
        const double speed = state.level * std::sqrt(2 * energy_J / bridge.mass_kg[j]);
        left += std::abs(bridge.gain_left[j]) * speed;
        right += std::abs(bridge.gain_right[j]) * speed;
    }
}

/// The coupling's terms, with the rounding of the force on the bridge, a sum over modes.
double end_rounding(const InstrumentModel& instrument, const StoppedStringModel& stopped,
                    const StringModel& model, const InstrumentState& state, std::size_t s, const Voice& voice,
                    double energy_J) {
    const double zeta_m = std::abs(voice.end.weight) * largest_under(instrument.bridge, state.bridge, s);
    const double force_N =
        bound_of(reach_of(model, {stopped.end_row.data(), model.shape->stride}).extent, energy_J) +
        std::abs(stopped.end_rest_N);
    return 16 * eps * operations(model) * (zeta_m * force_N + voice.end.stiffness_N_per_m * zeta_m * zeta_m);
}

}  // namespace

InstrumentWatch::InstrumentWatch(const InstrumentModel& model, const InstrumentDescription& description,
                                 bool frame_by_frame)
    : model_(model),
      frame_by_frame_(frame_by_frame),
      passive_(is_passive(description.law) || !description.contacts),
      never_penetrates_(description.law == ImpactLaw::Signorini) {
    contacts_.push_back(contact_reaches(model.strings));
    for (const auto& lower : model.lower) contacts_.push_back(contact_reaches(lower));
    std::vector<BodyModeDescription> listening;
    for (const BodyModeDescription& mode : description.body) {
        if (!description.bridge || mode.mass_kg == 0) listening.push_back(mode);
    }
    for (std::size_t i = 0; i < model.body.count; ++i) {
        // v = integral of exp(-sigma t) (cos Wt - sigma/W sin Wt) F: at most omega/(W sigma) times max |F|.
        const double omega = 2 * 3.14159265358979323846 * listening[i].frequency_hz;
        const double sigma = std::min(std::log(1000.0) / listening[i].t60_s, 0.9 * omega);
        const double answer = omega / (std::sqrt(omega * omega - sigma * sigma) * sigma);
        body_left_ += std::abs(model.body.gain_left[i]) * answer;
        body_right_ += std::abs(model.body.gain_right[i]) * answer;
    }
}

InstrumentWatch::Energies InstrumentWatch::energies_of(const InstrumentState& state) const {
    Energies sum;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const InstrumentStringModel& string = string_of(model_, state, s);
        for (const Voice& voice : state.strings[s].voices) {
            if (voice.phase == VoicePhase::Idle) continue;
            const StringModel& model = voice_model(string, voice);
            const double energy_J = energy(model, voice.string);
            const ContactReach& reach = contacts_[state.strings[s].quality_level][s][voice.fret];
            const double gap_size = bound_of(reach.extent, energy_J) + reach.height_m;
            const double of_step = step_rounding(model) * energy_J;
            sum.beyond_rest += energy_J - string.stopped[voice.fret].held_energy_J;
            sum.largest += energy_J;
            sum.rounding += of_step + touch_rounding(model, voice, energy_J);
            sum.impulse += of_step + work_rounding(model, bound_of(reach.impulse, energy_J), gap_size);
            if (model_.bridge.count > 0)
                sum.rounding +=
                    end_rounding(model_, string.stopped[voice.fret], model, state, s, voice, energy_J);
        }
    }
    if (model_.bridge.count == 0) return sum;
    const double body_J = body_energy(model_.bridge, state.bridge);
    sum.beyond_rest += bridge_energy(model_, state);
    sum.largest += body_J;
    sum.rounding += eps * 16 * static_cast<double>(model_.bridge.count) * body_J;
    return sum;
}

void InstrumentWatch::remember_motions(const InstrumentState& state) {
    heard_.resize(state.strings.size());
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        heard_[s].clear();
        for (const Voice& voice : state.strings[s].voices)
            heard_[s].push_back(voice.phase == VoicePhase::Idle ? 0 : voice.bend.active ? 2 : 1);
    }
}

void InstrumentWatch::begin_piece(const InstrumentState& state) {
    before_ = energies_of(state);
    work_before_ = state.work;
    impulses_before_ = contact_counters(state).impulses;
    hand_overs_before_ = state.counters.legato_notes;
    remember_motions(state);
}

void InstrumentWatch::check_energy(const InstrumentState& state, double frames, Judge& judge) {
    if (!passive_) return;
    const Energies now = energies_of(state);
    const double work = total(state.work) - total(work_before_);
    // A hand-over leaves the old motion to fade, with the energy that its work counts as taken: at most all
    // there is, and so on with the next. Bends may work on the old motion and the new one in opposite senses;
    // then the sum of their work says little, but the old motion still sounds.
    const double hand_overs = static_cast<double>(state.counters.legato_notes - hand_overs_before_);
    const double taken =
        std::expm1(hand_overs * std::log(2.0)) * (before_.largest + moved_since(work_before_, state.work));
    const double left_behind = hand_overs > 0 ? std::max(taken, now.largest) : 0.0;
    const double impulses = static_cast<double>(contact_counters(state).impulses - impulses_before_);
    const double allowed = (frames + 2) * (before_.rounding + now.rounding) +
                           impulses * (before_.impulse + now.impulse) +
                           16 * eps * (size_of(state.work) + size_of(work_before_)) + left_behind;
    judge.at_most(Invariant::EnergyRise, now.beyond_rest - before_.beyond_rest - work, allowed, "instrument");
}

/// Bends, hand-overs and changes of quality convert the backward velocity of a string that may be in contact:
/// it then comes from inside an obstacle, and may stay there (docs/engine/stability.md, "What the player
/// changes").
void InstrumentWatch::check_gaps(const InstrumentState& state, Judge& judge) {
    const PlayerWork& work = state.work;
    const Counters counters = contact_counters(state);
    const bool converted = work.bends_J != 0 || work.transfers_J != 0 || work.quality_changes_J != 0;
    if (!never_penetrates_ || converted || counters.truncated_solves > 0) return;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        for (const Voice& voice : state.strings[s].voices) {
            if (voice.phase == VoicePhase::Idle) continue;
            const StringModel& model = string_of(model_, state, s).stopped[voice.fret].string;
            const ContactReach& reach = contacts_[state.strings[s].quality_level][s][voice.fret];
            const double size = bound_of(reach.extent, energy(model, voice.string)) + reach.height_m;
            gap_rounding_m_ = std::max(gap_rounding_m_, gap_rounding_share(model) * size);
        }
    }
    // The energy is known between pieces only; within one it may have been larger.
    check_depth(judge, counters.worst_penetration_m, 10 * gap_rounding_m_, "instrument");
}

void InstrumentWatch::add_bounds(const InstrumentState& state, std::size_t s, std::size_t v,
                                 Bounds& bounds) const {
    const Voice& voice = state.strings[s].voices[v];
    const std::uint8_t heard = v < heard_[s].size() ? heard_[s][v] : 0;
    if (voice.phase == VoicePhase::Idle && heard == 0) return;
    const InstrumentStringModel& string = string_of(model_, state, s);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    // A motion that has ended in this piece was heard in it, at the tension that it had.
    const bool bent = voice.phase == VoicePhase::Idle ? heard == 2 : voice.bend.active;
    const StringModel& model = bent ? voice.bend.model : stopped.string;
    const double energy_J = energy(model, voice.string);
    double signal = 0;
    for (std::size_t i = 0; i < model_.pickups.size(); ++i) {
        const PickupDescription& pickup = model_.pickups[i];
        const Reach reach =
            reach_of(model, {stopped.pickup_rows.data() + i * model.shape->stride, model.shape->stride});
        const bool of_velocity = pickup.quantity == PickupQuantity::Velocity;
        double most = of_velocity ? bound_of(reach.speed, energy_J)
                                  : bound_of(reach.extent, energy_J) + std::abs(stopped.pickup_rest[i]);
        if (of_velocity && pickup.magnet_distance_m > 0) most *= strongest_magnet;
        signal += std::abs(pickup.level) * most;
    }
    bounds.left += std::abs(voice.gains.level * voice.gains.left) * signal;
    bounds.right += std::abs(voice.gains.level * voice.gains.right) * signal;
    if (model_.body.count == 0) return;
    const Reach reach = reach_of(model, {stopped.bridge_row.data(), model.shape->stride});
    bounds.bridge_N += std::abs(voice.gains.level * voice.gains.body) *
                       (bound_of(reach.extent, energy_J) + std::abs(stopped.bridge_rest_N));
}

void InstrumentWatch::check_sound(const InstrumentState& state, const Piece& piece, Judge& judge) {
    if (!frame_by_frame_) return;
    Bounds bounds;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        for (std::size_t v = 0; v < state.strings[s].voices.size(); ++v) add_bounds(state, s, v, bounds);
    }
    largest_bridge_N_ = std::max(largest_bridge_N_, bounds.bridge_N);
    add_moving_body(model_.bridge, state.bridge, bounds.left, bounds.right);
    const auto body = [&](double answer) { return answer > 0 ? answer * largest_bridge_N_ : 0.0; };
    check_output(judge, piece.left, bounds.left + body(body_left_), "left");
    check_output(judge, piece.right, bounds.right + body(body_right_), "right");
}

void InstrumentWatch::end_piece(const InstrumentState& state, const Piece& piece, Judge& judge) {
    check_finite(judge, piece.left, "left");
    check_finite(judge, piece.right, "right");
    check_resets(judge, contact_counters(state).nonfinite_resets, "strings");
    check_resets(judge, state.body.nonfinite_resets, "body");
    check_resets(judge, state.bridge.nonfinite_resets, "bridge");
    check_energy(state, static_cast<double>(piece.left.size()), judge);
    check_gaps(state, judge);
    check_sound(state, piece, judge);
}

}  // namespace jawari::stress
