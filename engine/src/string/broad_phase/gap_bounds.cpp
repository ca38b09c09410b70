// The bounds themselves: how fast modes and gaps can move from the present state on.
#include "string/broad_phase/gap_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/square.h"
#include "string/contact/contact_stage.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Frames between refreshes in free flight, where the bounds stay valid and a refresh only tightens them.
constexpr std::uint64_t refresh_period = 32;
/// Frames between refreshes under excitation, where the bounds grow with every frame.
constexpr std::uint64_t excited_refresh_period = 8;

/// Puts the modes behind the last one that matters to rest; they leave the sums.
void drop_weak_modes(const StringModel& model, StringState& state, const kernels::LargestBounds& largest) {
    const GapBounds& bounds = state.certificate.bounds;
    std::size_t active = state.active_modes;
    while (active > state.excitation.modes && bounds.speed[active - 1] <= lazy_threshold * largest.speed &&
           bounds.extent[active - 1] <= lazy_threshold * largest.extent) {
        --active;
    }
    active = std::min(padded(active), model.shape->stride);
    for (auto* array : {&state.displacement, &state.velocity, &state.velocity_before,
                        &state.displacement_flown, &state.velocity_flown}) {
        std::fill(array->begin() + static_cast<std::ptrdiff_t>(active),
                  array->begin() + static_cast<std::ptrdiff_t>(state.active_modes), 0.0);
    }
    state.active_modes = active;
}

bool has_faded(const StringState& state, const kernels::LargestBounds& largest) {
    const GapBounds& bounds = state.certificate.bounds;
    return largest.speed <= sleep_threshold * bounds.strongest_speed &&
           largest.extent <= sleep_threshold * bounds.strongest_extent;
}

/// Puts the string to rest until a force or a moving obstacle wakes it.
void fall_asleep(StringState& state) {
    for (auto* array : {&state.displacement, &state.velocity, &state.velocity_before,
                        &state.displacement_flown, &state.velocity_flown}) {
        std::fill(array->begin(), array->end(), 0.0);
    }
    std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
    state.active_modes = 0;
    state.asleep = true;
}

/// Whether what acts on the string is too weak to bring a clear string to a contact.
bool stays_passive(const StringState& state) {
    const ExcitationState& excitation = state.excitation;
    const ClearState& clear = state.certificate.clear;
    if (!excitation.active) return true;
    if (!(excitation.strength_N <= clear.force_N)) return false;
    if (excitation.passive) return true;
    return excitation.root >= 0 && square(clear.root + excitation.root) < clear.energy_J;
}

/// Computes the limits of ClearState from the obstacles' present heights.
void set_clear_limits(const StringModel& model, StringState& state) {
    ClearState& clear = state.certificate.clear;
    clear.limits_valid = true;
    double least_height = std::numeric_limits<double>::infinity();
    double least_root = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const double below = std::max(0.0, -state.contact.height[c]);
        least_height = std::min(least_height, below);
        least_root = std::min(least_root, below / model.shape->certificate.reach[c]);
    }
    const double root =
        (1 - share_of_forces) * least_root / (bound_safety * model.tuning.certificate.reach_growth);
    clear.energy_J = root * root;
    clear.force_N = share_of_forces * least_height / model.tuning.certificate.force_reach;
}

bool is_clear(const StringModel& model, StringState& state) {
    if (state.leaves_obstacles) return state.skipping.flight;
    const ClearState& clear = state.certificate.clear;
    const bool known =
        model.shape->certificate.reach.size() == model.shape->contact_count && lookahead(model) == 0;
    if (!known || !state.skipping.certificate || !state.skipping.flight) return false;
    if (!clear.limits_valid) set_clear_limits(model, state);
    if (!(clear.energy_J > 0)) return false;
    const double energy_J =
        kernels::energy(state.active_modes, model.tuning.kinetic.data(), model.tuning.potential.data(),
                        model.shape->step_s / 2, state.displacement.data(), state.velocity.data());
    state.certificate.clear.root = std::sqrt(energy_J);
    return energy_J < clear.energy_J && stays_passive(state);
}

/// Whether all gaps are tested at both ends of the frame. While few contacts strike, that costs less than
/// odometers that serve once.
bool tests_directly(const StringModel& model, const StringState& state) {
    return state.certificate.struck && model.shape->contact_count <= contacts_with_own_bounds &&
           lookahead(model) == 0;
}

