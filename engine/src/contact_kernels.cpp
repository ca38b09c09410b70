#include "contact_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Vectors of contacts that are summed side by side.
constexpr std::size_t width = 6;
/// After so many pivots the table is made anew.
constexpr std::size_t pivots_of_a_table = 256;
/// A contact whose pivot is below this share of its diagonal depends on the active ones.
constexpr double dependent_pivot = 1e-11;
/// A solution whose residual is above this share of the worst violation is left to the general solver.
constexpr double largest_relative_residual = 1e-9;

/// Calls work.run<vectors>(c) for all vectors of contacts, `width` of them at a time.
template <class Work>
HWY_INLINE void for_contacts(std::size_t stride, const Work& work) {
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t c = 0;
    for (; c + width * lanes <= stride; c += width * lanes) work.template run<width>(c);
    for (; c + 2 * lanes <= stride; c += 2 * lanes) work.template run<2>(c);
    for (; c < stride; c += lanes) work.template run<1>(c);
}

/// sum += sum of weights[c'] rows[c'] over the listed contacts c', for the contacts from c on
template <std::size_t vectors>
HWY_INLINE void add_rows(const std::uint32_t* list, std::size_t count, const double* weights,
                         const double* rows, std::size_t stride, std::size_t c, Vec (&sum)[vectors]) {
    const Lanes d;
    for (std::size_t s = 0; s < count; ++s) {
        const double* row = rows + list[s] * stride + c;
        const Vec weight = hn::Set(d, weights[list[s]]);
        for (std::size_t i = 0; i < vectors; ++i)
            sum[i] = hn::MulAdd(hn::Load(d, row + i * hn::Lanes(d)), weight, sum[i]);
    }
}

// -------------------------------------------------------------------------------------------- the active set

void note_pivot(PivotTable& table, std::size_t j, bool enters) {
    table.pivots += 1;
    table.sign[j] = enters ? 1 : -1;
    const auto contact = static_cast<std::uint32_t>(j);
    if (enters) {
        table.active[table.active_count++] = contact;
        return;
    }
    const auto end = table.active.begin() + static_cast<std::ptrdiff_t>(table.active_count);
    const auto at = std::find(table.active.begin(), end, contact);
    std::copy(at + 1, end, at);
    table.active_count -= 1;
}

/// One step of the symmetric sweep (Beaton 1964; Stewart, "Matrix Algorithms" I, 3.4): contact j becomes
/// active or ceases to be. Afterwards the table is [S - A_BF A_FF^-1 A_FB, A_BF A_FF^-1; ., -A_FF^-1] again.
void sweep(const StringModel& model, PivotTable& table, std::size_t j) {
    const Lanes d;
    const std::size_t stride = model.contact_stride;
    double* pivot_row = table.values.data() + j * stride;
    const double pivot = pivot_row[j];
    const double scale = 1 / std::abs(pivot);
    for (std::size_t i = 0; i < model.contact_count; ++i) {
        if (i == j) continue;
        double* row = table.values.data() + i * stride;
        const double at_pivot = row[j];
        const Vec factor = hn::Set(d, -at_pivot / pivot);
        for (std::size_t c = 0; c < stride; c += hn::Lanes(d))
            hn::Store(hn::MulAdd(factor, hn::Load(d, pivot_row + c), hn::Load(d, row + c)), d, row + c);
        row[j] = at_pivot * scale;
    }
    const Vec factor = hn::Set(d, scale);
    for (std::size_t c = 0; c < stride; c += hn::Lanes(d))
        hn::Store(hn::Mul(factor, hn::Load(d, pivot_row + c)), d, pivot_row + c);
    pivot_row[j] = -1 / pivot;
    note_pivot(table, j, pivot > 0);
}

/// The table of the operator itself: nothing is active.
void begin_table(const StringModel& model, PivotTable& table) {
    const std::size_t size = model.contact_count * model.contact_stride;
    std::copy_n(model.compliance.data(), size, table.values.begin());
    std::fill(table.sign.begin(), table.sign.end(), -1.0);
    table.of = model.compliance.data();
    table.active_count = 0;
    table.pivots = 0;
}

/// Made anew for the contacts that are active, without the rounding that pivots have gathered.
void remake_table(const StringModel& model, PivotTable& table) {
    const std::size_t count = table.active_count;
    std::copy_n(table.active.begin(), count, table.kept.begin());
    begin_table(model, table);
    for (std::size_t i = 0; i < count; ++i) sweep(model, table, table.kept[i]);
    table.pivots = 0;
}

/// solution <- the impulses of active contacts and the gaps above target of all others
struct SolveTable {
    const PivotTable& table;
    const double* offset;
    std::size_t stride;
    double* solution;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        const Lanes d;
        Vec sum[vectors];
        for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::Zero(d);
        add_rows(table.active.data(), table.active_count, offset, table.values.data(), stride, c, sum);
        for (std::size_t i = 0; i < vectors; ++i) {
            const std::size_t at = c + i * hn::Lanes(d);
            const Vec sign = hn::Load(d, table.sign.data() + at);
            const Vec own = hn::IfThenElseZero(hn::Lt(sign, hn::Zero(d)), hn::Load(d, offset + at));
            hn::Store(hn::MulAdd(sign, sum[i], own), d, solution + at);
        }
    }
};

