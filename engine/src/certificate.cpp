#include "certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact.h"
#include "impact_law.h"
#include "kernels.h"
#include "skipping_kernels.h"

namespace jawari {
namespace {

/// Bounds are widened by this share, far above the rounding of the sums that make them.
constexpr double safety = 1 + 1e-9;
/// In free flight bounds only become tighter when computed anew; this often is enough.
constexpr std::uint64_t refresh_period = 32;
constexpr std::uint64_t unknown_frame = std::numeric_limits<std::uint64_t>::max();

double frame_length(const StringModel& model) {
    return model.step_s * static_cast<double>(model.steps_per_frame);
}

double lookahead(const StringModel& model) {
    return looks_ahead(model.law) ? model.step_s / 2 : 0.0;
}

std::size_t group_count(const StringModel& model) {
    return model.certificate.group_begin.size() - 1;
}

/// With what the frame's excitation adds at most.
double group_speed(const StringState& state, std::size_t g) {
    const CertificateState& bounds = state.certificate;
    return bounds.group_speed[g] + (is_excited(state) ? safety * bounds.group_force_kick[g] : 0.0);
}

/// Modes behind the last one that matters are put to rest and leave the sums.
void drop_weak_modes(const StringModel& model, StringState& state, const kernels::LargestBounds& largest) {
    const CertificateState& bounds = state.certificate;
    std::size_t active = state.active_modes;
    while (active > state.excitation.modes && bounds.speed[active - 1] <= lazy_threshold * largest.speed &&
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

/// Modes that slept are at rest.
void wake_excited_modes(StringState& state) {
    state.active_modes = std::max(state.active_modes, state.excitation.modes);
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

/// kick_g = sum_k envelope_g kick_k times the largest modal impulse of the coming frame
void set_force_kicks(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    AlignedVector<double>& kick = bounds.detour;  // free at this moment
    const ExcitationState& excitation = state.excitation;
    const auto first = static_cast<double>(excitation.elapsed);
    const auto last = static_cast<double>(excitation.elapsed + model.steps_per_frame);
    for (std::size_t k = 0; k < model.stride; ++k) {
        const double largest = std::max(std::abs(excitation.held[k] + first * excitation.ramp[k]),
                                        std::abs(excitation.held[k] + last * excitation.ramp[k]));
        kick[k] = model.certificate.kick[k] * frame_length(model) * largest;
    }
    kernels::row_products(group_count(model), model.stride, model.stride, model.certificate.envelope.data(),
                          kick.data(), bounds.group_force_kick.data());
}

void set_group_bounds(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    const std::size_t groups = group_count(model);
    const double* envelope = model.certificate.envelope.data();
    const std::size_t n = state.active_modes;
    kernels::row_products(groups, n, model.stride, envelope, bounds.speed.data(), bounds.group_speed.data());
    kernels::row_products(groups, n, model.stride, envelope, bounds.detour.data(),
                          bounds.group_detour.data());
    kernels::row_products(groups, n, model.stride, envelope, bounds.extent.data(),
                          bounds.group_clearance.data());
    for (std::size_t g = 0; g < groups; ++g) {
        bounds.group_speed[g] *= safety;
        bounds.group_detour[g] *= safety;
        double highest = -std::numeric_limits<double>::infinity();
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            highest = std::max(highest, state.contact.height[c]);
            bounds.open_until[c] -= bounds.group_odometer[g];
        }
        bounds.group_odometer[g] = 0;
        bounds.group_clearance[g] = -safety * bounds.group_clearance[g] - highest;
    }
}

/// How far a group's gaps may move in the coming frame, the law's lookahead included.
double frame_travel(const StringModel& model, double speed) {
    return speed * (frame_length(model) + lookahead(model));
}

bool stays_clear(const StringModel& model, const StringState& state, std::size_t g) {
    return !is_excited(state) &&
           state.certificate.group_clearance[g] > lookahead(model) * state.certificate.group_speed[g];
}

/// Contacts whose odometer certificate does not cover the frame; their gaps at its start are computed.
std::size_t find_expired(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    std::size_t expired = 0;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        if (stays_clear(model, state, g)) continue;
        const double limit = bounds.group_odometer[g] + frame_travel(model, group_speed(state, g));
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            if (!(bounds.open_until[c] > limit)) bounds.expired[expired++] = static_cast<std::uint32_t>(c);
        }
    }
    return expired;
}

/// frame_gap <- S q - b for those of the listed contacts where it is not known.
void compute_frame_gaps(const StringModel& model, StringState& state, std::size_t expired) {
    CertificateState& bounds = state.certificate;
    std::size_t unknown = 0;
    std::vector<std::uint32_t>& list = state.contact.candidates;  // free between frames
    for (std::size_t i = 0; i < expired; ++i) {
        const auto c = bounds.expired[i];
        if (bounds.frame_gap_at[c] != state.frame) list[unknown++] = c;
    }
    kernels::indexed_row_products(list.data(), unknown, state.active_modes, model.stride,
                                  model.contact_rows.data(), state.displacement.data(),
                                  bounds.frame_gap.data());
    for (std::size_t i = 0; i < unknown; ++i) {
        const auto c = list[i];
        bounds.frame_gap[c] -= state.contact.height[c];
        bounds.frame_gap_at[c] = state.frame;
    }
    state.contact.candidate_count = 0;
}

std::size_t group_of(const StringModel& model, std::size_t contact) {
    const std::size_t size = model.certificate.group_begin[1];
    return contact / size;
}

/// Contacts that their gap at the frame's start and the speed bound certify leave the list.
std::size_t certify_by_speed(const StringModel& model, StringState& state, std::size_t expired) {
    CertificateState& bounds = state.certificate;
    std::size_t left = 0;
    for (std::size_t i = 0; i < expired; ++i) {
        const auto c = bounds.expired[i];
        const std::size_t g = group_of(model, c);
        bounds.open_until[c] = bounds.group_odometer[g] + bounds.frame_gap[c];
        if (!(bounds.frame_gap[c] > frame_travel(model, group_speed(state, g)))) bounds.expired[left++] = c;
    }
    return left;
}

/// Contacts that their gaps at both ends of the frame certify leave the list; the others are near.
void certify_by_both_ends(const StringModel& model, StringState& state, std::size_t left) {
    CertificateState& bounds = state.certificate;
    ContactState& contact = state.contact;
    kernels::indexed_row_products(bounds.expired.data(), left, state.active_modes, model.stride,
                                  model.contact_rows.data(), state.displacement_flown.data(),
                                  bounds.frame_end_gap.data());
    for (std::size_t i = 0; i < left; ++i) {
        const auto c = bounds.expired[i];
        const std::size_t g = group_of(model, c);
        const double end_gap = bounds.frame_end_gap[c] - contact.height[c];
        const double force_kick = is_excited(state) ? safety * bounds.group_force_kick[g] : 0.0;
        const double dip = bounds.group_detour[g] + lookahead(model) * group_speed(state, g) +
                           force_kick * frame_length(model);
        bounds.margin[c] = std::min(bounds.frame_gap[c], end_gap) - dip;
        if (!(bounds.margin[c] > 0)) {
            contact.near[contact.near_count++] = c;
            contact.is_near[c] = 1;
        }
        // Holds at the frame's end, when the odometer has moved on by the frame's travel.
        bounds.open_until[c] =
            bounds.group_odometer[g] + group_speed(state, g) * frame_length(model) + end_gap;
        bounds.frame_gap[c] = end_gap;
        bounds.frame_gap_at[c] = state.frame + 1;
    }
}

/// Margins of the contacts that are not near, for the case that impulses happen in this frame.
void set_margins(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double limit = bounds.group_odometer[g] + frame_travel(model, group_speed(state, g));
        const bool clear = stays_clear(model, state, g);
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            // Of contacts certified by both ends the margin is known; their odometer reading is the frame's
            // end.
            if (bounds.frame_gap_at[c] == state.frame + 1) continue;
            bounds.margin[c] = clear ? bounds.group_clearance[g] - lookahead(model) * bounds.group_speed[g]
                                     : bounds.open_until[c] - limit;
        }
    }
}

