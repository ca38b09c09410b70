#include "string/broad_phase/forecast.h"

#include <algorithm>
#include <span>

#include "string/broad_phase/gap_bounds.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// What forces add to every group's bounds, and the law's lookahead: read once before a loop over contacts.
struct Shared {
    double overtones_m = 0;
    double detour_m = 0;
    double lookahead_s = 0;
    double speed_m_per_s = 0;
};

Shared shared_by_groups(const StringModel& model, const StringState& state) {
    const KickState& kicks = state.certificate.kicks;
    return {kicks.overtones, kicks.low_detour + kicks.frame_low_detour, lookahead(model), kicks.speed};
}

/// What all modes but the low ones can displace a group's gaps by.
double overtones(const StringState& state, const Shared& shared, std::size_t g) {
    return state.certificate.lookout.group_overtones[g] + shared.overtones_m;
}

/// What a gap may dip below both values of its low modes at a frame's ends, the law's lookahead included.
double dip(const StringState& state, const Shared& shared, std::size_t g) {
    const CertificateState& bounds = state.certificate;
    return bounds.lookout.group_detour[g] + shared.detour_m + overtones(state, shared, g) +
           shared.lookahead_s * (bounds.group_speed[g] + shared.speed_m_per_s);
}

/// Bounds of the groups that watched contacts belong to, where they are not known since the last refresh.
void complete_lookouts(const StringModel& model, StringState& state, std::size_t watched) {
    CertificateState& bounds = state.certificate;
    LookoutState& lookout = bounds.lookout;
    const std::size_t low = low_modes(model);
    const std::size_t high = state.active_modes > low ? state.active_modes - low : 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < watched; ++i) {
        const auto g = static_cast<std::uint32_t>(group_of(model, lookout.watched[i]));
        if (bounds.group_has_lookout[g] != 0) continue;
        bounds.group_has_lookout[g] = 1;
        bounds.missing_groups[count++] = g;
    }
    if (count == 0) return;
    const double* envelope = model.shape->certificate.envelope.data();
    kernels::indexed_row_products(bounds.missing_groups.data(), count, low, model.shape->stride, envelope,
                                  bounds.detour.data(), lookout.group_detour.data());
    kernels::indexed_row_products(bounds.missing_groups.data(), count, high, model.shape->stride,
                                  envelope + low, bounds.extent.data() + low, lookout.group_overtones.data());
    for (std::size_t i = 0; i < count; ++i) {
        const auto g = bounds.missing_groups[i];
        lookout.group_detour[g] *= bound_safety;
        lookout.group_overtones[g] *= bound_safety;
    }
}

/// gap[c] <- S q - b of the contacts, low modes alone.
void low_gaps(const StringModel& model, const StringState& state, std::span<const std::uint32_t> contacts,
              const AlignedVector<double>& displacement, std::vector<double>& gap) {
    kernels::indexed_row_products(contacts.data(), contacts.size(), low_modes(model), model.shape->stride,
                                  model.shape->contact_rows.data(), displacement.data(), gap.data());
    for (const auto c : contacts) gap[c] -= state.contact.height[c];
}

/// The gaps at the frame's start of watched contacts that were not watched in the frame before.
void complete_low_gaps(const StringModel& model, StringState& state, std::size_t watched) {
    LookoutState& lookout = state.certificate.lookout;
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < watched; ++i) {
        const auto c = lookout.watched[i];
        if (lookout.gap_at[c] != state.frame) lookout.unknown[unknown++] = c;
    }
    low_gaps(model, state, {lookout.unknown.data(), unknown}, state.displacement, lookout.gap);
}

void fly_low_modes(const StringModel& model, StringState& state) {
    LookoutState& lookout = state.certificate.lookout;
    const std::size_t low = low_modes(model);
    kernels::FlightRun run;
    run.modes = low;
    run.frames = 1;
    run.flight = &model.tuning.flight;
    run.q = lookout.displacement.data();
    run.v = lookout.velocity.data();
    kernels::fly_frames(run);
}

