// One output frame: what can be flown is flown, what may touch is stepped.
#include <algorithm>
#include <cmath>

#include "certificate.h"
#include "contact.h"
#include "frame.h"
#include "jawari/render.h"
#include "kernels.h"
#include "metering.h"
#include "near_frame.h"
#include "skipping_kernels.h"

namespace jawari {
namespace {

bool may_skip(const StringModel& model, const StringState& state) {
    const Skipping& skipping = state.skipping;
    const bool any =
        skipping.flight || skipping.certificate || skipping.near || skipping.lazy || skipping.sleep;
    return any && model.scheme == Scheme::Exact && state.metering != Metering::Step;
}

/// The frame step by step, evaluating the near contacts. Returns true if impulses happened.
bool step_through(const StringModel& model, StringState& state) {
    const std::uint64_t impulses_before = state.counters.impulses;
    place_gaps(model, state);
    for (state.steps_left = model.steps_per_frame; state.steps_left > 0;) step(model, state);
    return state.counters.impulses != impulses_before;
}

/// displacement_flown, velocity_flown <- the frame's end without contact. Returns false if it is not finite.
bool fly(const StringModel& model, StringState& state) {
    const bool finite =
        kernels::fly(state.active_modes, model.flight, state.displacement.data(), state.velocity.data(),
                     state.displacement_flown.data(), state.velocity_flown.data());
    if (!is_excited(state)) return finite;
    const ExcitationState& excitation = state.excitation;
    return kernels::add_force_response(state.active_modes, model.flight, excitation.held.data(),
                                       excitation.ramps ? excitation.ramp.data() : nullptr,
                                       static_cast<double>(excitation.elapsed),
                                       state.displacement_flown.data(), state.velocity_flown.data()) &&
           finite;
}

void adopt_flight(StringState& state) {
    state.displacement.swap(state.displacement_flown);
    state.velocity.swap(state.velocity_flown);
}

/// The frame without any contact in reach.
void pass_freely(const StringModel& model, StringState& state) {
    if (state.skipping.flight) {
        adopt_flight(state);
        state.excitation.elapsed += model.steps_per_frame;
        state.counters.steps += model.steps_per_frame;
        state.counters.flown_frames += 1;
    } else {
        step_through(model, state);
    }
}

/// The frame with contacts that may close. What was flown stays valid if none did.
void pass_near(const StringModel& model, StringState& state) {
    const bool in_contact_space = state.skipping.near && !model.response.empty();
    if (!state.skipping.near) choose_all_contacts(model, state);
    const bool struck = in_contact_space ? solve_near_frame(model, state) : step_through(model, state);
    state.counters.near_frames += 1;
    if (in_contact_space || !struck) adopt_flight(state);
    advance_bounds(model, state);
    if (struck) note_stepped_gaps(model, state);
}

/// Everything is stepped; nothing is known of the gaps afterwards.
void pass_uniformly(const StringModel& model, StringState& state) {
    choose_all_contacts(model, state);
    state.active_modes = model.stride;
    step_through(model, state);
    forget_bounds(state);
}

/// H can only rise in frames with contact or excitation.
void meter_highest(const StringModel& model, StringState& state) {
    if (state.metering == Metering::Frame) meter_frame(model, state);
}

bool is_finite(const StringState& state) {
    const ContactState& contact = state.contact;
    const bool gaps_are_finite = std::all_of(
        contact.near.begin(), contact.near.begin() + static_cast<std::ptrdiff_t>(contact.near_count),
        [&](std::uint32_t c) { return std::isfinite(contact.gap[c]); });
    return gaps_are_finite && kernels::all_finite(state.active_modes, state.displacement.data()) &&
           kernels::all_finite(state.active_modes, state.velocity.data());
}

/// Returns false if the state has become non-finite.
bool advance_awake(const StringModel& model, StringState& state) {
    const bool moving = state.contact.moving_count > 0;
    if (!may_skip(model, state) || moving || (!state.skipping.certificate && model.contact_count > 0)) {
        pass_uniformly(model, state);
        meter_highest(model, state);
        return is_finite(state);
    }
    if (needs_refresh(state)) refresh_bounds(model, state);
    if (state.asleep) return true;
    if (!fly(model, state)) return false;
    const bool excited = is_excited(state);
    if (choose_near_contacts(model, state)) {
        pass_near(model, state);
        meter_highest(model, state);
        return is_finite(state);
    }
    pass_freely(model, state);
    advance_bounds(model, state);
    if (excited) meter_highest(model, state);
    return true;
}

}  // namespace

void advance_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (sleeps_on(state)) {
        pass_asleep(model, state, 1);
        return;
    }
    if (state.asleep) notice_change(model, state);
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
    if (!advance_awake(model, state)) {
        put_to_rest(model, state);
        state.counters.nonfinite_resets += 1;
    }
    if (state.asleep) {  // just now
        pass_asleep(model, state, 1);
    } else {
        state.frame += 1;
    }
}

}  // namespace jawari
