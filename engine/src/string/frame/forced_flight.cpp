#include "string/frame/forced_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "string/broad_phase/gap_certificate.h"
#include "string/frame/frame.h"
#include "string/kernels/mode_sums.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// A flight of fewer frames costs more than the frames one by one.
constexpr std::size_t shortest_flight = 4;

bool knows_reach(const StringModel& model) {
    return model.shape->certificate.reach.size() == model.shape->contact_count && lookahead(model) == 0;
}

/// What leaves a clear string clear: nine tenths of the way to each contact are for its own motion and for
/// what changes of the force add to it, and a tenth is for what bends it at rest (share_of_forces).
double travel_of_clear(const StringModel& model, const StringState& state, const ForceShape& shape,
                       double now) {
    const ClearState& clear = state.certificate.clear;
    const double for_bends_m = clear.force_N * model.tuning.certificate.force_reach;
    const double for_motion_m = (1 - share_of_forces) / share_of_forces * for_bends_m;
    const double left = 1 - clear.root / std::sqrt(clear.energy_J);
    return std::min(for_motion_m * left / shape.sway_m, for_bends_m / shape.bend_m - std::abs(now));
}

void swap_flown(StringState& state) {
    state.displacement.swap(state.displacement_flown);
    state.velocity.swap(state.velocity_flown);
}

/// plan_frames() of the motion about the rest under `now`.
BroadPhaseAnswer plan_about_rest(const StringModel& model, StringState& state, const ForceShape& shape,
                                 double now, double reserve_m) {
    std::copy(state.displacement.begin(), state.displacement.end(), state.displacement_flown.begin());
    kernels::add_scaled(model.shape->stride, -now, shape.still, state.displacement_flown.data());
    std::copy(state.velocity.begin(), state.velocity.end(), state.velocity_flown.begin());
    swap_flown(state);
    const BroadPhaseAnswer answer = plan_frames(model, state, reserve_m);
    swap_flown(state);
    return answer;
}

/// The flight that the broad phase grants: the string is clear, or all gaps have room for the expected
/// travel.
ForcedFlight granted_flight(const StringModel& model, StringState& state, const ForceShape& shape, double now,
                            std::size_t frames, double expected) {
    const CertificateState& certificate = state.certificate;
    if (!knows_reach(model) || certificate.struck) return {};
    state.certificate.validity.outdated = true;
    const double reserve_m =
        bound_safety * ((shape.sway_m + shape.bend_m) * expected + 2 * shape.bend_m * std::abs(now));
    const BroadPhaseAnswer answer = plan_about_rest(model, state, shape, now, reserve_m);
    ForcedFlight flight;
    if (answer == BroadPhaseAnswer::Planned && certificate.clear.valid) {
        flight = {frames, travel_of_clear(model, state, shape, now)};
    } else if (answer == BroadPhaseAnswer::Planned) {
        flight = {std::min<std::size_t>(frames, planned_frames(state)), expected};
    }
    const bool is_long = flight.frames >= std::min(frames, shortest_flight) && flight.travel > 0;
    if (is_long) return flight;
    if (!state.asleep) forget_bounds(state);  // they are not those of the string as it is
    return {};
}

}  // namespace

ForcedFlight begin_forced_flight(const StringModel& model, StringState& state, const ForceShape& shape,
                                 double now, std::size_t frames, double expected) JAWARI_REALTIME {
    if (state.metering != Metering::Off || frames < 2) return {};
    clear_excitation(state);
    if (planned_frames(state) > 0) forget_bounds(state);
    ForcedFlight flight{frames, std::numeric_limits<double>::infinity()};
    if (flies_always(model, state)) {
        if (state.asleep) notice_change(model, state);
    } else if (state.leaves_obstacles) {
        if (plan_frames(model, state) != BroadPhaseAnswer::Planned) return {};
    } else {
        flight = granted_flight(model, state, shape, now, frames, expected);
    }
    if (flight.frames == 0) return flight;
    wake_modes(state, shape.modes);
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
    state.certificate.struck = false;
    state.certificate.validity.odometers_at_frame = state.frame + flight.frames;
    return flight;
}

void end_forced_flight(const StringModel& model, StringState& state, bool finite) JAWARI_REALTIME {
    CertificateState& certificate = state.certificate;
    const bool is_cut = planned_frames(state) > 0;
    certificate.validity.odometers_at_frame = state.frame;
    certificate.validity.outdated = true;
    if (!finite) {
        put_to_rest(model, state);
        state.counters.nonfinite_resets += 1;
        return;
    }
    if (model.shape->contact_count == 0 || state.leaves_obstacles || certificate.clear.valid) return;
    if (is_cut) {  // the gaps are known where the flight would have ended
        forget_bounds(state);
        return;
    }
    for (double& odometer : certificate.bounds.group_odometer) odometer += certificate.bounds.kicks.overtones;
}

}  // namespace jawari
