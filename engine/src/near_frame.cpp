#include "near_frame.h"

#include <algorithm>
#include <cmath>

#include "certificate.h"
#include "contact.h"
#include "impact_law.h"
#include "kernels.h"
#include "near_kernels.h"

namespace jawari {
namespace {

kernels::ModeRun run_of(const StringModel& model) {
    kernels::ModeRun run;
    run.modes = model.stride;
    run.steps = model.steps_per_frame;
    run.step_s = model.step_s;
    run.carry = model.carry.data();
    run.change = model.change.data();
    run.restoring = model.restoring.data();
    return run;
}

const double* response(const StringModel& model, std::size_t struck, std::size_t contact) {
    return model.response.data() + (struck * model.contact_count + contact) * model.response_stride;
}

/// How far a unit impulse at one contact can lower the gap of another within a frame; with the laws'
/// lookahead.
double largest_push(const StringModel& model, std::size_t struck, std::size_t contact) {
    const double* rate = response(model, struck, contact);
    const double ahead = looks_ahead(model.law) ? 0.5 : 0.0;
    double rise = 0;
    double lowest = 0;
    for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
        rise += model.step_s * rate[n];
        lowest = std::min({lowest, rise, rise + ahead * model.step_s * rate[n]});
    }
    return -lowest;
}

/// rates_free <- S v of free flight at each step, for the near contacts from `first` on.
void run_free(const StringModel& model, StringState& state, std::size_t first) {
    NearState& near = state.near_frame;
    const ContactState& contact = state.contact;
    std::copy(state.displacement.begin(), state.displacement.end(), near.displacement.begin());
    std::copy(state.velocity.begin(), state.velocity.end(), near.velocity.begin());
    kernels::ModeRun run = run_of(model);
    run.modes = state.active_modes;
    for (std::size_t i = first; i < contact.near_count; ++i) {
        near.rows[i] = model.contact_rows.data() + contact.near[i] * model.stride;
    }
    run.probes = contact.near_count - first;
    run.probe_rows = near.rows.data() + first;
    run.rates = near.rates_free.data() + first * model.response_stride;
    run.rate_stride = model.response_stride;
    run.lanes = near.lanes.data();
    run.q = near.displacement.data();
    run.v = near.velocity.data();
    const double* force_row = near.force_row.data();
    if (is_excited(state)) {
        std::fill(near.force_row.begin(), near.force_row.end(), 0.0);
        kernels::add_impulse(model.stride, 1.0, model.mobility.data(), state.force_row.data(),
                             near.force_row.data());
        for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
            near.force_impulses[n] = model.step_s * (state.force + static_cast<double>(n) * state.force_rate);
        }
        run.drivers = 1;
        run.driver_rows = &force_row;
        run.impulses = near.force_impulses.data();
        run.impulse_stride = model.response_stride;
    }
    kernels::run_modes(run);
}

/// What must be as it was if the frame is solved once more with more contacts.
void save_start(StringState& state) {
    NearState& near = state.near_frame;
    near.gap = state.contact.gap;
    near.gap_before = state.contact.gap_before;
    near.impulse = state.contact.impulse;
    near.counters = state.counters;
}

void restore_start(StringState& state) {
    const NearState& near = state.near_frame;
    state.contact.gap = near.gap;
    state.contact.gap_before = near.gap_before;
    state.contact.impulse = near.impulse;
    state.counters = near.counters;
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
}

/// Adds what the step's impulses do to the rates of all later steps, and keeps them for the modes.
void spread_impulses(const StringModel& model, StringState& state, std::size_t n) {
    NearState& near = state.near_frame;
    const ContactState& contact = state.contact;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto struck = contact.candidates[i];
        const double impulse = contact.impulse[struck];
        if (impulse <= 0) continue;
        near.impulses[struck * model.response_stride + n] = impulse;
        for (std::size_t j = 0; j < contact.near_count; ++j) {
            const double* rate = response(model, struck, contact.near[j]);
            double* rates = near.rates.data() + j * model.response_stride + n;
            for (std::size_t later = 1; later < model.steps_per_frame - n; ++later)
                rates[later] += impulse * rate[later];
        }
    }
}

/// The causal loop: one small complementarity problem a step.
void solve_in_contact_space(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    ContactState& contact = state.contact;
    std::copy_n(near.rates_free.begin(), contact.near_count * model.response_stride, near.rates.begin());
    std::fill(near.impulses.begin(), near.impulses.end(), 0.0);
    near.first_impulse = model.steps_per_frame;
    for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
        for (std::size_t i = 0; i < contact.near_count; ++i) {
            const auto c = contact.near[i];
            contact.gap_free[c] = contact.gap[c] + model.step_s * near.rates[i * model.response_stride + n];
        }
        if (select_candidates(model, state)) {
            solve_impulses(model, state);
            near.first_impulse = std::min(near.first_impulse, n);
            spread_impulses(model, state, n);
        } else {
            clear_impulses(state);
        }
        accept_gaps(model, state);
    }
}

