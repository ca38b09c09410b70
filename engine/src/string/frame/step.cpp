// One contact step, stage by stage (docs/engine/model.md, "The time step").
#include <algorithm>

#include "base/assert.h"
#include "jawari/scene/render.h"
#include "string/broad_phase/pushed_contacts.h"
#include "string/contact/contact_stage.h"
#include "string/frame/step.h"
#include "string/kernels/mode_sums.h"
#include "string/state/metering.h"

namespace jawari {
namespace {

/// velocity_before <- v. The old storage of velocity_before receives the step's new velocity.
void remember(const StringModel& model, StringState& state) {
    state.velocity.swap(state.velocity_before);
    if (state.metering == Metering::Step) {
        std::copy(state.displacement.begin(), state.displacement.end(), state.displacement_before.begin());
    }
    if (model.shape->scheme == Scheme::Theta) note_approach(model, state);
}

/// v_free = carry v + change v + restoring q + h (w/mu) phi(x) F
void predict_velocity(const StringModel& model, StringState& state) {
    kernels::free_velocity(state.active_modes, model.shape->carry.data(), model.shape->change.data(),
                           model.tuning.restoring.data(), state.displacement.data(),
                           state.velocity_before.data(), state.velocity.data());
    const ExcitationState& excitation = state.excitation;
    if (!excitation.active) return;
    kernels::add_impulse(state.active_modes, model.shape->step_s, model.shape->mobility.data(),
                         excitation.held.data(), state.velocity.data());
    if (!excitation.ramps) return;
    kernels::add_impulse(state.active_modes, model.shape->step_s * static_cast<double>(excitation.elapsed),
                         model.shape->mobility.data(), excitation.ramp.data(), state.velocity.data());
}

/// Solves for lambda of the step. Contacts that lambda may push in become near, and the problem is solved
/// again with them.
void find_impulses(const StringModel& model, StringState& state) {
    state.active_modes = model.shape->stride;  // an impulse wakes every mode
    solve_impulses(model, state);
    while (admit_pushed_in_step(model, state)) {
        select_candidates(model, state);
        solve_impulses(model, state);
    }
    charge_impulses(model, state);
}

/// q+ = q + h (theta v+ + (1 - theta) v)
void advance_displacement(const StringModel& model, StringState& state) {
    const double h = model.shape->step_s;
    kernels::add_scaled(state.active_modes, h * model.shape->theta, state.velocity.data(),
                        state.displacement.data());
    if (model.shape->theta < 1) {
        kernels::add_scaled(state.active_modes, h * (1 - model.shape->theta), state.velocity_before.data(),
                            state.displacement.data());
    }
}

}  // namespace

void step_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    remember(model, state);
    move_obstacles(state.contact);
    predict_velocity(model, state);
    predict_gaps(model, state);
    if (select_candidates(model, state)) {
        find_impulses(model, state);
        apply_impulses(model, state);
    } else {
        clear_impulses(state);
    }
    advance_displacement(model, state);
    if (state.metering == Metering::Step) meter_step(model, state);
    accept_gaps(model, state);
    state.excitation.elapsed += 1;
    state.counters.steps += 1;
    if (state.steps_left > 0) state.steps_left -= 1;
}

void step(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(state.displacement.size() >= model.shape->stride);
    // A frame leaves the gaps of most contacts unknown, and steps leave its bounds behind.
    if (state.contact.stepping_in_frame != state.frame) notice_change(model, state);
    step_near_contacts(model, state);
}

}  // namespace jawari
