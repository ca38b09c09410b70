#include "string/broad_phase/gap_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "string/broad_phase/forecast.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/contact/contact_stage.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// How far a group's gaps may move in the coming frame, the law's lookahead included.
double frame_travel(const StringModel& model, double speed) {
    return speed * (frame_length(model) + lookahead(model));
}

/// Whether the clearance certifies a group for as long as the string flies freely.
bool stays_clear(const StringModel& model, const StringState& state, std::size_t g) {
    const GapBounds& bounds = state.certificate.bounds;
    return !is_excited(state) &&
           bounds.group_clearance[g] > lookahead(model) * bounds.group_speed[g] + bounds.kicks.overtones;
}

/// forecast.watched <- contacts that neither their odometer nor their group's clearance certifies for
/// `frames` coming frames. The clearances of groups whose odometers run out are completed.
void find_watched(const StringModel& model, StringState& state, double frames) {
    const GapBounds& bounds = state.certificate.bounds;
    const auto limit_of = [&](std::size_t g) {
        return bounds.group_odometer[g] + bounds.kicks.overtones +
               gap_speed(state, g) * (frame_length(model) * frames + lookahead(model));
    };
    IndexList& groups = state.certificate.expired_groups;
    groups.clear();
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const IndexRange contacts = contacts_of(model, g);
        const double* open_until = bounds.open_until.data();
        if (!(*std::min_element(open_until + contacts.first, open_until + contacts.last) > limit_of(g)))
            groups.push(g);
    }
    complete_clearances(model, state, groups);
    IndexList& watched = state.certificate.forecast.watched;
    watched.clear();
    for (const auto g : groups) {
        if (stays_clear(model, state, g)) continue;
        const double limit = limit_of(g);
        for (const std::size_t c : contacts_of(model, g)) {
            if (!(bounds.open_until[c] > limit)) watched.push(c);
        }
    }
}

/// forecast.watched <- contacts that their odometer does not certify for the coming frame under excitation,
/// when no clearance holds.
void find_watched_under_force(const StringModel& model, StringState& state) {
    const GapBounds& bounds = state.certificate.bounds;
    const double time = frame_length(model) + lookahead(model);
    const double kick = bounds.kicks.speed;
    const double *open_until = bounds.open_until.data(), *odometer = bounds.group_odometer.data();
    const double* speed = bounds.group_speed.data();
    IndexList& watched = state.certificate.forecast.watched;
    watched.clear();
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const std::size_t g = group_of(model, c);
        watched.push_if(!(open_until[c] > odometer[g] + (speed[g] + kick) * time), c);
    }
}

/// expired_groups <- groups with a contact that its odometer does not certify for the coming frame.
void find_expired_groups(const StringModel& model, StringState& state) {
    const GapBounds& bounds = state.certificate.bounds;
    IndexList& groups = state.certificate.expired_groups;
    groups.clear();
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        for (const std::size_t c : contacts_of(model, g)) {
            if (bounds.open_until[c] > limit) continue;
            groups.push(g);
            break;
        }
    }
}

/// expired <- contacts that neither their odometer nor their group's clearance certifies.
void find_expired(const StringModel& model, StringState& state) {
    const GapBounds& bounds = state.certificate.bounds;
    const IndexList& groups = state.certificate.expired_groups;
    find_expired_groups(model, state);
    complete_clearances(model, state, groups);
    IndexList& expired = state.certificate.expired;
    expired.clear();
    for (const auto g : groups) {
        if (stays_clear(model, state, g)) continue;
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        for (const std::size_t c : contacts_of(model, g)) {
            const bool certified = state.certificate.validity.certified_at[c] == state.frame;
            if (!(bounds.open_until[c] > limit) && !certified) expired.push(c);
        }
    }
}

/// frame_gap <- S q - b for the expired contacts where it is not known.
void compute_frame_gaps(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    std::vector<std::uint64_t>& known_at = state.certificate.validity.frame_gap_at;
    IndexList& unknown = state.certificate.unknown_gaps;
    unknown.clear();
    for (const auto c : state.certificate.expired) {
        if (known_at[c] != state.frame) unknown.push(c);
    }
    kernels::indexed_row_products(unknown.data(), unknown.size(), state.active_modes, model.shape->stride,
                                  model.shape->contact_rows.data(), state.displacement.data(),
                                  bounds.frame_gap.data());
    for (const auto c : unknown) {
        bounds.frame_gap[c] -= state.contact.height[c];
        known_at[c] = state.frame;
    }
}