/// speed_g = sum_k envelope_g r_k, or 0 where odometers are not needed. Resets the odometers and shifts every
/// open_until by the same amount, so certificates already issued stay valid.
void set_group_speeds(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    Validity& validity = state.certificate.validity;
    const std::size_t groups = group_count(model);
    if (validity.direct) {
        std::fill(bounds.group_speed.begin(), bounds.group_speed.end(), 0.0);
    } else {
        kernels::row_products(groups, state.active_modes, model.shape->stride,
                              model.shape->certificate.envelope.data(), bounds.speed.data(),
                              bounds.group_speed.data());
    }
    for (std::size_t g = 0; g < groups; ++g) {
        bounds.group_speed[g] *= bound_safety;
        for (const std::size_t c : contacts_of(model, g)) bounds.open_until[c] -= bounds.group_odometer[g];
        bounds.group_odometer[g] = 0;
        bounds.group_clearance[g] = -std::numeric_limits<double>::infinity();
    }
    for (auto* known :
         {&validity.group_has_detour, &validity.group_has_clearance, &validity.group_has_forecast}) {
        std::fill(known->begin(), known->end(), std::uint8_t{0});
    }
}

/// out[g] <- sum_k envelope_g x_k for the groups in `list` that are not flagged yet; these are then
/// missing_groups.
const IndexList& complete(const StringModel& model, StringState& state, const IndexList& list,
                          const AlignedVector<double>& x, std::vector<std::uint8_t>& known,
                          std::vector<double>& out) {
    IndexList& missing = state.certificate.missing_groups;
    missing.clear();
    for (const auto g : list) {
        if (known[g] == 0) missing.push(g);
        known[g] = 1;
    }
    kernels::indexed_row_products(missing.data(), missing.size(), state.active_modes, model.shape->stride,
                                  model.shape->certificate.envelope.data(), x.data(), out.data());
    return missing;
}

double highest_obstacle(const StringModel& model, const StringState& state, std::size_t g) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const std::size_t c : contacts_of(model, g)) highest = std::max(highest, state.contact.height[c]);
    return highest;
}

struct ForceBoundsOfParts {
    kernels::ForceBounds low, high;
};

/// Bounds from the force on each mode.
ForceBoundsOfParts bounds_by_mode(const StringModel& model, const ExcitationState& excitation) {
    const std::size_t low = std::min(low_modes(model), excitation.modes);
    const auto first = static_cast<double>(excitation.elapsed);
    const auto last = static_cast<double>(excitation.elapsed + model.shape->steps_per_frame);
    const auto bounds_of = [&](std::size_t begin, std::size_t end) {
        return kernels::force_bounds(begin, end, model.tuning.certificate, excitation.held.data(),
                                     excitation.ramp.data(), first, last);
    };
    return {bounds_of(0, low), bounds_of(low, excitation.modes)};
}

/// Bounds from the strength of held point forces: no mode's force exceeds sqrt(2/L) times it.
ForceBoundsOfParts bounds_by_strength(const StringModel& model, StringState& state) {
    const std::size_t modes = state.excitation.modes;
    UnitKick& unit = state.certificate.bounds.unit_kick;
    if (unit.modes != modes) {
        const std::size_t low = std::min(low_modes(model), modes);
        const kernels::ForceBounds of_low = kernels::unit_force_bounds(0, low, model.tuning.certificate);
        const kernels::ForceBounds of_high = kernels::unit_force_bounds(low, modes, model.tuning.certificate);
        unit = {modes, of_low.speed, of_low.detour, of_high.speed, of_high.extent, of_high.detour};
    }
    const double largest_N = state.excitation.strength_N * std::sqrt(2 / model.shape->length_m);
    ForceBoundsOfParts force;
    force.low.speed = force.low.variation = largest_N * unit.low_speed;
    force.low.detour = largest_N * unit.low_detour;
    force.high.speed = force.high.variation = largest_N * unit.high_speed;
    force.high.extent = largest_N * unit.high_extent;
    force.high.detour = largest_N * unit.high_detour;
    return force;
}

}  // namespace

