#include "string/broad_phase/gap_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "string/broad_phase/forecast.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/contact/contact_stage.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

constexpr std::uint64_t unknown_frame = std::numeric_limits<std::uint64_t>::max();

/// How far a group's gaps may move in the coming frame, the law's lookahead included.
double frame_travel(const StringModel& model, double speed) {
    return speed * (frame_length(model) + lookahead(model));
}

bool stays_clear(const StringModel& model, const StringState& state, std::size_t g) {
    return !is_excited(state) &&
           state.certificate.group_clearance[g] > lookahead(model) * state.certificate.group_speed[g];
}

/// Contacts that neither their odometer nor their group's clearance certifies for `frames` coming frames. The
/// clearances of groups whose odometers run out are completed.
std::size_t find_watched(const StringModel& model, StringState& state, double frames) {
    CertificateState& bounds = state.certificate;
    std::size_t groups = 0;
    const auto limit_of = [&](std::size_t g) {
        return bounds.group_odometer[g] +
               gap_speed(state, g) * (frame_length(model) * frames + lookahead(model));
    };
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const auto begin = bounds.open_until.begin();
        const auto first = begin + static_cast<std::ptrdiff_t>(model.shape->certificate.group_begin[g]);
        const auto last = begin + static_cast<std::ptrdiff_t>(model.shape->certificate.group_begin[g + 1]);
        if (!(*std::min_element(first, last) > limit_of(g)))
            bounds.expired_groups[groups++] = static_cast<std::uint32_t>(g);
    }
    complete_clearances(model, state, {bounds.expired_groups.data(), groups});
    std::size_t watched = 0;
    for (std::size_t i = 0; i < groups; ++i) {
        const auto g = bounds.expired_groups[i];
        if (stays_clear(model, state, g)) continue;
        const double limit = limit_of(g);
        for (std::size_t c = model.shape->certificate.group_begin[g];
             c < model.shape->certificate.group_begin[g + 1]; ++c) {
            if (!(bounds.open_until[c] > limit))
                bounds.lookout.watched[watched++] = static_cast<std::uint32_t>(c);
        }
    }
    return watched;
}

/// The same for the coming frame under excitation, when no clearance holds.
std::size_t find_watched_under_force(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    const double time = frame_length(model) + lookahead(model);
    const double kick = bounds.kicks.speed;
    const double *open_until = bounds.open_until.data(), *odometer = bounds.group_odometer.data();
    const double* speed = bounds.group_speed.data();
    std::uint32_t* watched = bounds.lookout.watched.data();
    std::size_t count = 0;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const std::size_t g = group_of(model, c);
        watched[count] = static_cast<std::uint32_t>(c);
        count += open_until[c] > odometer[g] + (speed[g] + kick) * time ? 0 : 1;
    }
    return count;
}

/// Groups with a contact that its odometer does not certify for the coming frame.
std::size_t find_expired_groups(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    std::size_t expired = 0;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        const std::size_t end = model.shape->certificate.group_begin[g + 1];
        for (std::size_t c = model.shape->certificate.group_begin[g]; c < end; ++c) {
            if (bounds.open_until[c] > limit) continue;
            bounds.expired_groups[expired++] = static_cast<std::uint32_t>(g);
            break;
        }
    }
    return expired;
}

