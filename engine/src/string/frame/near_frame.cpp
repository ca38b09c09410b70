#include "string/frame/near_frame.h"

#include <algorithm>
#include <array>

#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/broad_phase/pushed_contacts.h"
#include "string/contact/contact_stage.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_run.h"
#include "string/kernels/mode_sums.h"
#include "string/model/contact_response.h"

namespace jawari {
namespace {

/// force_rows and force_impulses <- the excitation of the coming frame, for unit mobility's run over modes.
void drive_by_excitation(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    const ExcitationState& excitation = state.excitation;
    std::fill(near.force_rows.begin(), near.force_rows.end(), 0.0);
    kernels::add_impulse(model.shape->stride, 1.0, model.shape->mobility.data(), excitation.held.data(),
                         near.force_rows.data());
    kernels::add_impulse(model.shape->stride, 1.0, model.shape->mobility.data(), excitation.ramp.data(),
                         near.force_rows.data() + model.shape->stride);
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        near.force_impulses[n] = model.shape->step_s;
        near.force_impulses[model.shape->response_stride + n] =
            model.shape->step_s * static_cast<double>(excitation.elapsed + n);
    }
}

/// rates_free <- S v of free flight at each step, for the near contacts from `first` on.
void run_free(const StringModel& model, StringState& state, std::size_t first) {
    NearState& near = state.near_frame;
    const ContactState& contact = state.contact;
    std::copy(state.displacement.begin(), state.displacement.end(), near.displacement.begin());
    std::copy(state.velocity.begin(), state.velocity.end(), near.velocity.begin());
    kernels::ModeRun run = kernels::frame_run(model);
    run.modes = state.active_modes;
    for (std::size_t i = first; i < contact.near_count; ++i) {
        near.rows[i] = model.shape->contact_rows.data() + contact.near[i] * model.shape->stride;
    }
    run.probes = contact.near_count - first;
    run.probe_rows = near.rows.data() + first;
    run.rates = near.rates_free.data() + first * model.shape->response_stride;
    run.rate_stride = model.shape->response_stride;
    run.lanes = near.lanes.data();
    run.q = near.displacement.data();
    run.v = near.velocity.data();
    const std::array<const double*, 2> force_rows{near.force_rows.data(),
                                                  near.force_rows.data() + model.shape->stride};
    if (is_excited(state)) {
        drive_by_excitation(model, state);
        run.drivers = state.excitation.ramps ? 2 : 1;
        run.driver_rows = force_rows.data();
        run.impulses = near.force_impulses.data();
        run.impulse_stride = model.shape->response_stride;
    }
    kernels::run_modes(run);
}

/// What must be as it was if the frame is solved once more with more contacts.
void save_start(StringState& state) {
    NearState& near = state.near_frame;
    near.gap = state.contact.gap;
    near.gap_before = state.contact.gap_before;
    near.impulse = state.contact.impulse;
    near.left_open = state.contact.left_open;
    near.counters = state.counters;
}

void restore_start(StringState& state) {
    const NearState& near = state.near_frame;
    state.contact.gap = near.gap;
    state.contact.gap_before = near.gap_before;
    state.contact.impulse = near.impulse;
    state.contact.left_open = near.left_open;
    state.counters = near.counters;
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
}

/// The row of NearState::impulses that collects the impulses of a contact.
double* impulses_of(const StringModel& model, NearState& near, std::uint32_t contact) {
    const auto end = near.struck.begin() + static_cast<std::ptrdiff_t>(near.struck_count);
    const auto found = std::find(near.struck.begin(), end, contact);
    const auto slot = static_cast<std::size_t>(found - near.struck.begin());
    double* impulses = near.impulses.data() + slot * model.shape->response_stride;
    if (found == end) {
        near.struck[near.struck_count++] = contact;
        std::fill_n(impulses, model.shape->response_stride, 0.0);
    }
    return impulses;
}

/// Impulses of the step that are positive, kept for the modes.
void keep_impulses(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto struck = contact.candidates[i];
        if (contact.impulse[struck] > 0)
            impulses_of(model, state.near_frame, struck)[n] = contact.impulse[struck];
    }
}

/// Adds what the step's impulses do to the rates of all later steps, over time for each near contact.
void spread_over_time(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto struck = contact.candidates[i];
        const double impulse = contact.impulse[struck];
        if (impulse <= 0) continue;
        kernels::spread_impulse(model, {contact.near.data(), contact.near_count}, {struck, impulse, n},
                                state.near_frame.rates.data());
    }
}