constexpr std::size_t none = limits::contacts;

/// The contact whose impulse or gap is negative by most, in the unit of gaps; impulses may not be negative at
/// all.
std::size_t worst_of(const StringModel& model, const PivotTable& table, double tolerance) {
    std::size_t worst = none;
    double lowest = 0;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        const bool active = table.sign[c] > 0;
        const double value = table.solution[c];
        if (!(value < (active ? 0 : -tolerance))) continue;
        const double gap = active ? value * model.compliance[c * model.contact_stride + c] : value;
        if (worst != none && gap >= lowest) continue;
        lowest = gap;
        worst = c;
    }
    return worst;
}

/// True if no entry of the solution is below -tolerance, and none of an impulse below 0.
HWY_INLINE bool is_feasible(const PivotTable& table, std::size_t stride, double tolerance) {
    const Lanes d;
    const Vec least = hn::Set(d, -tolerance);
    Vec worst = hn::Zero(d);
    for (std::size_t c = 0; c < stride; c += hn::Lanes(d)) {
        const Vec active = hn::Max(hn::Load(d, table.sign.data() + c), hn::Zero(d));
        const Vec slack =
            hn::Sub(hn::Load(d, table.solution.data() + c), hn::NegMulAdd(active, least, least));
        worst = hn::Min(worst, slack);
    }
    return hn::GetLane(hn::MinOfLanes(d, worst)) >= 0;
}

// -------------------------------------------------------------------------------------------------- one step

/// gap_free and offset = gap_free - tau of the step; returns the lowest offset.
HWY_INLINE double predict(const StringModel& model, StringState& state, std::size_t n) {
    const Lanes d;
    ContactState& contact = state.contact;
    const double* rates = state.short_frame.rates.data() + n * model.contact_stride;
    const Vec h = hn::Set(d, model.step_s);
    Vec lowest = hn::Zero(d);
    for (std::size_t c = 0; c < model.contact_stride; c += hn::Lanes(d)) {
        const Vec gap = hn::MulAdd(h, hn::Load(d, rates + c), hn::Load(d, contact.gap.data() + c));
        const Vec target = hn::Min(hn::Load(d, contact.gap_before.data() + c), hn::Zero(d));
        const Vec offset = hn::Sub(gap, target);
        hn::Store(gap, d, contact.gap_free.data() + c);
        hn::Store(offset, d, contact.offset.data() + c);
        lowest = hn::Min(lowest, offset);
    }
    return hn::GetLane(hn::MinOfLanes(d, lowest));
}

/// residual <- offset + A lambda
struct SumResiduals {
    const StringModel& model;
    ContactState& contact;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        const Lanes d;
        const std::size_t lanes = hn::Lanes(d);
        Vec sum[vectors];
        for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::Load(d, contact.offset.data() + c + i * lanes);
        add_rows(contact.candidates.data(), contact.candidate_count, contact.impulse.data(),
                 model.compliance.data(), model.contact_stride, c, sum);
        for (std::size_t i = 0; i < vectors; ++i)
            hn::Store(sum[i], d, contact.residual.data() + c + i * lanes);
    }
};

/// max |residual| over the candidates, which all have impulses here
double largest_residual(const ContactState& contact) {
    double largest = 0;
    for (std::size_t i = 0; i < contact.candidate_count; ++i)
        largest = std::max(largest, std::abs(contact.residual[contact.candidates[i]]));
    return largest;
}

/// The table's impulses, and one correction by what they leave. Returns the residual left.
double take_impulses(const StringModel& model, StringState& state, double tolerance) {
    ContactState& contact = state.contact;
    PivotTable& table = state.short_frame.table;
    contact.candidate_count = table.active_count;
    std::copy_n(table.active.begin(), table.active_count, contact.candidates.begin());
    std::fill_n(contact.impulse.begin(), model.contact_stride, 0.0);
    for (std::size_t i = 0; i < table.active_count; ++i)
        contact.impulse[table.active[i]] = table.solution[table.active[i]];
    for_contacts(model.contact_stride, SumResiduals{model, contact});
    const double residual = largest_residual(contact);
    if (!(residual > tolerance)) return residual;
    for_contacts(model.contact_stride,
                 SolveTable{table, contact.residual.data(), model.contact_stride, table.solution.data()});
    for (std::size_t i = 0; i < table.active_count; ++i) {
        const auto c = table.active[i];
        contact.impulse[c] = std::max(0.0, contact.impulse[c] + table.solution[c]);
    }
    for_contacts(model.contact_stride, SumResiduals{model, contact});
    return largest_residual(contact);
}