/// Contacts that neither their odometer nor their group's clearance certifies.
std::size_t find_expired(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    const std::size_t groups = find_expired_groups(model, state);
    complete_clearances(model, state, {bounds.expired_groups.data(), groups});
    std::size_t expired = 0;
    for (std::size_t i = 0; i < groups; ++i) {
        const auto g = bounds.expired_groups[i];
        if (stays_clear(model, state, g)) continue;
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        for (std::size_t c = model.shape->certificate.group_begin[g];
             c < model.shape->certificate.group_begin[g + 1]; ++c) {
            if (bounds.open_until[c] > limit || bounds.certified_at[c] == state.frame) continue;
            bounds.expired[expired++] = static_cast<std::uint32_t>(c);
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
    kernels::indexed_row_products(list.data(), unknown, state.active_modes, model.shape->stride,
                                  model.shape->contact_rows.data(), state.displacement.data(),
                                  bounds.frame_gap.data());
    for (std::size_t i = 0; i < unknown; ++i) {
        const auto c = list[i];
        bounds.frame_gap[c] -= state.contact.height[c];
        bounds.frame_gap_at[c] = state.frame;
    }
    state.contact.candidate_count = 0;
}

/// Contacts that their gap at the frame's start and the speed bound certify leave the list.
std::size_t certify_by_speed(const StringModel& model, StringState& state, std::size_t expired) {
    CertificateState& bounds = state.certificate;
    std::size_t left = 0;
    for (std::size_t i = 0; i < expired; ++i) {
        const auto c = bounds.expired[i];
        const std::size_t g = group_of(model, c);
        bounds.open_until[c] = bounds.group_odometer[g] + bounds.frame_gap[c];
        if (!(bounds.frame_gap[c] > frame_travel(model, gap_speed(state, g)))) bounds.expired[left++] = c;
    }
    return left;
}

/// Contacts that neither odometers nor the lookout nor the speed bound certify; their gaps are computed.
std::size_t find_uncertain(const StringModel& model, StringState& state) {
    const std::size_t expired = is_excited(state)
                                    ? look_at_flown(model, state, find_watched_under_force(model, state))
                                    : find_expired(model, state);
    if (expired == 0) return 0;
    compute_frame_gaps(model, state, expired);
    return certify_by_speed(model, state, expired);
}

/// All contacts, with their gaps.
std::size_t take_all_gaps(const StringModel& model, StringState& state) {
    std::vector<std::uint32_t>& list = state.certificate.expired;
    std::iota(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(model.shape->contact_count), 0U);
    compute_frame_gaps(model, state, model.shape->contact_count);
    return model.shape->contact_count;
}

/// The detours of the groups that the first `left` expired contacts belong to.
void complete_detours_of(const StringModel& model, StringState& state, std::size_t left) {
    CertificateState& bounds = state.certificate;
    std::size_t groups = 0;
    for (std::size_t i = 0; i < left; ++i) {
        const auto g = static_cast<std::uint32_t>(group_of(model, bounds.expired[i]));
        if (groups == 0 || bounds.expired_groups[groups - 1] != g) bounds.expired_groups[groups++] = g;
    }
    complete_detours(model, state, {bounds.expired_groups.data(), groups});
}

/// Contacts that their gaps at both ends of the frame certify leave the list; the others are near.
void certify_by_both_ends(const StringModel& model, StringState& state, std::size_t left) {
    CertificateState& bounds = state.certificate;
    const KickState kicks = is_excited(state) ? bounds.kicks : KickState{};
    ContactState& contact = state.contact;
    kernels::indexed_row_products(bounds.expired.data(), left, state.active_modes, model.shape->stride,
                                  model.shape->contact_rows.data(), state.displacement_flown.data(),
                                  bounds.frame_end_gap.data());
    for (std::size_t i = 0; i < left; ++i) {
        const auto c = bounds.expired[i];
        const std::size_t g = group_of(model, c);
        const double end_gap = bounds.frame_end_gap[c] - contact.height[c];
        const double dip = bounds.group_detour[g] + kicks.detour + kicks.frame_detour +
                           lookahead(model) * gap_speed(state, g);
        bounds.margin[c] = std::min(bounds.frame_gap[c], end_gap) - dip;
        if (!(bounds.margin[c] > 0)) {
            contact.near[contact.near_count++] = c;
            contact.is_near[c] = 1;
        }
        // Holds at the frame's end, when the odometer has moved on by the frame's travel.
        bounds.open_until[c] = bounds.group_odometer[g] + gap_speed(state, g) * frame_length(model) + end_gap;
        bounds.frame_gap[c] = end_gap;
        bounds.frame_gap_at[c] = state.frame + 1;
    }
}

/// Margins of the contacts that are not near, for the case that impulses happen in this frame.
void set_margins(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double limit = bounds.group_odometer[g] + frame_travel(model, gap_speed(state, g));
        const bool clear = stays_clear(model, state, g);
        for (std::size_t c = model.shape->certificate.group_begin[g];
             c < model.shape->certificate.group_begin[g + 1]; ++c) {
            // Of contacts certified by both ends or by the lookout the margin is known; their odometer
            // reading is the frame's end.
            if (bounds.frame_gap_at[c] == state.frame + 1 || bounds.certified_at[c] == state.frame) continue;
            bounds.margin[c] = clear ? bounds.group_clearance[g] - lookahead(model) * bounds.group_speed[g]
                                     : bounds.open_until[c] - limit;
        }
    }
}

void set_group_margins(const StringModel& model, StringState& state) {
    CertificateState& bounds = state.certificate;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t c = model.shape->certificate.group_begin[g];
             c < model.shape->certificate.group_begin[g + 1]; ++c) {
            if (state.contact.is_near[c] == 0) smallest = std::min(smallest, bounds.margin[c]);
        }
        bounds.group_margin[g] = smallest;
        bounds.group_push[g] = 0;
    }
}

}  // namespace