/// Expired contacts that their gap at the frame's start and the speed bound certify leave the list
/// (conservative advancement).
void certify_by_speed(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    state.certificate.expired.filter([&](std::uint32_t c) {
        const std::size_t g = group_of(model, c);
        bounds.open_until[c] = bounds.group_odometer[g] + bounds.frame_gap[c];
        return !(bounds.frame_gap[c] > frame_travel(model, gap_speed(state, g)));
    });
}

/// expired <- contacts that neither odometers nor the forecast nor the speed bound certify, with their gaps.
void find_uncertain(const StringModel& model, StringState& state) {
    if (is_excited(state)) {
        find_watched_under_force(model, state);
        forecast_flown_frame(model, state);
    } else {
        find_expired(model, state);
    }
    if (state.certificate.expired.empty()) return;
    compute_frame_gaps(model, state);
    certify_by_speed(model, state);
}

/// expired <- all contacts, with their gaps.
void take_all_gaps(const StringModel& model, StringState& state) {
    state.certificate.expired.fill_to(model.shape->contact_count);
    compute_frame_gaps(model, state);
}

/// Completes the detours of the groups that the expired contacts belong to.
void complete_detours_of_expired(const StringModel& model, StringState& state) {
    IndexList& groups = state.certificate.expired_groups;
    groups.clear();
    for (const auto c : state.certificate.expired) {
        const std::size_t g = group_of(model, c);
        if (groups.empty() || groups[groups.size() - 1] != g) groups.push(g);
    }
    complete_detours(model, state, groups);
}

/// Expired contacts whose gaps at both ends of the frame do not certify them become near.
void certify_by_both_ends(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    const IndexList& expired = state.certificate.expired;
    const KickState kicks = is_excited(state) ? bounds.kicks : KickState{};
    ContactState& contact = state.contact;
    kernels::indexed_row_products(expired.data(), expired.size(), state.active_modes, model.shape->stride,
                                  model.shape->contact_rows.data(), state.displacement_flown.data(),
                                  bounds.frame_end_gap.data());
    for (const auto c : expired) {
        const std::size_t g = group_of(model, c);
        const double end_gap = bounds.frame_end_gap[c] - contact.height[c];
        const double dip = bounds.group_detour[g] + kicks.detour + kicks.frame_detour +
                           lookahead(model) * gap_speed(state, g);
        bounds.margin[c] = std::min(bounds.frame_gap[c], end_gap) - dip;
        if (!(bounds.margin[c] > 0)) {
            make_near(contact, c);
        }
        // Holds at the frame's end, when the odometer has moved on by the frame's travel.
        bounds.open_until[c] = bounds.group_odometer[g] + gap_speed(state, g) * frame_length(model) + end_gap;
        bounds.frame_gap[c] = end_gap;
        state.certificate.validity.frame_gap_at[c] = state.frame + 1;
    }
}

/// Margins of the contacts that are not near, for the case that impulses happen in this frame.
void set_margins(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    const Validity& validity = state.certificate.validity;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        const bool clear = stays_clear(model, state, g);
        for (const std::size_t c : contacts_of(model, g)) {
            // Contacts certified by both ends or by the forecast have their margin; their odometer reading is
            // that of the frame's end.
            if (validity.frame_gap_at[c] == state.frame + 1 || validity.certified_at[c] == state.frame)
                continue;
            bounds.margin[c] = clear ? bounds.group_clearance[g] - lookahead(model) * bounds.group_speed[g]
                                     : bounds.open_until[c] - limit;
        }
    }
}

void set_group_margins(const StringModel& model, StringState& state) {
    GapBounds& bounds = state.certificate.bounds;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const std::size_t c : contacts_of(model, g)) {
            if (state.contact.is_near[c] == 0) smallest = std::min(smallest, bounds.margin[c]);
        }
        bounds.group_margin[g] = smallest;
        bounds.group_push[g] = 0;
    }
}

void clear_near_contacts(ContactState& contact) {
    for (const auto c : contact.near) contact.is_near[c] = 0;
    contact.near.clear();
}