bool needs_refresh(const StringState& state) JAWARI_REALTIME {
    const Validity& validity = state.certificate.validity;
    if (validity.outdated) return true;
    if (state.certificate.clear.valid) return validity.age >= refresh_period || !stays_passive(state);
    const std::uint64_t period = validity.excited ? excited_refresh_period : refresh_period;
    return validity.age >= period || validity.excited != is_excited(state);
}

std::uint64_t frames_until_refresh(const StringState& state) JAWARI_REALTIME {
    return needs_refresh(state) ? 0 : refresh_period - state.certificate.validity.age;
}

void refresh_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    GapBounds& bounds = state.certificate.bounds;
    Validity& validity = state.certificate.validity;
    const kernels::LargestBounds largest =
        kernels::mode_bounds(state.active_modes, model, state.displacement.data(), state.velocity.data(),
                             bounds.speed.data(), bounds.extent.data(), bounds.detour.data());
    bounds.strongest_speed = std::max(bounds.strongest_speed, largest.speed);
    bounds.strongest_extent = std::max(bounds.strongest_extent, largest.extent);
    const bool finite =
        std::isfinite(largest.speed) && std::isfinite(largest.extent);  // else left to the frame's check
    if (finite) {
        if (state.skipping.sleep && !is_excited(state) && has_faded(state, largest)) {
            fall_asleep(state);
            return;
        }
        if (state.skipping.lazy) drop_weak_modes(model, state, largest);
    }
    const bool clear = is_clear(model, state);
    state.certificate.clear.valid = clear;
    validity.direct = !clear && tests_directly(model, state);
    if (clear) {
        std::fill(bounds.open_until.begin(), bounds.open_until.end(),
                  -std::numeric_limits<double>::infinity());
    } else {
        set_group_speeds(model, state);
    }
    validity.age = 0;
    validity.outdated = false;
    validity.excited = is_excited(state);
    bounds.kicks = {};
    bounds.unit_kick.modes = 0;
}

void wake_modes(StringState& state, std::size_t modes) JAWARI_REALTIME {
    JAWARI_ASSERT(modes <= state.displacement.size());
    if (modes <= state.active_modes) return;
    GapBounds& bounds = state.certificate.bounds;
    for (auto* array : {&bounds.speed, &bounds.extent, &bounds.detour}) {
        std::fill(array->begin() + static_cast<std::ptrdiff_t>(state.active_modes),
                  array->begin() + static_cast<std::ptrdiff_t>(modes), 0.0);
    }
    state.active_modes = modes;
}

void add_kicks(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(is_excited(state));
    const ForceBoundsOfParts force =
        state.excitation.passive ? bounds_by_strength(model, state) : bounds_by_mode(model, state.excitation);
    KickState& kicks = state.certificate.bounds.kicks;
    const double frame_s = frame_length(model);
    const double largest_shape = bound_safety * std::sqrt(2 / model.shape->length_m);
    const double scale = largest_shape * frame_s;
    const double sagitta = largest_shape * frame_s * frame_s / 8;
    kicks.speed += scale * (force.low.speed + force.high.speed);
    kicks.overtones += scale * force.high.extent;
    kicks.detour += scale * (force.low.detour + force.high.detour);
    kicks.low_detour += scale * force.low.detour;
    kicks.frame_detour = sagitta * (force.low.variation + force.high.variation);
    kicks.frame_low_detour = sagitta * force.low.variation;
}

void complete_clearances(const StringModel& model, StringState& state,
                         const IndexList& groups) JAWARI_REALTIME {
    GapBounds& bounds = state.certificate.bounds;
    std::vector<double>& clearance = bounds.group_clearance;
    const IndexList& missing = complete(model, state, groups, bounds.extent,
                                        state.certificate.validity.group_has_clearance, clearance);
    for (const auto g : missing) {
        const double reach = bound_safety * clearance[g];  // of the string, from complete()
        clearance[g] = -reach - highest_obstacle(model, state, g);
    }
}

void complete_detours(const StringModel& model, StringState& state, const IndexList& groups) JAWARI_REALTIME {
    GapBounds& bounds = state.certificate.bounds;
    const IndexList& missing = complete(model, state, groups, bounds.detour,
                                        state.certificate.validity.group_has_detour, bounds.group_detour);
    for (const auto g : missing) bounds.group_detour[g] *= bound_safety;
}

}  // namespace jawari
