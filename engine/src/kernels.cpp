#include "kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

void free_velocity(std::size_t n, const double* HWY_RESTRICT carry, const double* HWY_RESTRICT change,
                   const double* HWY_RESTRICT restoring, const double* HWY_RESTRICT q, double* HWY_RESTRICT v) {
    const Lanes d;
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec velocity = hn::Load(d, v + k);
        // The small change is summed first, so that only one rounding is of the size of v.
        const Vec delta = hn::MulAdd(hn::Load(d, change + k), velocity,
                                     hn::Mul(hn::Load(d, restoring + k), hn::Load(d, q + k)));
        hn::Store(hn::MulAdd(hn::Load(d, carry + k), velocity, delta), d, v + k);
    }
}

void row_products(std::size_t rows_count, std::size_t n, const double* HWY_RESTRICT rows,
                  const double* HWY_RESTRICT x, double* HWY_RESTRICT out) {
    const Lanes d;
    std::size_t c = 0;
    for (; c + 4 <= rows_count; c += 4) {  // four rows share each load of x
        const double* row = rows + c * n;
        Vec s0 = hn::Zero(d), s1 = hn::Zero(d), s2 = hn::Zero(d), s3 = hn::Zero(d);
        for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
            const Vec value = hn::Load(d, x + k);
            s0 = hn::MulAdd(hn::Load(d, row + k), value, s0);
            s1 = hn::MulAdd(hn::Load(d, row + n + k), value, s1);
            s2 = hn::MulAdd(hn::Load(d, row + 2 * n + k), value, s2);
            s3 = hn::MulAdd(hn::Load(d, row + 3 * n + k), value, s3);
        }
        out[c] = hn::GetLane(hn::SumOfLanes(d, s0));
        out[c + 1] = hn::GetLane(hn::SumOfLanes(d, s1));
        out[c + 2] = hn::GetLane(hn::SumOfLanes(d, s2));
        out[c + 3] = hn::GetLane(hn::SumOfLanes(d, s3));
    }
    for (; c < rows_count; ++c) {
        const double* row = rows + c * n;
        Vec sum = hn::Zero(d);
        for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
            sum = hn::MulAdd(hn::Load(d, row + k), hn::Load(d, x + k), sum);
        }
        out[c] = hn::GetLane(hn::SumOfLanes(d, sum));
    }
}

void add_impulse(std::size_t n, double scale, const double* HWY_RESTRICT mobility, const double* HWY_RESTRICT row,
                 double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec factor = hn::Set(d, scale);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec response = hn::Mul(hn::Load(d, mobility + k), hn::Load(d, row + k));
        hn::Store(hn::MulAdd(factor, response, hn::Load(d, v + k)), d, v + k);
    }
}

void add_scaled(std::size_t n, double scale, const double* HWY_RESTRICT x, double* HWY_RESTRICT y) {
    const Lanes d;
    const Vec factor = hn::Set(d, scale);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        hn::Store(hn::MulAdd(factor, hn::Load(d, x + k), hn::Load(d, y + k)), d, y + k);
    }
}

double energy(std::size_t n, const double* HWY_RESTRICT kinetic, const double* HWY_RESTRICT potential, double lag,
              const double* HWY_RESTRICT q, const double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec minus_lag = hn::Set(d, -lag);
    Vec sum = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec velocity = hn::Load(d, v + k);
        const Vec displacement = hn::Load(d, q + k);
        const Vec before = hn::MulAdd(minus_lag, velocity, displacement);
        sum = hn::MulAdd(hn::Mul(hn::Load(d, kinetic + k), velocity), velocity, sum);
        sum = hn::MulAdd(hn::Mul(hn::Load(d, potential + k), displacement), before, sum);
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

double weighted_square(std::size_t n, const double* HWY_RESTRICT weight, double now, const double* HWY_RESTRICT x_now,
                       double before, const double* HWY_RESTRICT x_before) {
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

double finite_probe(std::size_t n, const double* HWY_RESTRICT x) {
    const Lanes d;
    Vec sum = hn::Zero(d);
    // 0 * x is 0 for finite x and NaN otherwise, and NaN stays.
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) sum = hn::MulAdd(hn::Load(d, x + k), hn::Zero(d), sum);
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

std::size_t target() { return static_cast<std::size_t>(HWY_TARGET); }

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(free_velocity);
HWY_EXPORT(row_products);
HWY_EXPORT(add_impulse);
HWY_EXPORT(add_scaled);
HWY_EXPORT(energy);
HWY_EXPORT(weighted_square);
HWY_EXPORT(finite_probe);
HWY_EXPORT(target);

void free_velocity(std::size_t n, const double* carry, const double* change, const double* restoring, const double* q,
                   double* v) noexcept {
    HWY_DYNAMIC_DISPATCH(free_velocity)(n, carry, change, restoring, q, v);
}

void row_products(std::size_t rows_count, std::size_t n, const double* rows, const double* x, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(row_products)(rows_count, n, rows, x, out);
}

void add_impulse(std::size_t n, double scale, const double* mobility, const double* row, double* v) noexcept {
    HWY_DYNAMIC_DISPATCH(add_impulse)(n, scale, mobility, row, v);
}

void add_scaled(std::size_t n, double scale, const double* x, double* y) noexcept {
    HWY_DYNAMIC_DISPATCH(add_scaled)(n, scale, x, y);
}

double energy(std::size_t n, const double* kinetic, const double* potential, double lag, const double* q,
              const double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(energy)(n, kinetic, potential, lag, q, v);
}

double weighted_square(std::size_t n, const double* weight, double now, const double* x_now, double before,
                       const double* x_before) noexcept {
    return HWY_DYNAMIC_DISPATCH(weighted_square)(n, weight, now, x_now, before, x_before);
}

bool all_finite(std::size_t n, const double* x) noexcept { return HWY_DYNAMIC_DISPATCH(finite_probe)(n, x) == 0; }

const char* instruction_set() noexcept {
    return hwy::TargetName(static_cast<std::int64_t>(HWY_DYNAMIC_DISPATCH(target)()));
}

}  // namespace jawari::kernels
#endif
