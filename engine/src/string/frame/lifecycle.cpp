#include "jawari/detail/string_state.h"

#include <algorithm>

#include "base/assert.h"
#include "jawari/scene/energy.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/contact/contact_stage.h"
#include "string/frame/short_frame.h"
#include "string/kernels/mode_run.h"

namespace jawari {
namespace {

ContactGaps make_contact_gaps(std::size_t contacts) {
    ContactGaps gaps;
    for (auto* array : {&gaps.gap, &gaps.gap_before, &gaps.impulse, &gaps.frame_impulse})
        array->assign(contacts, 0.0);
    return gaps;
}

ContactState make_contact_state(const StringSizes& sizes) {
    const std::size_t n = padded(sizes.contacts);
    ContactState contact;
    static_cast<ContactGaps&>(contact) = make_contact_gaps(n);
    for (auto* array : {&contact.height, &contact.height_before, &contact.height_rise_before,
                        &contact.height_rate, &contact.height_target, &contact.gap_free, &contact.gap_rate,
                        &contact.offset, &contact.residual, &contact.compliant_impulse}) {
        array->assign(n, 0.0);
    }
    contact.moving_steps.assign(n, 0);
    for (auto* list : {&contact.candidates, &contact.rigid, &contact.compliant, &contact.near})
        list->allocate(n);
    contact.is_near.assign(n, 0);
    return contact;
}

void place_obstacles(const StringModel& model, ContactState& contact) {
    std::copy(model.shape->contact_height.begin(), model.shape->contact_height.end(), contact.height.begin());
    contact.height_before = contact.height;
    for (auto* array :
         {&contact.height_rise_before, &contact.impulse, &contact.frame_impulse, &contact.gap_rate}) {
        std::fill(array->begin(), array->end(), 0.0);
    }
    std::fill(contact.moving_steps.begin(), contact.moving_steps.end(), std::uint64_t{0});
    contact.moving_count = 0;
    for (auto* list : {&contact.candidates, &contact.rigid, &contact.compliant}) list->clear();
}

GapBounds make_gap_bounds(const StringSizes& sizes) {
    GapBounds bounds;
    for (auto* array : {&bounds.speed, &bounds.detour, &bounds.extent}) array->assign(sizes.stride, 0.0);
    for (auto* array :
         {&bounds.group_speed, &bounds.group_detour, &bounds.group_clearance, &bounds.group_odometer,
          &bounds.group_push, &bounds.group_step_push, &bounds.group_margin}) {
        array->assign(sizes.groups, 0.0);
    }
    for (auto* array : {&bounds.open_until, &bounds.margin, &bounds.frame_gap, &bounds.frame_end_gap})
        array->assign(sizes.contacts, 0.0);
    return bounds;
}

Validity make_validity(const StringSizes& sizes) {
    Validity validity;
    for (auto* flags :
         {&validity.group_has_detour, &validity.group_has_clearance, &validity.group_has_forecast}) {
        flags->assign(sizes.groups, 0);
    }
    for (auto* stamps : {&validity.frame_gap_at, &validity.certified_at})
        stamps->assign(sizes.contacts, unknown_frame);
    return validity;
}

ForecastState make_forecast_state(const StringSizes& sizes) {
    ForecastState forecast;
    for (auto* array : {&forecast.displacement, &forecast.velocity}) array->assign(forecast_modes, 0.0);
    for (auto* array : {&forecast.group_detour, &forecast.group_overtones}) array->assign(sizes.groups, 0.0);
    for (auto* array : {&forecast.gap, &forecast.gap_end}) array->assign(sizes.contacts, 0.0);
    forecast.gap_at.assign(sizes.contacts, unknown_frame);
    for (auto* list : {&forecast.watched, &forecast.unknown}) list->allocate(sizes.contacts);
    return forecast;
}

CertificateState make_certificate_state(const StringSizes& sizes) {
    CertificateState certificate;
    certificate.bounds = make_gap_bounds(sizes);
    certificate.validity = make_validity(sizes);
    certificate.forecast = make_forecast_state(sizes);
    for (auto* list : {&certificate.expired, &certificate.unknown_gaps}) list->allocate(sizes.contacts);
    for (auto* list : {&certificate.expired_groups, &certificate.missing_groups})
        list->allocate(sizes.groups);
    return certificate;
}

NearState make_near_state(const StringSizes& sizes) {
    NearState near;
    if (sizes.response_stride == 0) return near;
    const std::size_t count = sizes.contacts;
    for (auto* array : {&near.rates_free, &near.impulses}) array->assign(count * sizes.response_stride, 0.0);
    near.rates.assign(padded(count) * sizes.response_stride, 0.0);  // in either order
    near.force_impulses.assign(2 * sizes.response_stride, 0.0);
    near.lanes.assign(count * kernels::steps_per_run * lane_padding, 0.0);
    near.force_rows.assign(2 * sizes.stride, 0.0);
    near.displacement.assign(sizes.stride, 0.0);
    near.velocity.assign(sizes.stride, 0.0);
    near.start.gaps = make_contact_gaps(padded(sizes.contacts));
    near.rows.assign(count, nullptr);
    near.struck.allocate(count);
    return near;
}

ShortFrameState make_short_frame_state(const StringSizes& sizes) {
    ShortFrameState frame;
    const std::size_t contacts = sizes.short_contacts;
    if (contacts == 0) return frame;
    frame.velocities.assign(sizes.short_steps * sizes.stride, 0.0);
    frame.rates.assign(sizes.short_steps * contacts, 0.0);
    frame.impulses.assign(sizes.short_steps * contacts, 0.0);
    frame.struck.allocate(contacts);
    frame.step_response.assign(sizes.short_steps * sizes.contacts * contacts, 0.0);
    frame.response_known.assign(sizes.contacts, 0);
    frame.table.values.assign(contacts * contacts, 0.0);
    for (auto* array : {&frame.table.sign, &frame.table.scale, &frame.table.solution})
        array->assign(contacts, 0.0);
    for (auto* list : {&frame.table.active, &frame.table.kept}) list->allocate(contacts);
    return frame;
}

}  // namespace

StringSizes sizes_of(const StringModel& model) {
    const std::size_t groups = std::max<std::size_t>(model.shape->certificate.group_begin.size(), 1) - 1;
    const std::size_t response_stride = model.tuning.response.empty() ? 0 : model.shape->response_stride;
    const bool is_short = has_short_frames(model);
    return {model.shape->stride,
            model.shape->contact_count,
            groups,
            response_stride,
            is_short ? model.shape->contact_stride : 0,
            is_short ? model.shape->steps_per_frame : 0};
}

StringSizes larger(const StringSizes& a, const StringSizes& b) {
    return {std::max(a.stride, b.stride),
            std::max(a.contacts, b.contacts),
            std::max(a.groups, b.groups),
            std::max(a.response_stride, b.response_stride),
            std::max(a.short_contacts, b.short_contacts),
            std::max(a.short_steps, b.short_steps)};
}

StringState allocate_string_state(const StringSizes& sizes) {
    StringState state;
    for (auto* array :
         {&state.displacement, &state.velocity, &state.displacement_before, &state.velocity_before,
          &state.displacement_flown, &state.velocity_flown, &state.excitation.held, &state.excitation.ramp}) {
        array->assign(sizes.stride, 0.0);
    }
    state.contact = make_contact_state(sizes);
    LcpLimits limits;
    limits.independent = std::max(largest_factor, sizes.stride);
    state.lcp = make_lcp_workspace(sizes.contacts, limits);
    state.certificate = make_certificate_state(sizes);
    state.near_frame = make_near_state(sizes);
    state.short_frame = make_short_frame_state(sizes);
    return state;
}

StringState make_string_state(const StringModel& model, Metering metering, Skipping skipping) {
    StringState state = allocate_string_state(sizes_of(model));
    state.metering = metering;
    state.skipping = skipping;
    reset(model, state);
    return state;
}

SceneState make_state(const SceneModel& model, Metering metering, Skipping skipping) {
    SceneState state;
    for (const StringModel& string : model.strings) {
        state.strings.push_back(make_string_state(string, metering, skipping));
    }
    return state;
}

void reset(const StringModel& model, StringState& state) noexcept {
    JAWARI_ASSERT(state.displacement.size() >= model.shape->stride);
    JAWARI_ASSERT(state.contact.gap.size() >= model.shape->contact_count);
    std::copy(model.shape->initial_displacement.begin(), model.shape->initial_displacement.end(),
              state.displacement.begin());
    std::copy(model.shape->initial_velocity.begin(), model.shape->initial_velocity.end(),
              state.velocity.begin());
    clear_excitation(state);
    state.frame = 0;
    state.leaves_obstacles = false;
    state.certificate.bounds.strongest_speed = 0;
    state.certificate.bounds.strongest_extent = 0;
    state.near_frame.crowded = false;
    place_obstacles(model, state.contact);
    notice_change(model, state);
    state.counters = {};
    state.energy = {};
    state.energy.initial = energy(model, state);
    state.energy.highest = state.energy.initial;
}

void reset(const SceneModel& model, SceneState& state) noexcept {
    JAWARI_ASSERT(state.strings.size() == model.strings.size());
    for (std::size_t s = 0; s < model.strings.size(); ++s) reset(model.strings[s], state.strings[s]);
    state.frame = 0;
}

void put_to_rest(const StringModel& model, StringState& state) noexcept {
    std::copy(model.shape->rest_displacement.begin(), model.shape->rest_displacement.end(),
              state.displacement.begin());
    std::fill(state.velocity.begin(), state.velocity.end(), 0.0);
    clear_excitation(state);
    place_obstacles(model, state.contact);
    notice_change(model, state);
}

void notice_change(const StringModel& model, StringState& state) noexcept {
    state.contact.left_open = 0;
    state.lcp.factored = 0;
    state.short_frame.table.of = 0;
    state.active_modes = model.shape->stride;
    state.asleep = false;
    choose_all_contacts(model, state);
    place_gaps(model, state);
    forget_bounds(state);
    state.contact.stepping_in_frame = state.frame;
}

void leave_obstacles(StringState& state) noexcept {
    state.leaves_obstacles = true;
    forget_bounds(state);
}

}  // namespace jawari
