#include "string/kernels/mode_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/mode_sums.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

void free_velocity(std::size_t n, const double* HWY_RESTRICT carry, const double* HWY_RESTRICT change,
                   const double* HWY_RESTRICT restoring, const double* HWY_RESTRICT q,
                   const double* HWY_RESTRICT v, double* HWY_RESTRICT out) {
    const Lanes d;
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec velocity = hn::Load(d, v + k);
        // The small change is summed first, so that only one rounding is of the size of v.
        const Vec delta = hn::MulAdd(hn::Load(d, change + k), velocity,
                                     hn::Mul(hn::Load(d, restoring + k), hn::Load(d, q + k)));
        hn::Store(hn::MulAdd(hn::Load(d, carry + k), velocity, delta), d, out + k);
    }
}

/// Four partial sums hide the latency of the additions.
double row_product(std::size_t n, const double* HWY_RESTRICT row, const double* HWY_RESTRICT x) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec s0 = hn::Zero(d), s1 = hn::Zero(d), s2 = hn::Zero(d), s3 = hn::Zero(d);
    std::size_t k = 0;
    for (; k + 4 * lanes <= n; k += 4 * lanes) {
        s0 = hn::MulAdd(hn::Load(d, row + k), hn::Load(d, x + k), s0);
        s1 = hn::MulAdd(hn::Load(d, row + k + lanes), hn::Load(d, x + k + lanes), s1);
        s2 = hn::MulAdd(hn::Load(d, row + k + 2 * lanes), hn::Load(d, x + k + 2 * lanes), s2);
        s3 = hn::MulAdd(hn::Load(d, row + k + 3 * lanes), hn::Load(d, x + k + 3 * lanes), s3);
    }
    for (; k < n; k += lanes) s0 = hn::MulAdd(hn::Load(d, row + k), hn::Load(d, x + k), s0);
    return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(s0, s1), hn::Add(s2, s3))));
}

/// Four rows share each load of x.
HWY_INLINE void four_row_products(std::size_t n, const double* HWY_RESTRICT row0,
                                  const double* HWY_RESTRICT row1, const double* HWY_RESTRICT row2,
                                  const double* HWY_RESTRICT row3, const double* HWY_RESTRICT x,
                                  double (&sums)[4]) {
    const Lanes d;
    Vec s0 = hn::Zero(d), s1 = hn::Zero(d), s2 = hn::Zero(d), s3 = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec value = hn::Load(d, x + k);
        s0 = hn::MulAdd(hn::Load(d, row0 + k), value, s0);
        s1 = hn::MulAdd(hn::Load(d, row1 + k), value, s1);
        s2 = hn::MulAdd(hn::Load(d, row2 + k), value, s2);
        s3 = hn::MulAdd(hn::Load(d, row3 + k), value, s3);
    }
    sums[0] = hn::GetLane(hn::SumOfLanes(d, s0));
    sums[1] = hn::GetLane(hn::SumOfLanes(d, s1));
    sums[2] = hn::GetLane(hn::SumOfLanes(d, s2));
    sums[3] = hn::GetLane(hn::SumOfLanes(d, s3));
}

void row_products(std::size_t rows_count, std::size_t n, std::size_t stride, const double* HWY_RESTRICT rows,
                  const double* HWY_RESTRICT x, double* HWY_RESTRICT out) {
    std::size_t c = 0;
    double sums[4];
    for (; c + 4 <= rows_count; c += 4) {
        const double* row = rows + c * stride;
        four_row_products(n, row, row + stride, row + 2 * stride, row + 3 * stride, x, sums);
        for (std::size_t i = 0; i < 4; ++i) out[c + i] = sums[i];
    }
    for (; c < rows_count; ++c) out[c] = row_product(n, rows + c * stride, x);
}

void indexed_row_products(const std::uint32_t* HWY_RESTRICT indices, std::size_t count, std::size_t n,
                          std::size_t stride, const double* HWY_RESTRICT rows, const double* HWY_RESTRICT x,
                          double* HWY_RESTRICT out) {
    std::size_t i = 0;
    double sums[4];
    for (; i + 4 <= count; i += 4) {
        const std::uint32_t* c = indices + i;
        four_row_products(n, rows + c[0] * stride, rows + c[1] * stride, rows + c[2] * stride,
                          rows + c[3] * stride, x, sums);
        for (std::size_t j = 0; j < 4; ++j) out[c[j]] = sums[j];
    }
    for (; i < count; ++i) out[indices[i]] = row_product(n, rows + indices[i] * stride, x);
}

