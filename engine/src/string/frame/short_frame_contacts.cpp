#include "string/frame/short_frame_contacts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/frame/short_frame_contacts.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "string/contact/contact_stage.h"
#include "string/frame/pivot_table_inl.h"
#include "string/frame/short_frame_modes.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// min(0, y_before + excused), impact_law.h
HWY_INLINE Vec signorini_target(Lanes d, const ContactState& contact, Vec excused, std::size_t c) {
    return hn::Min(hn::Add(hn::Load(d, contact.gap_before.data() + c), excused), hn::Zero(d));
}

/// gap_free and offset = gap_free - tau of the step; returns the lowest offset.
HWY_INLINE double predict(const StringModel& model, StringState& state, std::size_t n, Vec excused) {
    const Lanes d;
    ContactState& contact = state.contact;
    const double* rates = state.short_frame.rates.data() + n * model.shape->contact_stride;
    const Vec h = hn::Set(d, model.shape->step_s);
    Vec lowest = hn::Zero(d);
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        const Vec gap = hn::MulAdd(h, hn::Load(d, rates + c), hn::Load(d, contact.gap.data() + c));
        const Vec target = signorini_target(d, contact, excused, c);
        const Vec offset = hn::Sub(gap, target);
        hn::Store(gap, d, contact.gap_free.data() + c);
        hn::Store(offset, d, contact.offset.data() + c);
        lowest = hn::Min(lowest, offset);
    }
    return hn::GetLane(hn::MinOfLanes(d, lowest));
}

/// Contacts with impulses in a step.
using Struck = std::span<const std::uint32_t>;

/// residual <- offset + A lambda
struct SumResiduals {
    const StringModel& model;
    ContactState& contact;
    Struck struck;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        const Lanes d;
        const std::size_t lanes = hn::Lanes(d);
        Vec sum[vectors];
        for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::Load(d, contact.offset.data() + c + i * lanes);
        add_rows(struck, contact.impulse.data(), model.shape->compliance.data(), model.shape->contact_stride,
                 c, sum);
        for (std::size_t i = 0; i < vectors; ++i)
            hn::Store(sum[i], d, contact.residual.data() + c + i * lanes);
    }
};

/// impulse <- what the table found, or its correction; 0 where not active. Returns the largest |residual| of
/// active contacts.
template <bool corrects>
HWY_INLINE double take_impulses(const StringModel& model, StringState& state) {
    const Lanes d;
    const PivotTable& table = state.short_frame.table;
    ContactState& contact = state.contact;
    const Vec zero = hn::Zero(d);
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        const auto active = hn::Gt(hn::Load(d, table.sign.data() + c), zero);
        Vec impulse = hn::Load(d, table.solution.data() + c);
        if constexpr (corrects) impulse = hn::Add(impulse, hn::Load(d, contact.impulse.data() + c));
        hn::Store(hn::IfThenElseZero(active, hn::Max(impulse, zero)), d, contact.impulse.data() + c);
    }
    for_contacts(model.shape->contact_stride, SumResiduals{model, contact, table.active.span()});
    Vec largest = zero;
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        const auto active = hn::Gt(hn::Load(d, table.sign.data() + c), zero);
        const Vec residual = hn::Abs(hn::Load(d, contact.residual.data() + c));
        largest = hn::Max(largest, hn::IfThenElseZero(active, residual));
    }
    return hn::GetLane(hn::MaxOfLanes(d, largest));
}

/// The table's impulses, corrected by what they leave if that is more than rounding. Returns the residual
/// left.
double settle_impulses(const StringModel& model, StringState& state, double tolerance) {
    const double residual = take_impulses<false>(model, state);
    if (!(residual > tolerance)) return residual;
    PivotTable& table = state.short_frame.table;
    for_contacts(model.shape->contact_stride, SolveTable{table, state.contact.residual.data(),
                                                         model.shape->contact_stride, table.solution.data()});
    return take_impulses<true>(model, state);
}

/// The step's impulses from the active set of the last one by principal pivots. Returns false if that takes
/// too many of them or a contact depends on the active ones; impulses are then unknown.
bool solve_by_pivots(const StringModel& model, StringState& state, double lowest) {
    PivotTable& table = state.short_frame.table;
    const double tolerance = -table_tolerances.rounding * lowest;
    const std::size_t stride = model.shape->contact_stride;
    if (table.of != model.shape->compliance_id) begin_table(model, table);
    if (table.pivots > pivots_of_a_table) remake_table(model, table);
    for (std::size_t pivots = 0; pivots <= most_table_pivots(model.shape->contact_count); ++pivots) {
        for_contacts(stride, SolveTable{table, state.contact.offset.data(), stride, table.solution.data()});
        const std::size_t j = worst_of(model, table, tolerance);
        if (j == none) {
            const double residual = settle_impulses(model, state, tolerance);
            state.counters.worst_residual_m = std::max(state.counters.worst_residual_m, residual);
            state.contact.left_open = residual;
            return residual <= -table_tolerances.largest_residual * lowest;
        }
        const double least = table_tolerances.dependent_pivot * model.shape->compliance[j * stride + j];
        if (table.sign[j] < 0 && !(table.values[j * stride + j] > least)) return false;
        sweep(model, table, j);
    }
    return false;
}

/// The general solver, which handles every case; candidates <- the contacts with impulses.
void solve_in_general(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    state.short_frame.table.of = 0;
    contact.candidates.fill_to(model.shape->contact_count);
    solve_impulses(model, state);
    contact.candidates.filter([&](std::uint32_t c) { return contact.impulse[c] > 0; });
    for_contacts(model.shape->contact_stride, SumResiduals{model, contact, contact.candidates.span()});
}