void plan_free_frames(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    std::uint64_t frames = std::min<std::uint64_t>(frames_until_refresh(state), longest_plan);
    if (bounds.clear) {
        bounds.free_frames = frames;
        bounds.age += frames;
        return;
    }
    const auto speeds = bounds.group_speed.begin();
    const bool finite = std::all_of(speeds, speeds + static_cast<std::ptrdiff_t>(group_count(model)),
                                    [](double speed) { return std::isfinite(speed); });
    if (!finite) frames = 0;
    if (frames > 0) {
        const std::size_t watched = find_watched(model, state, static_cast<double>(frames));
        if (watched > 0) frames = look_out(model, state, watched, frames);
    }
    bounds.free_frames = frames;
    bounds.age += frames;
    const double time = frame_length(model) * static_cast<double>(frames);
    for (std::size_t g = 0; g < group_count(model); ++g)
        bounds.group_odometer[g] += bounds.group_speed[g] * time;
}

bool choose_near_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    for (std::size_t i = 0; i < contact.near_count; ++i) contact.is_near[contact.near[i]] = 0;
    contact.near_count = 0;
    if (state.leaves_obstacles) return false;
    if (is_excited(state)) add_kicks(model, state);
    const std::size_t left =
        state.certificate.direct ? take_all_gaps(model, state) : find_uncertain(model, state);
    if (left == 0) return false;
    complete_detours_of(model, state, left);
    certify_by_both_ends(model, state, left);
    if (contact.near_count == 0) return false;
    set_margins(model, state);
    set_group_margins(model, state);
    return true;
}

void advance_bounds(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    bounds.age += 1;
    if (bounds.clear) return;
    const double frame_s = frame_length(model);
    const double kick = bounds.kicks.speed;
    double *odometer = bounds.group_odometer.data(), *push = bounds.group_push.data();
    const double* speed = bounds.group_speed.data();
    const std::size_t groups = group_count(model);
    for (std::size_t g = 0; g < groups; ++g) {
        odometer[g] += (speed[g] + kick) * frame_s + push[g];
        push[g] = 0;
    }
    if (bounds.direct) bounds.outdated = true;  // odometers are to go on from a speed again
}

void note_stepped_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    const ContactState& contact = state.contact;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        if (contact.is_near[c] != 0) {
            bounds.frame_gap[c] = contact.gap[c];
            bounds.frame_gap_at[c] = state.frame + 1;
            bounds.open_until[c] = bounds.group_odometer[group_of(model, c)] + contact.gap[c];
        } else if (bounds.frame_gap_at[c] == state.frame + 1) {
            bounds.frame_gap_at[c] = unknown_frame;
        }
    }
    forget_low_gaps(state);
}

void forget_bounds(StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    bounds.outdated = true;
    bounds.clear = false;
    bounds.clear_limits_outdated = true;
    bounds.free_frames = 0;
    bounds.struck = false;
    bounds.presumed_near = 0;
    state.short_frame.gaps_at = unknown_frame;
    std::fill(bounds.open_until.begin(), bounds.open_until.end(), -std::numeric_limits<double>::infinity());
    std::fill(bounds.frame_gap_at.begin(), bounds.frame_gap_at.end(), unknown_frame);
    std::fill(bounds.certified_at.begin(), bounds.certified_at.end(), unknown_frame);
    forget_low_gaps(state);
    std::fill(bounds.group_odometer.begin(), bounds.group_odometer.end(), 0.0);
    std::fill(bounds.group_push.begin(), bounds.group_push.end(), 0.0);
}

void choose_all_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    contact.near_count = state.leaves_obstacles ? 0 : model.shape->contact_count;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        contact.near[c] = static_cast<std::uint32_t>(c);
        contact.is_near[c] = state.leaves_obstacles ? 0 : 1;
    }
}

}  // namespace jawari
