#include "skipping_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "skipping_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

bool add_force_response(std::size_t n, const FlightModel& flight, double force, double rate,
                        const double* HWY_RESTRICT row, double* HWY_RESTRICT q, double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec f = hn::Set(d, force);
    const Vec r = hn::Set(d, rate);
    Vec probe = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec shape = hn::Load(d, row + k);
        const Vec q_unit = hn::MulAdd(f, hn::Load(d, flight.q_held.data() + k),
                                      hn::Mul(r, hn::Load(d, flight.q_ramp.data() + k)));
        const Vec v_unit = hn::MulAdd(f, hn::Load(d, flight.v_held.data() + k),
                                      hn::Mul(r, hn::Load(d, flight.v_ramp.data() + k)));
        const Vec q_end = hn::MulAdd(shape, q_unit, hn::Load(d, q + k));
        const Vec v_end = hn::MulAdd(shape, v_unit, hn::Load(d, v + k));
        hn::Store(q_end, d, q + k);
        hn::Store(v_end, d, v + k);
        probe = hn::MulAdd(hn::Add(q_end, v_end), hn::Zero(d), probe);
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

void add_difference(std::size_t n, double scale, const double* HWY_RESTRICT a, const double* HWY_RESTRICT b,
                    double* HWY_RESTRICT y) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const Vec factor = hn::Set(d, scale);
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) {
        const Vec difference = hn::Sub(hn::LoadU(d, a + i), hn::LoadU(d, b + i));
        hn::StoreU(hn::MulAdd(factor, difference, hn::LoadU(d, y + i)), d, y + i);
    }
    const hn::CappedTag<double, 1> one;
    for (; i < n; ++i) {
        const auto difference = hn::Sub(hn::LoadU(one, a + i), hn::LoadU(one, b + i));
        hn::StoreU(hn::MulAdd(hn::Set(one, scale), difference, hn::LoadU(one, y + i)), one, y + i);
    }
}

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* HWY_RESTRICT q,
                          const double* HWY_RESTRICT v, double* HWY_RESTRICT speed,
                          double* HWY_RESTRICT extent, double* HWY_RESTRICT detour) {
    const Lanes d;
    const CertificateModel& certificate = model.certificate;
    const Vec minus_half_step = hn::Set(d, -model.step_s / 2);
    Vec largest_speed = hn::Zero(d);
    Vec largest_extent = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec velocity = hn::Load(d, v + k);
        const Vec middle = hn::MulAdd(minus_half_step, velocity, hn::Load(d, q + k));
        const Vec stiff = hn::Mul(hn::Load(d, certificate.stiffness.data() + k), middle);
        const Vec r = hn::Sqrt(hn::MulAdd(stiff, middle, hn::Mul(velocity, velocity)));
        const Vec a = hn::Mul(r, hn::Load(d, certificate.extent.data() + k));
        hn::Store(r, d, speed + k);
        hn::Store(a, d, extent + k);
        hn::Store(hn::Mul(r, hn::Load(d, certificate.detour.data() + k)), d, detour + k);
        largest_speed = hn::Max(largest_speed, r);
        largest_extent = hn::Max(largest_extent, a);
    }
    return {hn::GetLane(hn::MaxOfLanes(d, largest_speed)), hn::GetLane(hn::MaxOfLanes(d, largest_extent))};
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(add_force_response);
HWY_EXPORT(add_difference);
HWY_EXPORT(mode_bounds);

bool add_force_response(std::size_t n, const FlightModel& flight, double force, double rate,
                        const double* row, double* q, double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(add_force_response)(n, flight, force, rate, row, q, v);
}

void add_difference(std::size_t n, double scale, const double* a, const double* b, double* y) noexcept {
    HWY_DYNAMIC_DISPATCH(add_difference)(n, scale, a, b, y);
}

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept {
    return HWY_DYNAMIC_DISPATCH(mode_bounds)(n, model, q, v, speed, extent, detour);
}

}  // namespace jawari::kernels
#endif
