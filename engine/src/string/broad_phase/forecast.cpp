#include "string/broad_phase/forecast.h"

#include <algorithm>

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
    const KickState& kicks = state.certificate.bounds.kicks;
    return {kicks.overtones, kicks.low_detour + kicks.frame_low_detour, lookahead(model), kicks.speed};
}

/// What all modes but the low ones can displace a group's gaps by.
double overtones(const StringState& state, const Shared& shared, std::size_t g) {
    return state.certificate.forecast.group_overtones[g] + shared.overtones_m;
}

/// How far a gap may dip below the lower one of its low modes' gaps at the frame's ends, the law's lookahead
/// included.
double dip(const StringState& state, const Shared& shared, std::size_t g) {
    return state.certificate.forecast.group_detour[g] + shared.detour_m + overtones(state, shared, g) +
           shared.lookahead_s * (state.certificate.bounds.group_speed[g] + shared.speed_m_per_s);
}

/// Computes the bounds of the groups of watched contacts, where they are not known since the last refresh.
void complete_forecast_bounds(const StringModel& model, StringState& state) {
    ForecastState& forecast = state.certificate.forecast;
    std::vector<std::uint8_t>& known = state.certificate.validity.group_has_forecast;
    IndexList& missing = state.certificate.missing_groups;
    missing.clear();
    for (const auto c : forecast.watched) {
        const std::size_t g = group_of(model, c);
        if (known[g] != 0) continue;
        known[g] = 1;
        missing.push(g);
    }
    if (missing.empty()) return;
    const GapBounds& bounds = state.certificate.bounds;
    const std::size_t low = low_modes(model);
    const std::size_t high = state.active_modes > low ? state.active_modes - low : 0;
    const double* envelope = model.shape->certificate.envelope.data();
    kernels::indexed_row_products(missing.data(), missing.size(), low, model.shape->stride, envelope,
                                  bounds.detour.data(), forecast.group_detour.data());
    kernels::indexed_row_products(missing.data(), missing.size(), high, model.shape->stride, envelope + low,
                                  bounds.extent.data() + low, forecast.group_overtones.data());
    for (const auto g : missing) {
        forecast.group_detour[g] *= bound_safety;
        forecast.group_overtones[g] *= bound_safety;
    }
}

/// gap[c] <- S q - b of the contacts, low modes alone.
void low_gaps(const StringModel& model, const StringState& state, const IndexList& contacts,
              const AlignedVector<double>& displacement, std::vector<double>& gap) {
    kernels::indexed_row_products(contacts.data(), contacts.size(), low_modes(model), model.shape->stride,
                                  model.shape->contact_rows.data(), displacement.data(), gap.data());
    for (const auto c : contacts) gap[c] -= state.contact.height[c];
}

/// Computes the gaps at the frame's start of watched contacts that were not watched in the frame before.
void complete_low_gaps(const StringModel& model, StringState& state) {
    ForecastState& forecast = state.certificate.forecast;
    forecast.unknown.clear();
    for (const auto c : forecast.watched) {
        if (forecast.gap_at[c] != state.frame) forecast.unknown.push(c);
    }
    low_gaps(model, state, forecast.unknown, state.displacement, forecast.gap);
}

void fly_low_modes(const StringModel& model, StringState& state) {
    ForecastState& forecast = state.certificate.forecast;
    const std::size_t low = low_modes(model);
    kernels::FlightRun run;
    run.modes = low;
    run.frames = 1;
    run.flight = &model.tuning.flight;
    run.q = forecast.displacement.data();
    run.v = forecast.velocity.data();
    kernels::fly_frames(run);
}

/// Margin of a watched contact over the frame between the two gaps of its low modes.
double margin_of(const StringModel& model, const StringState& state, const Shared& shared, std::size_t c) {
    const ForecastState& forecast = state.certificate.forecast;
    return std::min(forecast.gap[c], forecast.gap_end[c]) - dip(state, shared, group_of(model, c));
}

/// A contact certified for the coming frame keeps its margin, and a reading that holds at the frame's end.
void certify_coming_frame(const StringModel& model, StringState& state, const Shared& shared, std::size_t c,
                          double margin) {
    GapBounds& bounds = state.certificate.bounds;
    const std::size_t g = group_of(model, c);
    bounds.margin[c] = margin;
    state.certificate.validity.certified_at[c] = state.frame;
    bounds.open_until[c] = bounds.group_odometer[g] +
                           (bounds.group_speed[g] + shared.speed_m_per_s) * frame_length(model) +
                           state.certificate.forecast.gap_end[c] - overtones(state, shared, g);
}

/// Sets readings that hold when the odometers have moved on by `frames`.
void set_readings_after(const StringModel& model, StringState& state, std::size_t frames) {
    GapBounds& bounds = state.certificate.bounds;
    const ForecastState& forecast = state.certificate.forecast;
    const double time = frame_length(model) * static_cast<double>(frames);
    const Shared shared = shared_by_groups(model, state);
    for (const auto c : forecast.watched) {
        const std::size_t g = group_of(model, c);
        bounds.open_until[c] = bounds.group_odometer[g] + gap_speed(state, g) * time + forecast.gap[c] -
                               overtones(state, shared, g);
    }
}

}  // namespace

std::size_t forecast_frames(const StringModel& model, StringState& state,
                            std::size_t frames) JAWARI_REALTIME {
    ForecastState& forecast = state.certificate.forecast;
    const IndexList& watched = forecast.watched;
    complete_forecast_bounds(model, state);
    std::copy_n(state.displacement.begin(), low_modes(model), forecast.displacement.begin());
    std::copy_n(state.velocity.begin(), low_modes(model), forecast.velocity.begin());
    low_gaps(model, state, watched, forecast.displacement, forecast.gap);
    const Shared shared = shared_by_groups(model, state);
    std::size_t certified = 0;
    for (; certified < frames; ++certified) {
        fly_low_modes(model, state);
        low_gaps(model, state, watched, forecast.displacement, forecast.gap_end);
        const bool open = std::all_of(watched.begin(), watched.end(), [&](std::uint32_t c) {
            return margin_of(model, state, shared, c) > 0;
        });
        if (!open) break;
        forecast.gap.swap(forecast.gap_end);
    }
    if (certified > 0) {
        set_readings_after(model, state, certified);
        return certified;
    }
    for (const auto c : watched) {
        const double margin = margin_of(model, state, shared, c);
        if (margin > 0) certify_coming_frame(model, state, shared, c, margin);
    }
    return 0;
}

void forecast_flown_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ForecastState& forecast = state.certificate.forecast;
    IndexList& expired = state.certificate.expired;
    expired.clear();
    complete_forecast_bounds(model, state);
    complete_low_gaps(model, state);
    low_gaps(model, state, forecast.watched, state.displacement_flown, forecast.gap_end);
    const Shared shared = shared_by_groups(model, state);
    for (const auto c : forecast.watched) {
        const double margin = margin_of(model, state, shared, c);
        if (margin > 0) {
            certify_coming_frame(model, state, shared, c, margin);
        } else {
            expired.push(c);
        }
        forecast.gap[c] = forecast.gap_end[c];
        forecast.gap_at[c] = state.frame + 1;
    }
}

}  // namespace jawari