/// The step's impulses and the contacts that have them.
Struck find_impulses(const StringModel& model, StringState& state, double lowest) {
    if (solve_by_pivots(model, state, lowest)) {
        state.counters.solves += 1;
        return state.short_frame.table.active.span();
    }
    solve_in_general(model, state);
    return state.contact.candidates.span();
}

/// short_frame.impulses of step n <- the step's impulses, which add to those of the frame.
HWY_INLINE void keep_impulses(const StringModel& model, StringState& state, std::size_t n) {
    const Lanes d;
    ContactState& contact = state.contact;
    double* kept = state.short_frame.impulses.data() + n * model.shape->contact_stride;
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        const Vec impulse = hn::Load(d, contact.impulse.data() + c);
        const Vec sum = hn::Add(hn::Load(d, contact.frame_impulse.data() + c), impulse);
        hn::Store(impulse, d, kept + c);
        hn::Store(sum, d, contact.frame_impulse.data() + c);
        state.counters.impulses += hn::CountTrue(d, hn::Gt(impulse, hn::Zero(d)));
    }
}

/// `struck` <- the contacts that had impulses in the frame.
void list_struck(const StringModel& model, StringState& state) {
    IndexList& struck = state.short_frame.struck;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c)
        struck.push_if(state.contact.frame_impulse[c] > 0, c);
}

/// rates of a later step += what the step's impulses do to them
struct SpreadImpulses {
    Struck struck;
    const double* impulse;
    const double* responses;
    std::size_t stride;
    double* rates;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        const Lanes d;
        const std::size_t lanes = hn::Lanes(d);
        Vec sum[vectors];
        for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::Load(d, rates + c + i * lanes);
        add_rows(struck, impulse, responses, stride, c, sum);
        for (std::size_t i = 0; i < vectors; ++i) hn::Store(sum[i], d, rates + c + i * lanes);
    }
};

/// The table of responses that holds for the struck contacts.
const double* responses_to(const StringModel& model, StringState& state, const Struck& struck) {
    if (!model.tuning.step_response.empty()) return model.tuning.step_response.data();
    const ShortFrameState& frame = state.short_frame;
    for (const auto c : struck) {
        if (frame.response_known[c] == 0) find_response(model, state, c);
    }
    return frame.step_response.data();
}

void spread_impulses(const StringModel& model, StringState& state, std::size_t n, const Struck& struck) {
    if (n + 1 == model.shape->steps_per_frame) return;
    const std::size_t stride = model.shape->contact_stride;
    const double* table = responses_to(model, state, struck);
    for (std::size_t later = n + 1; later < model.shape->steps_per_frame; ++later) {
        const double* responses = table + (later - n) * model.shape->contact_count * stride;
        for_contacts(stride, SpreadImpulses{struck, state.contact.impulse.data(), responses, stride,
                                            state.short_frame.rates.data() + later * stride});
    }
}

/// gap_before <- gap, gap <- the gaps at the step's end, tau + residual with impulses and y_free without; the
/// lowest gap so far goes on into `lowest`.
template <bool struck>
HWY_INLINE Vec accept(const StringModel& model, ContactState& contact, Vec excused, Vec lowest) {
    const Lanes d;
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        Vec gap = hn::Load(d, contact.gap_free.data() + c);
        if constexpr (struck) {
            const Vec target = signorini_target(d, contact, excused, c);
            gap = hn::Add(target, hn::Load(d, contact.residual.data() + c));
        }
        hn::Store(hn::Load(d, contact.gap.data() + c), d, contact.gap_before.data() + c);
        hn::Store(gap, d, contact.gap.data() + c);
        lowest = hn::Min(lowest, gap);
    }
    return lowest;
}

bool solve_steps(const StringModel& model, StringState& state) {
    const Lanes d;
    ContactState& contact = state.contact;
    Vec lowest = hn::Zero(d);
    bool any = false;
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        const Vec excused = hn::Set(d, excused_depth(model, contact));
        const double violation = predict(model, state, n, excused);
        if (violation < 0) {
            const Struck struck = find_impulses(model, state, violation);
            keep_impulses(model, state, n);
            spread_impulses(model, state, n, struck);
            lowest = accept<true>(model, contact, excused, lowest);
            any = true;
        } else {
            std::fill_n(contact.impulse.begin(), model.shape->contact_stride, 0.0);
            std::fill_n(state.short_frame.impulses.begin() +
                            static_cast<std::ptrdiff_t>(n * model.shape->contact_stride),
                        model.shape->contact_stride, 0.0);
            lowest = accept<false>(model, contact, excused, lowest);
        }
    }
    state.short_frame.struck.clear();
    if (any) list_struck(model, state);
    state.counters.candidates += model.shape->steps_per_frame * model.shape->contact_count;
    state.counters.worst_penetration_m =
        std::max(state.counters.worst_penetration_m, -hn::GetLane(hn::MinOfLanes(d, lowest)));
    Vec probe = hn::Zero(d);
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d))
        probe = hn::MulAdd(hn::Load(d, contact.gap.data() + c), hn::Zero(d), probe);
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(solve_steps);

bool solve_steps(const StringModel& model, StringState& state) noexcept {
    return HWY_DYNAMIC_DISPATCH(solve_steps)(model, state);
}

}  // namespace jawari::kernels
#endif