void set_group_margins(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            if (state.contact.is_near[c] == 0) smallest = std::min(smallest, bounds.margin[c]);
        }
        bounds.group_margin[g] = smallest;
        bounds.group_push[g] = 0;
    }
}

/// What the step's impulses may move a group's gaps until the frame's end.
double push_of_step(const StringModel& model, const StringState& state, std::size_t g) {
    const ContactState& contact = state.contact;
    const double* push = model.certificate.push.data() + g * model.contact_count;
    double speed = 0;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto c = contact.candidates[i];
        speed += push[c] * contact.impulse[c];
    }
    const double time_left = model.step_s * static_cast<double>(state.steps_left) + lookahead(model);
    return safety * speed * time_left;
}

}  // namespace

bool needs_refresh(const StringState& state) JAWARI_REALTIME {
    return state.certificate.outdated || state.certificate.age >= refresh_period || is_excited(state);
}

void refresh_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    if (is_excited(state)) {
        wake_excited_modes(state);
        set_force_kicks(model, state);
    }
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
    set_group_bounds(model, state);
    bounds.age = 0;
    bounds.outdated = is_excited(state);
}

bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    for (std::size_t i = 0; i < contact.near_count; ++i) contact.is_near[contact.near[i]] = 0;
    contact.near_count = 0;
    const std::size_t expired = find_expired(model, state);
    if (expired == 0) return false;
    compute_frame_gaps(model, state, expired);
    const std::size_t left = certify_by_speed(model, state, expired);
    if (left == 0) return false;
    certify_by_both_ends(model, state, left);
    if (contact.near_count == 0) return false;
    set_margins(model, state);
    set_group_margins(model, state);
    return true;
}

