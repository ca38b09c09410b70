#include "string/kernels/mode_bounds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/mode_bounds.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include "string/model/contact_response.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

bool add_force_response(std::size_t n, const FlightModel& flight, const double* HWY_RESTRICT held,
                        const double* HWY_RESTRICT ramp, double elapsed, double* HWY_RESTRICT q,
                        double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec steps = hn::Set(d, elapsed);
    Vec probe = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        Vec force = hn::Load(d, held + k);
        Vec q_end = hn::Load(d, q + k);
        Vec v_end = hn::Load(d, v + k);
        if (ramp != nullptr) {
            const Vec rate = hn::Load(d, ramp + k);
            force = hn::MulAdd(steps, rate, force);
            q_end = hn::MulAdd(rate, hn::Load(d, flight.q_ramp.data() + k), q_end);
            v_end = hn::MulAdd(rate, hn::Load(d, flight.v_ramp.data() + k), v_end);
        }
        q_end = hn::MulAdd(force, hn::Load(d, flight.q_held.data() + k), q_end);
        v_end = hn::MulAdd(force, hn::Load(d, flight.v_held.data() + k), v_end);
        hn::Store(q_end, d, q + k);
        hn::Store(v_end, d, v + k);
        probe = hn::MulAdd(hn::Add(q_end, v_end), hn::Zero(d), probe);
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

ForceBounds force_bounds(std::size_t begin, std::size_t end, const CertificateTuning& certificate,
                         const double* HWY_RESTRICT held, const double* HWY_RESTRICT ramp, double first,
                         double last) {
    const Lanes d;
    const Vec first_step = hn::Set(d, first);
    const Vec last_step = hn::Set(d, last);
    Vec speed = hn::Zero(d), extent = hn::Zero(d), detour = hn::Zero(d), variation = hn::Zero(d);
    for (std::size_t k = begin; k < end; k += hn::Lanes(d)) {
        const Vec kick = hn::Load(d, certificate.kick.data() + k);
        const Vec force = hn::Load(d, held + k);
        const Vec rate = hn::Load(d, ramp + k);
        const Vec at_first = hn::MulAdd(first_step, rate, force);
        const Vec at_last = hn::MulAdd(last_step, rate, force);
        const Vec start = hn::Abs(at_first);
        const Vec kicked = hn::Mul(kick, hn::Max(start, hn::Abs(at_last)));
        speed = hn::Add(speed, kicked);
        extent = hn::MulAdd(hn::Load(d, certificate.extent.data() + k), kicked, extent);
        detour = hn::MulAdd(hn::Load(d, certificate.detour.data() + k), kicked, detour);
        variation = hn::MulAdd(kick, hn::Add(start, hn::Abs(hn::Sub(at_last, at_first))), variation);
    }
    return {hn::GetLane(hn::SumOfLanes(d, speed)), hn::GetLane(hn::SumOfLanes(d, extent)),
            hn::GetLane(hn::SumOfLanes(d, detour)), hn::GetLane(hn::SumOfLanes(d, variation))};
}

ForceBounds unit_force_bounds(std::size_t begin, std::size_t end, const CertificateTuning& certificate) {
    const Lanes d;
    Vec speed = hn::Zero(d), extent = hn::Zero(d), detour = hn::Zero(d);
    for (std::size_t k = begin; k < end; k += hn::Lanes(d)) {
        const Vec kick = hn::Load(d, certificate.kick.data() + k);
        speed = hn::Add(speed, kick);
        extent = hn::MulAdd(hn::Load(d, certificate.extent.data() + k), kick, extent);
        detour = hn::MulAdd(hn::Load(d, certificate.detour.data() + k), kick, detour);
    }
    const double speed_sum = hn::GetLane(hn::SumOfLanes(d, speed));
    return {speed_sum, hn::GetLane(hn::SumOfLanes(d, extent)), hn::GetLane(hn::SumOfLanes(d, detour)),
            speed_sum};
}

/// y <- y + scale (a - b) over any n, without alignment; without b where `mirrors` is false
template <bool mirrors>
HWY_INLINE void add_response(std::size_t n, double scale, const double* HWY_RESTRICT a,
                             const double* HWY_RESTRICT b, double* HWY_RESTRICT y) {
    const auto add = [&](auto d, std::size_t i) HWY_ATTR {
        auto response = hn::LoadU(d, a + i);
        if constexpr (mirrors) response = hn::Sub(response, hn::LoadU(d, b + i));
        hn::StoreU(hn::MulAdd(hn::Set(d, scale), response, hn::LoadU(d, y + i)), d, y + i);
    };
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) add(Lanes(), i);
    for (; i < n; ++i) add(hn::CappedTag<double, 1>(), i);
}

template <bool mirrors>
HWY_INLINE void spread_to(const StringModel& model, std::span<const std::uint32_t> near,
                          const StepImpulse& step, double* rates) {
    const std::size_t later = model.shape->steps_per_frame - step.step - 1;
    for (const std::uint32_t c : near) {
        const Response response = response_of(model, step.struck, c);
        add_response<mirrors>(later, step.impulse, response.direct + 1, response.mirrored + 1,
                              rates + step.step + 1);
        rates += model.shape->response_stride;
    }
}

void spread_impulse(const StringModel& model, std::span<const std::uint32_t> near, const StepImpulse& step,
                    double* rates) {
    if (model.shape->grid_node.empty()) {
        spread_to<false>(model, near, step, rates);
    } else {
        spread_to<true>(model, near, step, rates);
    }
}

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* HWY_RESTRICT q,
                          const double* HWY_RESTRICT v, double* HWY_RESTRICT speed,
                          double* HWY_RESTRICT extent, double* HWY_RESTRICT detour) {
    const Lanes d;
    const CertificateTuning& certificate = model.tuning.certificate;
    const Vec minus_half_step = hn::Set(d, -model.shape->step_s / 2);
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
HWY_EXPORT(force_bounds);
HWY_EXPORT(unit_force_bounds);
HWY_EXPORT(spread_impulse);
HWY_EXPORT(mode_bounds);

bool add_force_response(std::size_t n, const FlightModel& flight, const double* held, const double* ramp,
                        double elapsed, double* q, double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(add_force_response)(n, flight, held, ramp, elapsed, q, v);
}

ForceBounds force_bounds(std::size_t begin, std::size_t end, const CertificateTuning& certificate,
                         const double* held, const double* ramp, double first, double last) noexcept {
    return HWY_DYNAMIC_DISPATCH(force_bounds)(begin, end, certificate, held, ramp, first, last);
}

ForceBounds unit_force_bounds(std::size_t begin, std::size_t end,
                              const CertificateTuning& certificate) noexcept {
    return HWY_DYNAMIC_DISPATCH(unit_force_bounds)(begin, end, certificate);
}

void spread_impulse(const StringModel& model, std::span<const std::uint32_t> near, const StepImpulse& step,
                    double* rates) noexcept {
    HWY_DYNAMIC_DISPATCH(spread_impulse)(model, near, step, rates);
}

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept {
    return HWY_DYNAMIC_DISPATCH(mode_bounds)(n, model, q, v, speed, extent, detour);
}

}  // namespace jawari::kernels
#endif