/// Contacts that the frame's impulses may have pushed in become near; true if there are any.
bool admit_pushed(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    CertificateState& bounds = state.certificate;
    const std::size_t before = contact.near_count;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        double push = 0;
        for (std::size_t i = 0; i < before; ++i) {
            const auto struck = contact.near[i];
            push += model.certificate.push[c * model.contact_count + struck] * contact.frame_impulse[struck];
        }
        bounds.group_push[c] = push;
        if (contact.is_near[c] != 0 || bounds.margin[c] > push) continue;
        contact.near[contact.near_count++] = static_cast<std::uint32_t>(c);
        contact.is_near[c] = 1;
    }
    return contact.near_count > before;
}

/// The rows of the contacts struck, their impulses moved together; returns how many.
std::size_t gather_struck(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    std::size_t struck = 0;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        if (state.contact.frame_impulse[c] <= 0) continue;
        near.rows[struck] = model.contact_rows.data() + c * model.stride;
        std::copy_n(near.impulses.data() + c * model.response_stride, model.response_stride,
                    near.impulses.data() + struck * model.response_stride);
        struck += 1;
    }
    return struck;
}

/// The frame's end receives the response of the modes to the impulses, run for unit mobility and scaled at
/// the end.
void run_impulses(const StringModel& model, StringState& state) {
    NearState& near = state.near_frame;
    state.active_modes = model.stride;
    std::fill(near.displacement.begin(), near.displacement.end(), 0.0);
    std::fill(near.velocity.begin(), near.velocity.end(), 0.0);
    kernels::ModeRun run = run_of(model);
    run.drivers = gather_struck(model, state);
    run.driver_rows = near.rows.data();
    run.impulses = near.impulses.data() + near.first_impulse;
    run.impulse_stride = model.response_stride;
    run.steps = model.steps_per_frame - near.first_impulse;
    run.q = near.displacement.data();
    run.v = near.velocity.data();
    kernels::run_modes(run);
    kernels::add_impulse(model.stride, 1.0, model.mobility.data(), near.displacement.data(),
                         state.displacement_flown.data());
    kernels::add_impulse(model.stride, 1.0, model.mobility.data(), near.velocity.data(),
                         state.velocity_flown.data());
}

}  // namespace

void set_responses(StringModel& model) {
    const std::size_t count = model.contact_count;
    model.response_stride = padded(model.steps_per_frame);
    if (count == 0 || model.certificate.group_begin.size() != count + 1 ||
        count * count * model.response_stride > largest_response_table) {
        return;
    }
    model.response.assign(count * count * model.response_stride, 0.0);
    AlignedVector<double> q(model.stride), v(model.stride), driver(model.stride);
    std::vector<const double*> rows(count);
    for (std::size_t c = 0; c < count; ++c) rows[c] = model.contact_rows.data() + c * model.stride;
    AlignedVector<double> impulse(model.response_stride, 0.0);
    impulse[0] = 1;
    AlignedVector<double> lanes(count * kernels::steps_per_run * lane_padding);
    for (std::size_t struck = 0; struck < count; ++struck) {
        std::fill(q.begin(), q.end(), 0.0);
        std::fill(v.begin(), v.end(), 0.0);
        std::fill(driver.begin(), driver.end(), 0.0);
        kernels::add_impulse(model.stride, 1.0, model.mobility.data(), rows[struck], driver.data());
        const double* driver_row = driver.data();
        kernels::ModeRun run = run_of(model);
        run.drivers = 1;
        run.driver_rows = &driver_row;
        run.impulses = impulse.data();
        run.impulse_stride = model.response_stride;
        run.probes = count;
        run.probe_rows = rows.data();
        run.rates = model.response.data() + struck * count * model.response_stride;
        run.rate_stride = model.response_stride;
        run.lanes = lanes.data();
        run.q = q.data();
        run.v = v.data();
        kernels::run_modes(run);
    }
    for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t struck = 0; struck < count; ++struck) {
            model.certificate.push[c * count + struck] = largest_push(model, struck, c);
        }
    }
}

bool solve_near_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    std::size_t known = 0;
    place_gaps(model, state);
    do {
        run_free(model, state, known);
        known = contact.near_count;
        save_start(state);
        solve_in_contact_space(model, state);
        if (!admit_pushed(model, state)) break;
        restore_start(state);
        place_gaps(model, state);
    } while (true);
    state.counters.steps += model.steps_per_frame;
    state.force += state.force_rate * static_cast<double>(model.steps_per_frame);
    const bool struck = std::any_of(contact.frame_impulse.begin(), contact.frame_impulse.end(),
                                    [](double impulse) { return impulse > 0; });
    if (!struck) return false;
    state.certificate.outdated = true;
    run_impulses(model, state);
    return true;
}

}  // namespace jawari