/// How many of the next `frames` frames the odometers and the forecast certify for all contacts.
std::uint64_t certified_frames(const StringModel& model, StringState& state, std::uint64_t frames) {
    const auto speeds = state.certificate.bounds.group_speed.begin();
    const bool finite = std::all_of(speeds, speeds + static_cast<std::ptrdiff_t>(group_count(model)),
                                    [](double speed) { return std::isfinite(speed); });
    if (!finite || frames == 0) return 0;
    find_watched(model, state, static_cast<double>(frames));
    return state.certificate.forecast.watched.empty() ? frames : forecast_frames(model, state, frames);
}

}  // namespace

void plan_free_frames(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(planned_frames(state) == 0 && !is_excited(state) && !needs_refresh(state));
    GapBounds& bounds = state.certificate.bounds;
    Validity& validity = state.certificate.validity;
    const bool clear = state.certificate.clear.valid;
    std::uint64_t frames = std::min(frames_until_refresh(state), longest_plan);
    if (!clear) frames = certified_frames(model, state, frames);
    validity.odometers_at_frame = state.frame + frames;
    validity.age += frames;
    if (clear) return;
    const double time = frame_length(model) * static_cast<double>(frames);
    for (std::size_t g = 0; g < group_count(model); ++g)
        bounds.group_odometer[g] += bounds.group_speed[g] * time;
}

bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    clear_near_contacts(state.contact);
    if (state.leaves_obstacles) return false;
    if (is_excited(state)) add_kicks(model, state);
    if (state.certificate.validity.direct) {
        take_all_gaps(model, state);
    } else {
        find_uncertain(model, state);
    }
    if (state.certificate.expired.empty()) return false;
    complete_detours_of_expired(model, state);
    certify_by_both_ends(model, state);
    if (state.contact.near.empty()) return false;
    set_margins(model, state);
    set_group_margins(model, state);
    return true;
}

void advance_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    GapBounds& bounds = state.certificate.bounds;
    Validity& validity = state.certificate.validity;
    validity.age += 1;
    if (state.certificate.clear.valid) return;
    validity.odometers_at_frame = state.frame + 1;
    const double frame_s = frame_length(model);
    const double kick = bounds.kicks.speed;
    double *odometer = bounds.group_odometer.data(), *push = bounds.group_push.data();
    const double* speed = bounds.group_speed.data();
    const std::size_t groups = group_count(model);
    for (std::size_t g = 0; g < groups; ++g) {
        odometer[g] += (speed[g] + kick) * frame_s + push[g];
        push[g] = 0;
    }
    if (validity.direct) validity.outdated = true;  // odometers are to go on from a speed again
}

void note_stepped_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    GapBounds& bounds = state.certificate.bounds;
    std::vector<std::uint64_t>& known_at = state.certificate.validity.frame_gap_at;
    const ContactState& contact = state.contact;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        if (contact.is_near[c] != 0) {
            bounds.frame_gap[c] = contact.gap[c];
            known_at[c] = state.frame + 1;
            bounds.open_until[c] = bounds.group_odometer[group_of(model, c)] + contact.gap[c];
        } else if (known_at[c] == state.frame + 1) {
            known_at[c] = unknown_frame;
        }
    }
    forget_low_gaps(state);
}

void forget_bounds(StringState& state) JAWARI_REALTIME {
    CertificateState& certificate = state.certificate;
    GapBounds& bounds = certificate.bounds;
    Validity& validity = certificate.validity;
    certificate.struck = false;
    certificate.backoff.left = 0;
    certificate.clear.valid = false;
    certificate.clear.limits_valid = false;
    validity.outdated = true;
    validity.odometers_at_frame = state.frame;
    state.contact.stepping_in_frame = unknown_frame;
    state.short_frame.gaps_at = unknown_frame;
    std::fill(validity.frame_gap_at.begin(), validity.frame_gap_at.end(), unknown_frame);
    std::fill(validity.certified_at.begin(), validity.certified_at.end(), unknown_frame);
    forget_low_gaps(state);
    std::fill(bounds.open_until.begin(), bounds.open_until.end(), -std::numeric_limits<double>::infinity());
    std::fill(bounds.group_odometer.begin(), bounds.group_odometer.end(), 0.0);
    std::fill(bounds.group_push.begin(), bounds.group_push.end(), 0.0);
}

void choose_all_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    const std::uint8_t are_near = state.leaves_obstacles ? 0 : 1;
    contact.near.fill_to(state.leaves_obstacles ? 0 : model.shape->contact_count);
    std::fill_n(contact.is_near.begin(), model.shape->contact_count, are_near);
}

}  // namespace jawari
