// One output frame: what can be flown is flown, what may touch is stepped.
#include <algorithm>
#include <cmath>

#include "jawari/scene/render.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/contact/contact_stage.h"
#include "string/frame/frame.h"
#include "string/frame/near_frame.h"
#include "string/frame/short_frame.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_sums.h"
#include "string/state/metering.h"

namespace jawari {
namespace {

/// Most frames under forces that are solved without looking whether contacts may close, after looks that were
/// in vain: one costs two thirds of solving the frame.
constexpr std::uint32_t longest_presumption = 7;

bool may_skip(const StringModel& model, const StringState& state) {
    const Skipping& skipping = state.skipping;
    const bool any =
        skipping.flight || skipping.certificate || skipping.near || skipping.lazy || skipping.sleep;
    return any && model.shape->scheme == Scheme::Exact && state.metering != Metering::Step;
}

/// Whether frames with contacts that may close leave out all other contacts.
bool evaluates_near_alone(const StringState& state) {
    return state.skipping.near && state.steps_near;
}

/// The frame step by step, evaluating the near contacts. Returns true if impulses happened.
bool step_through(const StringModel& model, StringState& state) {
    const std::uint64_t impulses_before = state.counters.impulses;
    place_gaps(model, state);
    for (state.steps_left = model.shape->steps_per_frame; state.steps_left > 0;) step(model, state);
    return state.counters.impulses != impulses_before;
}

/// displacement_flown, velocity_flown <- the frame's end without contact. Returns false if it is not finite.
bool fly(const StringModel& model, StringState& state) {
    const ExcitationState& excitation = state.excitation;
    const double *q = state.displacement.data(), *v = state.velocity.data();
    double *q_end = state.displacement_flown.data(), *v_end = state.velocity_flown.data();
    if (excitation.ramps) {
        kernels::fly(state.active_modes, model.tuning.flight, q, v, q_end, v_end);
        return kernels::add_force_response(state.active_modes, model.tuning.flight, excitation.held.data(),
                                           excitation.ramp.data(), static_cast<double>(excitation.elapsed),
                                           q_end, v_end);
    }
    return kernels::fly_forced(state.active_modes, excitation.modes, model.tuning.flight,
                               excitation.held.data(), q, v, q_end, v_end);
}

void adopt_flight(StringState& state) {
    state.displacement.swap(state.displacement_flown);
    state.velocity.swap(state.velocity_flown);
}

/// The frame without any contact in reach.
void pass_freely(const StringModel& model, StringState& state) {
    state.certificate.struck = false;
    if (state.skipping.flight) {
        adopt_flight(state);
        state.excitation.elapsed += model.shape->steps_per_frame;
        state.counters.steps += model.shape->steps_per_frame;
        state.counters.flown_frames += 1;
    } else {
        step_through(model, state);
    }
}

/// The frame with all contacts, which is cheap where frames are short. Returns false if the state has become
/// non-finite.
bool pass_short(const StringModel& model, StringState& state) {
    const bool finite = solve_short_frame(model, state);
    adopt_flight(state);
    state.certificate.age += 1;
    return finite;
}

/// Whether frames with contact are solved as short ones.
bool goes_short(const StringModel& model, const StringState& state) {
    return evaluates_near_alone(state) && has_short_frames(model);
}

/// A look under forces has found contacts that may close: the next look is the later, the longer that lasts.
void presume_near(StringState& state) {
    CertificateState& bounds = state.certificate;
    bounds.presumption = std::min(2 * bounds.presumption + 1, longest_presumption);
    bounds.presumed_near = bounds.presumption;
}

/// The coming frame has contacts that may close without anybody having looked: nobody has added up what its
/// forces do to the bounds.
void presume_once(StringState& state) {
    state.certificate.presumed_near -= 1;
    state.certificate.outdated = true;
}

/// What a short frame before the coming one knows of the gaps.
void take_up_gaps(const StringModel& model, StringState& state) {
    if (state.short_frame.gaps_at == state.frame) note_short_frame(model, state);
}

/// The frame with contacts that may close. What was flown stays valid if none did.
void pass_near(const StringModel& model, StringState& state) {
    const bool in_contact_space = evaluates_near_alone(state) && !model.tuning.response.empty();
    if (!evaluates_near_alone(state)) choose_all_contacts(model, state);
    const bool struck = in_contact_space ? solve_near_frame(model, state) : step_through(model, state);
    state.counters.near_frames += 1;
    if (in_contact_space || !struck) adopt_flight(state);
    advance_bounds(model, state);
    state.certificate.struck = struck;
    if (struck) note_stepped_gaps(model, state);
}

/// Everything is stepped; nothing is known of the gaps afterwards.
void pass_uniformly(const StringModel& model, StringState& state) {
    choose_all_contacts(model, state);
    state.active_modes = model.shape->stride;
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

/// A string that is not finite restarts at rest.
void start_again(const StringModel& model, StringState& state) {
    put_to_rest(model, state);
    state.counters.nonfinite_resets += 1;
}

/// Whether every contact must be evaluated at every step.
bool is_uniform(const StringModel& model, const StringState& state) {
    return !may_skip(model, state) || state.contact.moving_count > 0 ||
           (!state.skipping.certificate && model.shape->contact_count > 0);
}

/// Returns false if the state has become non-finite.
bool advance_awake(const StringModel& model, StringState& state) {
    if (is_uniform(model, state)) {
        pass_uniformly(model, state);
        meter_highest(model, state);
        return is_finite(state);
    }
    wake_excited_modes(state);
    const bool excited = is_excited(state);
    const bool plan_failed = !excited && state.skipping.flight;
    const bool presumed = excited && state.certificate.presumed_near > 0;
    if (goes_short(model, state) && (state.certificate.struck || plan_failed || presumed)) {
        if (presumed) presume_once(state);
        const bool finite = pass_short(model, state);
        meter_highest(model, state);
        return finite;
    }
    take_up_gaps(model, state);
    if (needs_refresh(state)) refresh_bounds(model, state);
    if (state.asleep) return true;
    if (!fly(model, state)) return false;
    if (!state.certificate.clear && choose_near_contacts(model, state)) {
        bool finite = true;
        if (goes_short(model, state)) {
            finite = pass_short(model, state);
            if (excited) presume_near(state);
        } else {
            pass_near(model, state);
            finite = is_finite(state);
        }
        meter_highest(model, state);
        return finite;
    }
    state.certificate.presumption = 0;
    pass_freely(model, state);
    advance_bounds(model, state);
    if (excited) meter_highest(model, state);
    return true;
}

/// Wakes a string that is about to be moved, and forgets the last frame's impulses.
void begin_frame(const StringModel& model, StringState& state) {
    if (state.asleep) notice_change(model, state);
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
}

}  // namespace

std::size_t frames_to_fly(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (state.asleep || is_uniform(model, state) || is_excited(state) || !state.skipping.flight) return 0;
    CertificateState& bounds = state.certificate;
    if (bounds.free_frames == 0) {
        if (bounds.struck && goes_short(model, state)) return 0;
        take_up_gaps(model, state);
        if (needs_refresh(state)) refresh_bounds(model, state);
        if (state.asleep || bounds.direct) return 0;
        plan_free_frames(model, state);
    }
    return bounds.free_frames;
}

void fly_ahead(const StringModel& model, StringState& state, std::span<const Reading> readings, ReadAt when,
               std::size_t first, std::size_t frames) JAWARI_REALTIME {
    begin_frame(model, state);
    kernels::FlightRun run;
    run.modes = state.active_modes;
    run.frames = frames;
    run.flight = &model.tuning.flight;
    run.q = state.displacement.data();
    run.v = state.velocity.data();
    run.readings = readings;
    run.when = when;
    run.first = first;
    const bool finite = kernels::fly_frames(run);
    state.certificate.free_frames -= frames;
    state.certificate.struck = false;
    state.counters.steps += frames * model.shape->steps_per_frame;
    state.counters.flown_frames += frames;
    state.frame += frames;
    if (finite) return;
    start_again(model, state);
    for (const Reading& reading : readings) std::fill_n(reading.out + first, frames, 0.0);
}

void advance_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (sleeps_on(state)) {
        pass_asleep(model, state, 1);
    } else if (frames_to_fly(model, state) > 0) {
        fly_ahead(model, state, {}, ReadAt::Start, 0, 1);
    } else {
        look_at_frame(model, state);
    }
}

void look_at_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (sleeps_on(state)) {  // just fallen asleep
        pass_asleep(model, state, 1);
        return;
    }
    if (state.certificate.free_frames > 0) forget_bounds(state);  // an excitation ends what was planned
    begin_frame(model, state);
    if (!advance_awake(model, state)) start_again(model, state);
    if (state.asleep) {  // just now
        pass_asleep(model, state, 1);
    } else {
        state.frame += 1;
    }
}

}  // namespace jawari