void add_rows(const std::uint32_t* HWY_RESTRICT indices, std::size_t count, const double* HWY_RESTRICT scales,
              std::size_t n, std::size_t stride, const double* HWY_RESTRICT rows, double* HWY_RESTRICT y) {
    const Lanes d;
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        Vec even = hn::Load(d, y + k);
        Vec odd = hn::Zero(d);
        std::size_t i = 0;
        for (; i + 2 <= count; i += 2) {
            const std::uint32_t* c = indices + i;
            even = hn::MulAdd(hn::Set(d, scales[c[0]]), hn::Load(d, rows + c[0] * stride + k), even);
            odd = hn::MulAdd(hn::Set(d, scales[c[1]]), hn::Load(d, rows + c[1] * stride + k), odd);
        }
        if (i < count)
            even =
                hn::MulAdd(hn::Set(d, scales[indices[i]]), hn::Load(d, rows + indices[i] * stride + k), even);
        hn::Store(hn::Add(even, odd), d, y + k);
    }
}

void add_impulse(std::size_t n, double scale, const double* HWY_RESTRICT mobility,
                 const double* HWY_RESTRICT row, double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec factor = hn::Set(d, scale);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec response = hn::Mul(hn::Load(d, mobility + k), hn::Load(d, row + k));
        hn::Store(hn::MulAdd(factor, response, hn::Load(d, v + k)), d, v + k);
    }
}

/// Rows that share each load of v and of the mobility.
constexpr std::size_t impulses_together = 4;

template <std::size_t count>
HWY_INLINE void add_impulses_of(std::size_t n, const double* scales, const double* const* rows,
                                const double* HWY_RESTRICT mobility, double* HWY_RESTRICT v) {
    const Lanes d;
    Vec scale[count];
    const double* row[count];
    for (std::size_t i = 0; i < count; ++i) {
        scale[i] = hn::Set(d, scales[i]);
        row[i] = rows[i];
    }
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec moves = hn::Load(d, mobility + k);
        Vec velocity = hn::Load(d, v + k);
        for (std::size_t i = 0; i < count; ++i)
            velocity = hn::MulAdd(scale[i], hn::Mul(moves, hn::Load(d, row[i] + k)), velocity);
        hn::Store(velocity, d, v + k);
    }
}

void add_impulses(const std::uint32_t* HWY_RESTRICT indices, std::size_t count,
                  const double* HWY_RESTRICT impulses, std::size_t n, std::size_t stride,
                  const double* HWY_RESTRICT mobility, const double* HWY_RESTRICT rows,
                  double* HWY_RESTRICT v) {
    double scales[impulses_together];
    const double* taken[impulses_together];
    std::size_t held = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t c = indices[i];
        if (impulses[c] <= 0) continue;
        scales[held] = impulses[c];
        taken[held++] = rows + c * stride;
        if (held < impulses_together) continue;
        add_impulses_of<impulses_together>(n, scales, taken, mobility, v);
        held = 0;
    }
    if (held == 3) add_impulses_of<3>(n, scales, taken, mobility, v);
    if (held == 2) add_impulses_of<2>(n, scales, taken, mobility, v);
    if (held == 1) add_impulses_of<1>(n, scales, taken, mobility, v);
}

void add_scaled(std::size_t n, double scale, const double* HWY_RESTRICT x, double* HWY_RESTRICT y) {
    const Lanes d;
    const Vec factor = hn::Set(d, scale);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        hn::Store(hn::MulAdd(factor, hn::Load(d, x + k), hn::Load(d, y + k)), d, y + k);
    }
}

