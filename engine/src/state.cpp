#include "jawari/state.h"

#include <algorithm>

#include "contact.h"
#include "jawari/energy.h"
#include "kernels.h"

namespace jawari {
namespace {

ContactState make_contact_state(const StringModel& model) {
    const std::size_t n = model.contact_stride;
    ContactState contact;
    for (auto* array : {&contact.gap, &contact.gap_before, &contact.height, &contact.height_before,
                        &contact.height_rise_before, &contact.height_rate, &contact.height_target, &contact.impulse,
                        &contact.frame_impulse, &contact.gap_free, &contact.gap_rate, &contact.offset,
                        &contact.residual}) {
        array->assign(n, 0.0);
    }
    contact.moving_steps.assign(n, 0);
    contact.candidates.assign(n, 0);
    return contact;
}

void place_obstacles(const StringModel& model, ContactState& contact) {
    std::copy(model.contact_height.begin(), model.contact_height.end(), contact.height.begin());
    contact.height_before = contact.height;
    for (auto* array : {&contact.height_rise_before, &contact.impulse, &contact.frame_impulse, &contact.gap_rate}) {
        std::fill(array->begin(), array->end(), 0.0);
    }
    std::fill(contact.moving_steps.begin(), contact.moving_steps.end(), std::uint64_t{0});
    contact.moving_count = 0;
    contact.candidate_count = 0;
}

/// gap and gap_before from displacement and backward velocity.
void place_gaps(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    kernels::row_products(model.contact_count, model.stride, model.contact_rows.data(), state.velocity.data(),
                          contact.gap_rate.data());
    refresh_gaps(model, state);
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        contact.gap_before[c] = contact.gap[c] - model.step_s * contact.gap_rate[c];
    }
}

}  // namespace

StringState make_string_state(const StringModel& model, Metering metering) {
    StringState state;
    for (auto* array : {&state.displacement, &state.velocity, &state.displacement_before, &state.velocity_before,
                        &state.force_row}) {
        array->assign(model.stride, 0.0);
    }
    state.contact = make_contact_state(model);
    state.lcp = make_lcp_workspace(model.contact_count);
    state.metering = metering;
    reset(model, state);
    return state;
}

SceneState make_state(const SceneModel& model, Metering metering) {
    SceneState state;
    for (const StringModel& string : model.strings) state.strings.push_back(make_string_state(string, metering));
    return state;
}

void reset(const StringModel& model, StringState& state) noexcept {
    std::copy(model.initial_displacement.begin(), model.initial_displacement.end(), state.displacement.begin());
    std::copy(model.initial_velocity.begin(), model.initial_velocity.end(), state.velocity.begin());
    state.force = 0;
    state.force_rate = 0;
    place_obstacles(model, state.contact);
    place_gaps(model, state);
    state.counters = {};
    state.energy = {};
    state.energy.initial = energy(model, state);
    state.energy.highest = state.energy.initial;
}

void put_to_rest(const StringModel& model, StringState& state) noexcept {
    std::copy(model.rest_displacement.begin(), model.rest_displacement.end(), state.displacement.begin());
    std::fill(state.velocity.begin(), state.velocity.end(), 0.0);
    state.force = 0;
    state.force_rate = 0;
    place_obstacles(model, state.contact);
    place_gaps(model, state);
}

}  // namespace jawari