bool admit_pushed_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    if (contact.near_count == model.contact_count) return false;
    CertificateState& bounds = state.certificate;
    bool admitted = false;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double push = bounds.group_push[g] + push_of_step(model, state, g);
        if (bounds.group_margin[g] > push) continue;
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t c = model.certificate.group_begin[g]; c < model.certificate.group_begin[g + 1];
             ++c) {
            if (contact.is_near[c] != 0) continue;
            if (bounds.margin[c] > push) {
                smallest = std::min(smallest, bounds.margin[c]);
                continue;
            }
            join_step(model, state, c);
            admitted = true;
        }
        bounds.group_margin[g] = smallest;
    }
    return admitted;
}

void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    bounds.outdated = true;
    if (state.contact.near_count == model.contact_count) return;
    for (std::size_t g = 0; g < group_count(model); ++g)
        bounds.group_push[g] += push_of_step(model, state, g);
}

void advance_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        bounds.group_odometer[g] += group_speed(state, g) * frame_length(model) + bounds.group_push[g];
        bounds.group_push[g] = 0;
    }
    bounds.age += 1;
}

void note_stepped_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    const ContactState& contact = state.contact;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        if (contact.is_near[c] != 0) {
            bounds.frame_gap[c] = contact.gap[c];
            bounds.frame_gap_at[c] = state.frame + 1;
            bounds.open_until[c] = bounds.group_odometer[group_of(model, c)] + contact.gap[c];
        } else if (bounds.frame_gap_at[c] == state.frame + 1) {
            bounds.frame_gap_at[c] = unknown_frame;
        }
    }
}

void forget_bounds(StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    bounds.outdated = true;
    std::fill(bounds.open_until.begin(), bounds.open_until.end(), -std::numeric_limits<double>::infinity());
    std::fill(bounds.frame_gap_at.begin(), bounds.frame_gap_at.end(), unknown_frame);
    std::fill(bounds.group_odometer.begin(), bounds.group_odometer.end(), 0.0);
    std::fill(bounds.group_push.begin(), bounds.group_push.end(), 0.0);
}

void choose_all_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    contact.near_count = model.contact_count;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        contact.near[c] = static_cast<std::uint32_t>(c);
        contact.is_near[c] = 1;
    }
}

}  // namespace jawari
