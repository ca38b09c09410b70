// One output frame: free flight where no contact can close, contact steps elsewhere.
#include "string/frame/frame.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/contact/contact_stage.h"
#include "string/frame/drive.h"
#include "string/frame/near_frame.h"
#include "string/frame/short_frame.h"
#include "string/frame/step.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_sums.h"
#include "string/state/metering.h"

namespace jawari {
namespace {

/// Most frames that a failed contact test grants without a test, while a force acts: a test costs two thirds
/// of solving the frame.
constexpr std::uint32_t longest_backoff = 7;

/// The frame step by step, evaluating the near contacts. Returns true if impulses happened.
bool step_through(const StringModel& model, StringState& state) {
    const std::uint64_t impulses_before = state.counters.impulses;
    place_gaps(model, state);
    for (state.steps_left = model.shape->steps_per_frame; state.steps_left > 0;)
        step_near_contacts(model, state);
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

/// H can only rise in frames with contact or excitation.
void meter_highest(const StringModel& model, StringState& state) {
    if (state.metering == Metering::Frame) meter_frame(model, state);
}

bool is_finite(const StringState& state) {
    const ContactState& contact = state.contact;
    const bool gaps_are_finite = std::all_of(contact.near.begin(), contact.near.end(),
                                             [&](std::uint32_t c) { return std::isfinite(contact.gap[c]); });
    return gaps_are_finite && kernels::all_finite(state.active_modes, state.displacement.data()) &&
           kernels::all_finite(state.active_modes, state.velocity.data());
}

/// Free flight, already in displacement_flown and velocity_flown, or free stepping where flight is not
/// allowed.
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
    advance_bounds(model, state);
    if (is_excited(state)) meter_highest(model, state);
}

/// Solves all contacts side by side. Returns false if the state has become non-finite.
bool pass_short(const StringModel& model, StringState& state) {
    const bool finite = solve_short_frame(model, state);
    adopt_flight(state);
    state.certificate.validity.age += 1;
    meter_highest(model, state);
    return finite;
}

/// Solves the near contacts. The flight that the test has computed stays valid if none of them closes.
/// Returns false if the state has become non-finite.
bool pass_near(const StringModel& model, StringState& state, FrameKind kind) {
    if (!evaluates_near_alone(state)) choose_all_contacts(model, state);
    const std::uint64_t impulses_before = state.counters.impulses;
    NearOutcome outcome = NearOutcome::Crowded;
    if (kind == FrameKind::NearInContactSpace) outcome = solve_near_frame(model, state);
    const bool in_contact_space = outcome != NearOutcome::Crowded;
    const bool struck = in_contact_space ? outcome == NearOutcome::Struck : step_through(model, state);
    state.near_frame.crowded = is_crowded(model, state, state.counters.impulses - impulses_before);
    state.counters.near_frames += 1;
    if (in_contact_space || !struck) adopt_flight(state);
    advance_bounds(model, state);
    state.certificate.struck = struck;
    if (struck) note_stepped_gaps(model, state);
    meter_highest(model, state);
    return is_finite(state);
}

/// Steps all contacts over all modes. The bounds do not follow. Returns false if the state has become
/// non-finite.
bool pass_uniformly(const StringModel& model, StringState& state) {
    choose_all_contacts(model, state);
    state.active_modes = model.shape->stride;
    step_through(model, state);
    forget_bounds(state);
    meter_highest(model, state);
    return is_finite(state);
}

void forget_frame_impulses(StringState& state) {
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
}

/// Puts a string that is not finite to rest.
void start_again(const StringModel& model, StringState& state) {
    put_to_rest(model, state);
    state.counters.nonfinite_resets += 1;
}

/// Ends a plan that an excitation or a moving obstacle has overtaken, wakes the string and what a force is
/// about to move, and forgets the last frame's impulses.
void begin_unplanned_frame(const StringModel& model, StringState& state) {
    if (planned_frames(state) > 0) forget_bounds(state);
    if (state.asleep) notice_change(model, state);
    forget_frame_impulses(state);
    wake_modes(state, state.excitation.modes);
}

/// Makes the bounds hold for the coming frame, which may put a faded string to sleep.
void freshen_bounds(const StringModel& model, StringState& state) {
    // A short frame before the coming one has computed all gaps.
    if (state.short_frame.gaps_at == state.frame) note_short_frame(model, state);
    if (needs_refresh(state)) refresh_bounds(model, state);
}

/// Whether a contact may close in the coming frame, which is flown for that; NotAsked if the string has
/// fallen asleep. Nothing if the state is not finite.
std::optional<BroadPhaseAnswer> test_frame(const StringModel& model, StringState& state) {
    freshen_bounds(model, state);
    if (state.asleep) return BroadPhaseAnswer::NotAsked;
    if (!fly(model, state)) return std::nullopt;
    const bool may_close = !state.certificate.clear.valid && choose_near_contacts(model, state);
    return may_close ? BroadPhaseAnswer::MayClose : BroadPhaseAnswer::Open;
}

/// A test that fails under forces grants frames without one, the more the longer that lasts; one that
/// succeeds ends that.
void update_backoff(StringState& state, FrameKind kind, BroadPhaseAnswer answer) {
    Backoff& backoff = state.certificate.backoff;
    if (kind == FrameKind::Checked) backoff.granted = 0;
    if (kind != FrameKind::Short || !is_excited(state)) return;
    if (answer == BroadPhaseAnswer::MayClose) {
        backoff.granted = std::min(2 * backoff.granted + 1, longest_backoff);
        backoff.left = backoff.granted;
    } else if (backoff.left > 0) {
        // The frame is solved without a contact test, so its forces are not added to the bounds.
        backoff.left -= 1;
        state.certificate.validity.outdated = true;
    }
}

/// The kind of the coming frame, which is tested for contact if the choice depends on that. Nothing if the
/// state is not finite.
std::optional<FrameKind> find_frame_kind(const StringModel& model, StringState& state,
                                         BroadPhaseAnswer answer) {
    std::optional<FrameKind> kind = choose_frame_kind(model, state, answer);
    if (!kind) {
        const std::optional<BroadPhaseAnswer> tested = test_frame(model, state);
        if (!tested) return std::nullopt;
        answer = *tested;
        kind = choose_frame_kind(model, state, answer);
        JAWARI_ASSERT(kind.has_value());
    }
    update_backoff(state, *kind, answer);
    return kind;
}

/// Counts a frame that is neither slept through nor planned.
void end_frame(const StringModel& model, StringState& state, bool finite) {
    if (!finite) start_again(model, state);
    state.frame += 1;
}

}  // namespace

BroadPhaseAnswer plan_frames(const StringModel& model, StringState& state, double reserve_m) JAWARI_REALTIME {
    const bool may_fly = state.skipping.flight && !is_excited(state) && !steps_uniformly(model, state);
    if (state.asleep || !may_fly) return BroadPhaseAnswer::NotAsked;
    if (planned_frames(state) > 0) return BroadPhaseAnswer::Planned;
    if (state.certificate.struck && solves_short_frames(model, state)) return BroadPhaseAnswer::NotAsked;
    freshen_bounds(model, state);
    if (state.asleep) return BroadPhaseAnswer::NotAsked;
    if (state.certificate.validity.direct) return BroadPhaseAnswer::PlanFailed;
    state.certificate.bounds.kicks.overtones += reserve_m;
    plan_free_frames(model, state);
    return planned_frames(state) > 0 ? BroadPhaseAnswer::Planned : BroadPhaseAnswer::PlanFailed;
}

void fly_ahead(const StringModel& model, StringState& state, std::span<const Reading> readings, ReadAt when,
               std::size_t first, std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(frames >= 1 && frames <= planned_frames(state));
    JAWARI_ASSERT(!state.asleep && !is_excited(state));
    forget_frame_impulses(state);
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
    state.certificate.struck = false;
    state.counters.steps += frames * model.shape->steps_per_frame;
    state.counters.flown_frames += frames;
    state.frame += frames;
    if (finite) return;
    start_again(model, state);
    for (const Reading& reading : readings) std::fill_n(reading.out + first, frames, 0.0);
}

bool flies_clear(const StringModel& model, StringState& state, double strength_N,
                 double root) JAWARI_REALTIME {
    if (!state.skipping.flight || state.asleep || !model.shape->drives.spans.empty() ||
        steps_uniformly(model, state))
        return false;
    ExcitationState& excitation = state.excitation;
    JAWARI_ASSERT(!excitation.active);
    excitation.active = true;
    excitation.passive = false;
    excitation.strength_N = strength_N;
    excitation.root = root;
    if (planned_frames(state) > 0) forget_bounds(state);
    freshen_bounds(model, state);
    const bool clear = state.certificate.clear.valid && !needs_refresh(state);
    excitation.active = false;
    excitation.root = -1;
    return clear;
}

bool flies_always(const StringModel& model, const StringState& state) JAWARI_REALTIME {
    return model.shape->contact_count == 0 && model.shape->drives.spans.empty() && state.skipping.flight &&
           !steps_uniformly(model, state);
}

void cross_touched_frame(const StringModel& model, StringState& state, kernels::TouchedFlight& flight,
                         std::size_t modes, bool passive, const FrameBounds& bounds) JAWARI_REALTIME {
    JAWARI_ASSERT((flies_always(model, state) || bounds.root >= 0) && !is_excited(state));
    ExcitationState& excitation = state.excitation;
    excitation.strength_N = bounds.strength_N;
    for (std::size_t i = 0; bounds.root < 0 && i < flight.count; ++i)
        excitation.strength_N += std::abs(flight.force_N[i]);
    excitation.root = bounds.root;
    excitation.active = true;
    excitation.passive = passive;
    excitation.modes = modes;
    begin_unplanned_frame(model, state);
    freshen_bounds(model, state);
    flight.modes = state.active_modes;
    flight.lag = model.shape->step_s / 2;
    flight.flight = &model.tuning.flight;
    flight.q = state.displacement.data();
    flight.v = state.velocity.data();
    flight.q_out = state.displacement_flown.data();
    flight.v_out = state.velocity_flown.data();
    const bool finite = kernels::fly_touched(flight);
    pass_freely(model, state);
    excitation.active = false;  // nothing was written to its modes
    excitation.passive = false;
    excitation.root = -1;
    excitation.modes = 0;
    excitation.elapsed = 0;
    if (bounds.root >= 0) state.certificate.clear.root += bounds.root;
    end_frame(model, state, finite);
}

void cross_frame(const StringModel& model, StringState& state, BroadPhaseAnswer answer) JAWARI_REALTIME {
    const bool planned = answer == BroadPhaseAnswer::Planned;
    if (!planned && !sleeps_on(state)) begin_unplanned_frame(model, state);
    const std::optional<FrameKind> kind = find_frame_kind(model, state, answer);
    if (!kind) {
        end_frame(model, state, false);
        return;
    }
    switch (*kind) {
        case FrameKind::Asleep:
            pass_asleep(model, state, 1);
            break;
        case FrameKind::Planned:
            fly_ahead(model, state, {}, ReadAt::Start, 0, 1);
            break;
        case FrameKind::Checked:
            pass_freely(model, state);
            end_frame(model, state, true);
            break;
        case FrameKind::NearInContactSpace:
        case FrameKind::NearStepped:
            end_frame(model, state, pass_near(model, state, *kind));
            break;
        case FrameKind::Short:
            end_frame(model, state, pass_short(model, state));
            break;
        case FrameKind::Uniform:
            end_frame(model, state, pass_uniformly(model, state));
            break;
    }
}

void advance_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(state.displacement.size() >= model.shape->stride);
    drive_frame(model, state);
    cross_frame(model, state, plan_frames(model, state));
}

}  // namespace jawari