/// Margin of a watched contact over the frame between the two gaps of its low modes.
double margin_of(const StringModel& model, const StringState& state, const Shared& shared, std::size_t c) {
    const LookoutState& lookout = state.certificate.lookout;
    return std::min(lookout.gap[c], lookout.gap_end[c]) - dip(state, shared, group_of(model, c));
}

/// A contact certified for the coming frame keeps its margin, and a reading that holds at its end.
void note_coming_frame(const StringModel& model, StringState& state, const Shared& shared, std::size_t c,
                       double margin) {
    CertificateState& bounds = state.certificate;
    const std::size_t g = group_of(model, c);
    bounds.margin[c] = margin;
    bounds.certified_at[c] = state.frame;
    bounds.open_until[c] = bounds.group_odometer[g] +
                           (bounds.group_speed[g] + shared.speed_m_per_s) * frame_length(model) +
                           bounds.lookout.gap_end[c] - overtones(state, shared, g);
}

/// Readings that hold when the odometers have moved on by `frames`.
void note_end(const StringModel& model, StringState& state, std::size_t watched, std::size_t frames) {
    CertificateState& bounds = state.certificate;
    const LookoutState& lookout = bounds.lookout;
    const double time = frame_length(model) * static_cast<double>(frames);
    const Shared shared = shared_by_groups(model, state);
    for (std::size_t i = 0; i < watched; ++i) {
        const auto c = lookout.watched[i];
        const std::size_t g = group_of(model, c);
        bounds.open_until[c] = bounds.group_odometer[g] + gap_speed(state, g) * time + lookout.gap[c] -
                               overtones(state, shared, g);
    }
}

}  // namespace

std::size_t look_out(const StringModel& model, StringState& state, std::size_t watched,
                     std::size_t frames) JAWARI_REALTIME {
    LookoutState& lookout = state.certificate.lookout;
    const std::span<const std::uint32_t> contacts{lookout.watched.data(), watched};
    complete_lookouts(model, state, watched);
    std::copy_n(state.displacement.begin(), low_modes(model), lookout.displacement.begin());
    std::copy_n(state.velocity.begin(), low_modes(model), lookout.velocity.begin());
    low_gaps(model, state, contacts, lookout.displacement, lookout.gap);
    const Shared shared = shared_by_groups(model, state);
    std::size_t certified = 0;
    for (; certified < frames; ++certified) {
        fly_low_modes(model, state);
        low_gaps(model, state, contacts, lookout.displacement, lookout.gap_end);
        const bool open = std::all_of(contacts.begin(), contacts.end(), [&](std::uint32_t c) {
            return margin_of(model, state, shared, c) > 0;
        });
        if (!open) break;
        lookout.gap.swap(lookout.gap_end);
    }
    if (certified > 0) {
        note_end(model, state, watched, certified);
        return certified;
    }
    for (const auto c : contacts) {
        const double margin = margin_of(model, state, shared, c);
        if (margin > 0) note_coming_frame(model, state, shared, c, margin);
    }
    return 0;
}

std::size_t look_at_flown(const StringModel& model, StringState& state, std::size_t watched) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    LookoutState& lookout = bounds.lookout;
    complete_lookouts(model, state, watched);
    complete_low_gaps(model, state, watched);
    low_gaps(model, state, {lookout.watched.data(), watched}, state.displacement_flown, lookout.gap_end);
    const Shared shared = shared_by_groups(model, state);
    std::size_t uncertain = 0;
    for (std::size_t i = 0; i < watched; ++i) {
        const auto c = lookout.watched[i];
        const double margin = margin_of(model, state, shared, c);
        if (margin > 0) {
            note_coming_frame(model, state, shared, c, margin);
        } else {
            bounds.expired[uncertain++] = c;
        }
        lookout.gap[c] = lookout.gap_end[c];
        lookout.gap_at[c] = state.frame + 1;
    }
    return uncertain;
}

}  // namespace jawari
