#include "string/frame/near_frame.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
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

/// What beginning a row of responses costs, in its operations.
constexpr double row_overhead = 16;

/// force_rows and force_impulses <- the excitation of the coming frame, for a run over modes of unit
/// mobility.
void drive_by_excitation(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    const ExcitationState& excitation = state.excitation;
    const std::size_t modes = model.shape->stride;
    std::fill_n(near.force_rows.begin(), modes, 0.0);
    kernels::add_impulse(modes, 1.0, model.shape->mobility.data(), excitation.held.data(),
                         near.force_rows.data());
    std::fill_n(near.force_impulses.begin(), model.shape->steps_per_frame, model.shape->step_s);
    if (!excitation.ramps) return;
    std::fill_n(near.force_rows.begin() + static_cast<std::ptrdiff_t>(modes), modes, 0.0);
    kernels::add_impulse(modes, 1.0, model.shape->mobility.data(), excitation.ramp.data(),
                         near.force_rows.data() + modes);
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        near.force_impulses[model.shape->response_stride + n] =
            model.shape->step_s * static_cast<double>(excitation.elapsed + n);
    }
}

/// rates_free <- S v of free flight at each step, for the near contacts from `first` on.
void run_free(const StringModel& model, StringState& state, std::size_t first) {
    NearState& near = state.near_frame;
    const ContactState& contact = state.contact;
    std::copy_n(state.displacement.begin(), state.active_modes, near.displacement.begin());
    std::copy_n(state.velocity.begin(), state.active_modes, near.velocity.begin());
    kernels::ModeRun run = kernels::frame_run(model);
    run.modes = state.active_modes;
    for (std::size_t i = first; i < contact.near.size(); ++i) {
        near.rows[i] = model.shape->contact_rows.data() + contact.near[i] * model.shape->stride;
    }
    run.probes = contact.near.size() - first;
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

void save_start(StringState& state) {
    state.near_frame.start.gaps = static_cast<const ContactGaps&>(state.contact);
    state.near_frame.start.counters = state.counters;
}

void restore_start(StringState& state) {
    static_cast<ContactGaps&>(state.contact) = state.near_frame.start.gaps;
    state.counters = state.near_frame.start.counters;
}

/// The row of NearState::impulses that collects the impulses of a contact.
double* impulses_of(const StringModel& model, NearState& near, std::uint32_t contact) {
    const auto found = std::find(near.struck.begin(), near.struck.end(), contact);
    const auto slot = static_cast<std::size_t>(found - near.struck.begin());
    double* impulses = near.impulses.data() + slot * model.shape->response_stride;
    if (slot == near.struck.size()) {
        near.struck.push(contact);
        std::fill_n(impulses, model.shape->response_stride, 0.0);
    }
    return impulses;
}

/// Keeps the step's positive impulses for run_impulses().
void keep_impulses(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    for (const auto struck : contact.candidates) {
        if (contact.impulse[struck] > 0)
            impulses_of(model, state.near_frame, struck)[n] = contact.impulse[struck];
    }
}

/// Adds the responses to the step's impulses to the rates of all later steps, contact by contact.
void spread_over_time(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    for (const auto struck : contact.candidates) {
        const double impulse = contact.impulse[struck];
        if (impulse <= 0) continue;
        kernels::spread_impulse(model, contact.near.span(), {struck, impulse, n},
                                state.near_frame.rates.data());
    }
}

/// Adds the responses to the step's impulses to the rates of all later steps, step by step.
void spread_over_contacts(const StringModel& model, StringState& state, std::size_t n) {
    const ContactState& contact = state.contact;
    const std::size_t stride = model.shape->contact_stride;
    const std::size_t step = model.shape->contact_count * stride;
    for (std::size_t later = n + 1; later < model.shape->steps_per_frame; ++later) {
        kernels::add_rows(contact.candidates.data(), contact.candidates.size(), contact.impulse.data(),
                          stride, stride, model.tuning.step_response.data() + (later - n) * step,
                          state.near_frame.rates.data() + later * stride);
    }
}

/// gap_free <- the gaps at the end of step n without its impulses.
void predict_near_gaps(const StringModel& model, StringState& state, std::size_t n) {
    ContactState& contact = state.contact;
    const AlignedVector<double>& rates = state.near_frame.rates;
    const bool by_step = !model.tuning.step_response.empty();
    for (std::size_t i = 0; i < contact.near.size(); ++i) {
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
        std::copy_n(near.rates_free.begin(), contact.near.size() * model.shape->response_stride,
                    near.rates.begin());
        return;
    }
    for (std::size_t i = 0; i < contact.near.size(); ++i) {
        for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n)
            near.rates[n * model.shape->contact_stride + contact.near[i]] =
                near.rates_free[i * model.shape->response_stride + n];
    }
}

/// Solves one complementarity problem a step, in the order of time. Returns false where that turns out to
/// cost more than steps of all modes.
bool solve_in_contact_space(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    const std::uint64_t impulses_before = state.counters.impulses;
    begin_rates(model, state);
    near.struck.clear();
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
        if (is_crowded(model, state, state.counters.impulses - impulses_before)) return false;
    }
    return true;
}

/// Adds the response of the modes to the impulses to the frame's end. It is computed for unit mobility and
/// scaled at the end.
void run_impulses(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    state.active_modes = model.shape->stride;
    std::fill_n(near.displacement.begin(), model.shape->stride, 0.0);
    std::fill_n(near.velocity.begin(), model.shape->stride, 0.0);
    kernels::ModeRun run = kernels::frame_run(model);
    for (std::size_t i = 0; i < near.struck.size(); ++i) {
        near.rows[i] = model.shape->contact_rows.data() + near.struck[i] * model.shape->stride;
    }
    run.drivers = near.struck.size();
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

bool is_crowded(const StringModel& model, const StringState& state, std::uint64_t impulses) JAWARI_REALTIME {
    const auto steps = static_cast<double>(model.shape->steps_per_frame);
    const auto near = static_cast<double>(state.contact.near.size());
    const auto count = static_cast<double>(impulses);
    const double spread =
        count * near * (steps / 2 + (model.tuning.step_response.empty() ? row_overhead : 0));
    const double stepped = static_cast<double>(model.shape->stride) * (near * steps + count);
    return spread > stepped;
}

NearOutcome solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(!model.tuning.response.empty() &&
                  state.near_frame.rates.size() >= model.shape->response_stride);
    ContactState& contact = state.contact;
    std::size_t known = 0;
    place_gaps(model, state);
    do {
        run_free(model, state, known);
        known = contact.near.size();
        save_start(state);
        if (!solve_in_contact_space(model, state)) {
            restore_start(state);
            return NearOutcome::Crowded;
        }
        if (!admit_pushed_in_frame(model, state)) break;
        restore_start(state);
        place_gaps(model, state);
    } while (true);
    state.counters.steps += model.shape->steps_per_frame;
    state.excitation.elapsed += model.shape->steps_per_frame;
    if (state.near_frame.struck.empty()) return NearOutcome::Open;
    state.certificate.validity.outdated = true;
    run_impulses(model, state);
    return NearOutcome::Struck;
}

}  // namespace jawari