/// The step's impulses from the active set of the last one by principal pivots. Returns false if that takes
/// too many of them or a contact depends on the active ones; impulses are then unknown.
bool solve_by_pivots(const StringModel& model, StringState& state, double lowest) {
    PivotTable& table = state.short_frame.table;
    const double tolerance = -1e-13 * lowest;
    const std::size_t stride = model.contact_stride;
    if (table.of != model.compliance.data()) begin_table(model, table);
    if (table.pivots > pivots_of_a_table) remake_table(model, table);
    for (std::size_t pivots = 0; pivots <= 2 * model.contact_count; ++pivots) {
        for_contacts(stride, SolveTable{table, state.contact.offset.data(), stride, table.solution.data()});
        if (is_feasible(table, stride, tolerance)) {
            const double residual = take_impulses(model, state, tolerance);
            state.counters.worst_residual_m = std::max(state.counters.worst_residual_m, residual);
            return residual <= -largest_relative_residual * lowest;
        }
        const std::size_t j = worst_of(model, table, tolerance);
        const bool enters = j != none && table.sign[j] < 0;
        if (j == none ||
            (enters && !(table.values[j * stride + j] > dependent_pivot * model.compliance[j * stride + j])))
            return false;
        sweep(model, table, j);
    }
    return false;
}

/// The general solver, which handles every case; candidates <- the contacts with impulses.
void solve_in_general(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    state.short_frame.table.of = nullptr;
    contact.candidate_count = model.contact_count;
    std::iota(contact.candidates.begin(),
              contact.candidates.begin() + static_cast<std::ptrdiff_t>(model.contact_count), 0U);
    solve_impulses(model, state);
    std::size_t struck = 0;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        if (contact.impulse[c] > 0) contact.candidates[struck++] = static_cast<std::uint32_t>(c);
    }
    contact.candidate_count = struck;
    for_contacts(model.contact_stride, SumResiduals{model, contact});
}

/// short_frame.impulses, `struck` and the sums of the frame receive the step's impulses.
void keep_impulses(const StringModel& model, StringState& state, std::size_t n) {
    ContactState& contact = state.contact;
    ShortFrameState& frame = state.short_frame;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto c = contact.candidates[i];
        const double impulse = contact.impulse[c];
        if (!(impulse > 0)) continue;
        double* impulses = frame.impulses.data() + c * model.response_stride;
        if (contact.frame_impulse[c] == 0) {
            frame.struck[frame.struck_count++] = c;
            std::fill_n(impulses, model.response_stride, 0.0);
        }
        impulses[n] = impulse;
        contact.frame_impulse[c] += impulse;
        state.counters.impulses += 1;
    }
}

/// rates of a later step += what the step's impulses do to them
struct SpreadImpulses {
    const ContactState& contact;
    const double* responses;
    std::size_t stride;
    double* rates;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        const Lanes d;
        const std::size_t lanes = hn::Lanes(d);
        Vec sum[vectors];
        for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::Load(d, rates + c + i * lanes);
        add_rows(contact.candidates.data(), contact.candidate_count, contact.impulse.data(), responses,
                 stride, c, sum);
        for (std::size_t i = 0; i < vectors; ++i) hn::Store(sum[i], d, rates + c + i * lanes);
    }
};

void spread_impulses(const StringModel& model, StringState& state, std::size_t n) {
    const std::size_t stride = model.contact_stride;
    for (std::size_t later = n + 1; later < model.steps_per_frame; ++later) {
        const double* responses = model.step_response.data() + (later - n) * model.contact_count * stride;
        for_contacts(stride, SpreadImpulses{state.contact, responses, stride,
                                            state.short_frame.rates.data() + later * stride});
    }
}

/// gap_before <- gap, gap <- the gaps at the step's end, tau + residual with impulses and y_free without; the
/// lowest gap so far goes on into `lowest`.
template <bool struck>
HWY_INLINE Vec accept(const StringModel& model, ContactState& contact, Vec lowest) {
    const Lanes d;
    for (std::size_t c = 0; c < model.contact_stride; c += hn::Lanes(d)) {
        Vec gap = hn::Load(d, contact.gap_free.data() + c);
        if constexpr (struck) {
            const Vec target = hn::Min(hn::Load(d, contact.gap_before.data() + c), hn::Zero(d));
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
    state.short_frame.struck_count = 0;
    for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
        const double violation = predict(model, state, n);
        if (!(violation < 0)) {
            std::fill_n(contact.impulse.begin(), model.contact_stride, 0.0);
            lowest = accept<false>(model, contact, lowest);
            continue;
        }
        if (solve_by_pivots(model, state, violation)) {
            state.counters.solves += 1;
        } else {
            solve_in_general(model, state);
        }
        keep_impulses(model, state, n);
        spread_impulses(model, state, n);
        lowest = accept<true>(model, contact, lowest);
    }
    state.counters.candidates += model.steps_per_frame * model.contact_count;
    state.counters.worst_penetration_m =
        std::max(state.counters.worst_penetration_m, -hn::GetLane(hn::MinOfLanes(d, lowest)));
    Vec probe = hn::Zero(d);
    for (std::size_t c = 0; c < model.contact_stride; c += hn::Lanes(d))
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