double energy(std::size_t n, const double* HWY_RESTRICT kinetic, const double* HWY_RESTRICT potential,
              double lag, const double* HWY_RESTRICT q, const double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec minus_lag = hn::Set(d, -lag);
    Vec sum = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec velocity = hn::Load(d, v + k);
        const Vec middle = hn::MulAdd(minus_lag, velocity, hn::Load(d, q + k));
        sum = hn::MulAdd(hn::Mul(hn::Load(d, kinetic + k), velocity), velocity, sum);
        sum = hn::MulAdd(hn::Mul(hn::Load(d, potential + k), middle), middle, sum);
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

double weighted_square(std::size_t n, const double* HWY_RESTRICT weight, double now,
                       const double* HWY_RESTRICT x_now, double before, const double* HWY_RESTRICT x_before) {
    const Lanes d;
    const Vec a = hn::Set(d, now);
    const Vec b = hn::Set(d, before);
    Vec sum = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec x = hn::MulAdd(a, hn::Load(d, x_now + k), hn::Mul(b, hn::Load(d, x_before + k)));
        sum = hn::MulAdd(hn::Mul(hn::Load(d, weight + k), x), x, sum);
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

template <std::size_t count>
HWY_INLINE void sum_of(std::size_t n, const double* HWY_RESTRICT scales, const double* const* rows,
                       double* HWY_RESTRICT sum) {
    const Lanes d;
    Vec scale[count];
    const double* row[count];
    for (std::size_t i = 0; i < count; ++i) {
        scale[i] = hn::Set(d, scales[i]);
        row[i] = rows[i];
    }
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        Vec total = hn::Mul(scale[0], hn::Load(d, row[0] + k));
        for (std::size_t i = 1; i < count; ++i) total = hn::MulAdd(scale[i], hn::Load(d, row[i] + k), total);
        hn::Store(total, d, sum + k);
    }
}

void sum_rows(std::size_t n, std::size_t count, const double* HWY_RESTRICT scales, const double* const* rows,
              double* HWY_RESTRICT sum) {
    if (count == 1) {
        sum_of<1>(n, scales, rows, sum);
        return;
    }
    sum_of<2>(n, scales, rows, sum);
    const Lanes d;
    for (std::size_t i = 2; i < count; ++i) {
        const Vec scale = hn::Set(d, scales[i]);
        for (std::size_t k = 0; k < n; k += hn::Lanes(d))
            hn::Store(hn::MulAdd(scale, hn::Load(d, rows[i] + k), hn::Load(d, sum + k)), d, sum + k);
    }
}

double finite_probe(std::size_t n, const double* HWY_RESTRICT x) {
    const Lanes d;
    Vec sum = hn::Zero(d);
    // 0 * x is 0 for finite x and NaN otherwise, and NaN stays.
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) sum = hn::MulAdd(hn::Load(d, x + k), hn::Zero(d), sum);
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

std::size_t target() {
    return static_cast<std::size_t>(HWY_TARGET);
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(free_velocity);
HWY_EXPORT(row_product);
HWY_EXPORT(row_products);
HWY_EXPORT(indexed_row_products);
HWY_EXPORT(add_rows);
HWY_EXPORT(add_impulse);
HWY_EXPORT(add_impulses);
HWY_EXPORT(add_scaled);
HWY_EXPORT(sum_rows);
HWY_EXPORT(energy);
HWY_EXPORT(weighted_square);
HWY_EXPORT(finite_probe);
HWY_EXPORT(target);

void free_velocity(std::size_t n, const double* carry, const double* change, const double* restoring,
                   const double* q, const double* v, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(free_velocity)(n, carry, change, restoring, q, v, out);
}

double row_product(std::size_t n, const double* row, const double* x) noexcept {
    return HWY_DYNAMIC_DISPATCH(row_product)(n, row, x);
}

void row_products(std::size_t rows_count, std::size_t n, std::size_t stride, const double* rows,
                  const double* x, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(row_products)(rows_count, n, stride, rows, x, out);
}

void indexed_row_products(const std::uint32_t* indices, std::size_t count, std::size_t n, std::size_t stride,
                          const double* rows, const double* x, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(indexed_row_products)(indices, count, n, stride, rows, x, out);
}

void add_rows(const std::uint32_t* indices, std::size_t count, const double* scales, std::size_t n,
              std::size_t stride, const double* rows, double* y) noexcept {
    HWY_DYNAMIC_DISPATCH(add_rows)(indices, count, scales, n, stride, rows, y);
}

void add_impulse(std::size_t n, double scale, const double* mobility, const double* row, double* v) noexcept {
    HWY_DYNAMIC_DISPATCH(add_impulse)(n, scale, mobility, row, v);
}

void add_impulses(const std::uint32_t* indices, std::size_t count, const double* impulses, std::size_t n,
                  std::size_t stride, const double* mobility, const double* rows, double* v) noexcept {
    HWY_DYNAMIC_DISPATCH(add_impulses)(indices, count, impulses, n, stride, mobility, rows, v);
}

void add_scaled(std::size_t n, double scale, const double* x, double* y) noexcept {
    HWY_DYNAMIC_DISPATCH(add_scaled)(n, scale, x, y);
}

void sum_rows(std::size_t n, std::size_t count, const double* scales, const double* const* rows,
              double* sum) noexcept {
    HWY_DYNAMIC_DISPATCH(sum_rows)(n, count, scales, rows, sum);
}

double energy(std::size_t n, const double* kinetic, const double* potential, double lag, const double* q,
              const double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(energy)(n, kinetic, potential, lag, q, v);
}

double weighted_square(std::size_t n, const double* weight, double now, const double* x_now, double before,
                       const double* x_before) noexcept {
    return HWY_DYNAMIC_DISPATCH(weighted_square)(n, weight, now, x_now, before, x_before);
}

bool all_finite(std::size_t n, const double* x) noexcept {
    return HWY_DYNAMIC_DISPATCH(finite_probe)(n, x) == 0;
}

const char* instruction_set() noexcept {
    return hwy::TargetName(static_cast<std::int64_t>(HWY_DYNAMIC_DISPATCH(target)()));
}

}  // namespace jawari::kernels
#endif
