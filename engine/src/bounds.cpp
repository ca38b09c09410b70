// The bounds themselves: how fast modes and gaps can move from the present state on.
#include "bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact.h"
#include "kernels.h"
#include "skipping_kernels.h"

namespace jawari {
namespace {

/// In free flight bounds only become tighter when computed anew; this often is enough.
constexpr std::uint64_t refresh_period = 32;

/// Modes behind the last one that matters are put to rest and leave the sums.
void drop_weak_modes(const StringModel& model, StringState& state, const kernels::LargestBounds& largest) {
    const CertificateState& bounds = state.certificate;
    std::size_t active = state.active_modes;
    while (active > 0 && bounds.speed[active - 1] <= lazy_threshold * largest.speed &&
           bounds.extent[active - 1] <= lazy_threshold * largest.extent) {
        --active;
    }
    active = std::min(padded(active), model.stride);
    for (auto* array : {&state.displacement, &state.velocity, &state.velocity_before,
                        &state.displacement_flown, &state.velocity_flown}) {
        std::fill(array->begin() + static_cast<std::ptrdiff_t>(active), array->end(), 0.0);
    }
    state.active_modes = active;
}

bool has_faded(const StringState& state, const kernels::LargestBounds& largest) {
    const CertificateState& bounds = state.certificate;
    return largest.speed <= sleep_threshold * bounds.strongest_speed &&
           largest.extent <= sleep_threshold * bounds.strongest_extent;
}

/// At rest, until a force or a moving obstacle wakes the string.
void fall_asleep(StringState& state) {
    for (auto* array : {&state.displacement, &state.velocity, &state.velocity_before,
                        &state.displacement_flown, &state.velocity_flown}) {
        std::fill(array->begin(), array->end(), 0.0);
    }
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
    state.active_modes = 0;
    state.asleep = true;
}

/// kick_g = sum_k envelope_g kick |phi_k(x_force)|
void set_force_kicks(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    AlignedVector<double>& kick = bounds.detour;  // free at this moment
    for (std::size_t k = 0; k < model.stride; ++k) {
        kick[k] = model.certificate.kick[k] * std::abs(state.force_row[k]);
    }
    kernels::row_products(group_count(model), model.stride, model.stride, model.certificate.envelope.data(),
                          kick.data(), bounds.group_force_kick.data());
}

/// speed_g = sum_k envelope_g r_k. Odometers start again from zero; what the readings claimed stays claimed.
void set_group_speeds(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    const std::size_t groups = group_count(model);
    kernels::row_products(groups, state.active_modes, model.stride, model.certificate.envelope.data(),
                          bounds.speed.data(), bounds.group_speed.data());
    for (std::size_t g = 0; g < groups; ++g) {
        bounds.group_speed[g] *= bound_safety;
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            bounds.open_until[c] -= bounds.group_odometer[g];
        }
        bounds.group_odometer[g] = 0;
        bounds.group_clearance[g] = -std::numeric_limits<double>::infinity();
    }
    for (auto* known : {&bounds.group_has_detour, &bounds.group_has_clearance, &bounds.group_has_lookout})
        std::fill(known->begin(), known->end(), std::uint8_t{0});
}

/// out[g] <- sum_k envelope_g x_k for the groups in `list` that are not flagged yet.
void complete(const StringModel& model, StringState& state, std::span<const std::uint32_t> list,
              const AlignedVector<double>& x, std::vector<std::uint8_t>& known, std::vector<double>& out) {
    std::vector<std::uint32_t>& missing = state.certificate.missing_groups;
    std::size_t count = 0;
    for (const auto g : list) {
        if (known[g] == 0) missing[count++] = g;
        known[g] = 1;
    }
    kernels::indexed_row_products(missing.data(), count, state.active_modes, model.stride,
                                  model.certificate.envelope.data(), x.data(), out.data());
    state.certificate.missing_count = count;
}

double highest_obstacle(const StringModel& model, const StringState& state, std::size_t g) {
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1]; ++c) {
        highest = std::max(highest, state.contact.height[c]);
    }
    return highest;
}

}  // namespace

bool needs_refresh(const StringState& state) JAWARI_REALTIME {
    return state.certificate.outdated || state.certificate.age >= refresh_period || is_excited(state);
}

std::uint64_t frames_until_refresh(const StringState& state) JAWARI_REALTIME {
    return needs_refresh(state) ? 0 : refresh_period - state.certificate.age;
}

void refresh_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    if (is_excited(state)) {
        state.active_modes = model.stride;
        set_force_kicks(model, state);
    }
    const kernels::LargestBounds largest =
        kernels::mode_bounds(state.active_modes, model, state.displacement.data(), state.velocity.data(),
                             bounds.speed.data(), bounds.extent.data(), bounds.detour.data());
    bounds.strongest_speed = std::max(bounds.strongest_speed, largest.speed);
    bounds.strongest_extent = std::max(bounds.strongest_extent, largest.extent);
    const bool finite =
        std::isfinite(largest.speed) && std::isfinite(largest.extent);  // else left to the frame's check
    if (!is_excited(state) && finite) {
        if (state.skipping.sleep && has_faded(state, largest)) {
            fall_asleep(state);
            return;
        }
        if (state.skipping.lazy) drop_weak_modes(model, state, largest);
    }
    set_group_speeds(model, state);
    bounds.age = 0;
    bounds.outdated = is_excited(state);
}

void complete_clearances(const StringModel& model, StringState& state,
                         std::span<const std::uint32_t> groups) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    complete(model, state, groups, bounds.extent, bounds.group_has_clearance, bounds.group_clearance);
    for (std::size_t i = 0; i < bounds.missing_count; ++i) {
        const auto g = bounds.missing_groups[i];
        bounds.group_clearance[g] =
            -bound_safety * bounds.group_clearance[g] - highest_obstacle(model, state, g);
    }
}

void complete_detours(const StringModel& model, StringState& state,
                      std::span<const std::uint32_t> groups) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    complete(model, state, groups, bounds.detour, bounds.group_has_detour, bounds.group_detour);
    for (std::size_t i = 0; i < bounds.missing_count; ++i)
        bounds.group_detour[bounds.missing_groups[i]] *= bound_safety;
}

}  // namespace jawari