/// The same over all contacts for each later step.
void spread_over_contacts(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    const std::size_t stride = model.shape->contact_stride;
    const std::size_t step = model.shape->contact_count * stride;
    for (std::size_t later = n + 1; later < model.shape->steps_per_frame; ++later) {
        kernels::add_rows(contact.candidates.data(), contact.candidate_count, contact.impulse.data(), stride,
                          stride, model.tuning.step_response.data() + (later - n) * step,
                          state.near_frame.rates.data() + later * stride);
    }
}

/// gap_free <- the gaps at the end of step n without its impulses.
void predict_near_gaps(const StringModel& model, StringState& state, std::size_t n) {
    ContactState& contact = state.contact;
    const AlignedVector<double>& rates = state.near_frame.rates;
    const bool by_step = !model.tuning.step_response.empty();
    for (std::size_t i = 0; i < contact.near_count; ++i) {
        const auto c = contact.near[i];
        const double rate = by_step ? rates[n * model.shape->contact_stride + c]
                                    : rates[i * model.shape->response_stride + n];
        contact.gap_free[c] = contact.gap[c] + model.shape->step_s * rate;
    }
}

/// rates <- rates_free, in the order in which impulses spread.
void begin_rates(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    const ContactState& contact = state.contact;
    if (model.tuning.step_response.empty()) {
        std::copy_n(near.rates_free.begin(), contact.near_count * model.shape->response_stride,
                    near.rates.begin());
        return;
    }
    for (std::size_t i = 0; i < contact.near_count; ++i) {
        for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n)
            near.rates[n * model.shape->contact_stride + contact.near[i]] =
                near.rates_free[i * model.shape->response_stride + n];
    }
}

/// The causal loop: one small complementarity problem a step.
void solve_in_contact_space(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    begin_rates(model, state);
    near.struck_count = 0;
    near.first_impulse = model.shape->steps_per_frame;
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        predict_near_gaps(model, state, n);
        if (select_candidates(model, state)) {
            solve_impulses(model, state);
            near.first_impulse = std::min(near.first_impulse, n);
            keep_impulses(model, state, n);
            if (model.tuning.step_response.empty()) {
                spread_over_time(model, state, n);
            } else {
                spread_over_contacts(model, state, n);
            }
        } else {
            clear_impulses(state);
        }
        accept_gaps(model, state);
    }
}

/// The frame's end receives the response of the modes to the impulses, run for unit mobility and scaled at
/// the end.
void run_impulses(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    state.active_modes = model.shape->stride;
    std::fill(near.displacement.begin(), near.displacement.end(), 0.0);
    std::fill(near.velocity.begin(), near.velocity.end(), 0.0);
    kernels::ModeRun run = kernels::frame_run(model);
    for (std::size_t i = 0; i < near.struck_count; ++i) {
        near.rows[i] = model.shape->contact_rows.data() + near.struck[i] * model.shape->stride;
    }
    run.drivers = near.struck_count;
    run.driver_rows = near.rows.data();
    run.impulses = near.impulses.data() + near.first_impulse;
    run.impulse_stride = model.shape->response_stride;
    run.steps = model.shape->steps_per_frame - near.first_impulse;
    run.q = near.displacement.data();
    run.v = near.velocity.data();
    kernels::run_modes(run);
    kernels::add_impulse(model.shape->stride, 1.0, model.shape->mobility.data(), near.displacement.data(),
                         state.displacement_flown.data());
    kernels::add_impulse(model.shape->stride, 1.0, model.shape->mobility.data(), near.velocity.data(),
                         state.velocity_flown.data());
}

}  // namespace

bool solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    std::size_t known = 0;
    place_gaps(model, state);
    do {
        run_free(model, state, known);
        known = contact.near_count;
        save_start(state);
        solve_in_contact_space(model, state);
        if (!admit_pushed_in_frame(model, state)) break;
        restore_start(state);
        place_gaps(model, state);
    } while (true);
    state.counters.steps += model.shape->steps_per_frame;
    state.excitation.elapsed += model.shape->steps_per_frame;
    if (state.near_frame.struck_count == 0) return false;
    state.certificate.outdated = true;
    run_impulses(model, state);
    return true;
}

}  // namespace jawari
