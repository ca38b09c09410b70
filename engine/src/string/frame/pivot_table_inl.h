// The Delassus operator swept over the active contacts: for each instruction set once, as Highway has it.
#if defined(JAWARI_PIVOT_TABLE_INL_H) == defined(HWY_TARGET_TOGGLE)  // NOLINT(llvm-header-guard)
#ifdef JAWARI_PIVOT_TABLE_INL_H
#undef JAWARI_PIVOT_TABLE_INL_H
#else
#define JAWARI_PIVOT_TABLE_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Vectors of contacts that are summed side by side.
constexpr std::size_t width = 6;
/// After so many pivots the table is made anew.
constexpr std::size_t pivots_of_a_table = 256;

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
HWY_INLINE void add_rows(std::span<const std::uint32_t> list, const double* weights, const double* rows,
                         std::size_t stride, std::size_t c, Vec (&sum)[vectors]) {
    const Lanes d;
    for (const std::size_t other : list) {
        const double* row = rows + other * stride + c;
        const Vec weight = hn::Set(d, weights[other]);
        for (std::size_t i = 0; i < vectors; ++i)
            sum[i] = hn::MulAdd(hn::Load(d, row + i * hn::Lanes(d)), weight, sum[i]);
    }
}

inline void note_pivot(const StringModel& model, PivotTable& table, std::size_t j, bool enters) {
    table.pivots += 1;
    table.sign[j] = enters ? 1 : -1;
    table.scale[j] = enters ? model.shape->compliance[j * model.shape->contact_stride + j] : 1;
    if (enters) {
        table.active.push(j);
    } else {
        table.active.remove(static_cast<std::uint32_t>(j));
    }
}

/// row <- row + factor pivot_row, but at contact j `at_pivot`. Whole vectors are stored, so that they can be
/// loaded again without waiting.
HWY_INLINE void eliminate(double* HWY_RESTRICT row, double factor, const double* HWY_RESTRICT pivot_row,
                          std::size_t stride, std::size_t j, double at_pivot) {
    const Lanes d;
    const Vec scale = hn::Set(d, factor);
    const std::size_t c_of_j = j / hn::Lanes(d) * hn::Lanes(d);
    const auto is_j = hn::Eq(hn::Iota(d, static_cast<double>(c_of_j)), hn::Set(d, static_cast<double>(j)));
    const Vec old = hn::Load(d, row + c_of_j);
    for (std::size_t c = 0; c < stride; c += hn::Lanes(d))
        hn::Store(hn::MulAdd(scale, hn::Load(d, pivot_row + c), hn::Load(d, row + c)), d, row + c);
    const Vec there = hn::MulAdd(scale, hn::Load(d, pivot_row + c_of_j), old);
    hn::Store(hn::IfThenElse(is_j, hn::Set(d, at_pivot), there), d, row + c_of_j);
}

/// row <- scale row, but at contact j `at_pivot`.
HWY_INLINE void scale_row(double* row, double scale, std::size_t stride, std::size_t j, double at_pivot) {
    const Lanes d;
    const Vec factor = hn::Set(d, scale);
    for (std::size_t c = 0; c < stride; c += hn::Lanes(d)) {
        const auto is_j = hn::Eq(hn::Iota(d, static_cast<double>(c)), hn::Set(d, static_cast<double>(j)));
        const Vec scaled = hn::Mul(factor, hn::Load(d, row + c));
        hn::Store(hn::IfThenElse(is_j, hn::Set(d, at_pivot), scaled), d, row + c);
    }
}

/// One step of the symmetric sweep (Goodnight, "A tutorial on the SWEEP operator", 1979): contact j becomes
/// active or ceases to be. Afterwards the table is again
///     [ A_BB - A_BF A_FF^-1 A_FB    A_BF A_FF^-1 ]
///     [ A_FF^-1 A_FB                -A_FF^-1     ]    for the active contacts F and all others B.
inline void sweep(const StringModel& model, PivotTable& table, std::size_t j) {
    const std::size_t stride = model.shape->contact_stride;
    double* pivot_row = table.values.data() + j * stride;
    const double pivot = pivot_row[j];
    const double inverse = 1 / pivot;
    const double scale = std::abs(inverse);
    for (std::size_t i = 0; i < model.shape->contact_count; ++i) {
        const double entry = pivot_row[i];  // the table is symmetric
        if (i != j)
            eliminate(table.values.data() + i * stride, -entry * inverse, pivot_row, stride, j,
                      entry * scale);
    }
    scale_row(pivot_row, scale, stride, j, -inverse);
    note_pivot(model, table, j, pivot > 0);
}

/// The table of the operator itself: nothing is active.
inline void begin_table(const StringModel& model, PivotTable& table) {
    const std::size_t size = model.shape->contact_count * model.shape->contact_stride;
    std::copy_n(model.shape->compliance.data(), size, table.values.begin());
    std::fill(table.sign.begin(), table.sign.end(), -1.0);
    std::fill(table.scale.begin(), table.scale.end(), 1.0);
    table.of = model.shape->compliance_id;
    table.active.clear();
    table.pivots = 0;
}

/// Made anew for the contacts that are active, without the rounding that pivots have gathered.
inline void remake_table(const StringModel& model, PivotTable& table) {
    table.kept = table.active;
    begin_table(model, table);
    for (const auto c : table.kept) sweep(model, table, c);
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
        add_rows(table.active.span(), offset, table.values.data(), stride, c, sum);
        for (std::size_t i = 0; i < vectors; ++i) {
            const std::size_t at = c + i * hn::Lanes(d);
            const Vec sign = hn::Load(d, table.sign.data() + at);
            const Vec own = hn::IfThenElseZero(hn::Lt(sign, hn::Zero(d)), hn::Load(d, offset + at));
            hn::Store(hn::MulAdd(sign, sum[i], own), d, solution + at);
        }
    }
};

constexpr std::size_t none = limits::contacts;

/// The contact whose impulse is negative, or whose gap is below -tolerance, by most, in the unit of gaps; or
/// `none`.
inline std::size_t worst_of(const StringModel& model, const PivotTable& table, double tolerance) {
    const Lanes d;
    const Vec zero = hn::Zero(d);
    const auto slack = [&](std::size_t c) HWY_ATTR {
        const Vec allowed = hn::Min(hn::Mul(hn::Load(d, table.sign.data() + c), hn::Set(d, tolerance)), zero);
        return hn::Mul(hn::Load(d, table.scale.data() + c),
                       hn::Sub(hn::Load(d, table.solution.data() + c), allowed));
    };
    Vec least = zero;
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d))
        least = hn::Min(least, slack(c));
    const double worst = hn::GetLane(hn::MinOfLanes(d, least));
    if (!(worst < 0)) return none;
    for (std::size_t c = 0; c < model.shape->contact_stride; c += hn::Lanes(d)) {
        const std::intptr_t lane = hn::FindFirstTrue(d, hn::Eq(slack(c), hn::Set(d, worst)));
        if (lane >= 0) return c + static_cast<std::size_t>(lane);
    }
    return none;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
