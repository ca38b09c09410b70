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

bool fly(std::size_t n, const FlightModel& flight, const double* HWY_RESTRICT q, const double* HWY_RESTRICT v,
         double* HWY_RESTRICT q_out, double* HWY_RESTRICT v_out) {
    const Lanes d;
    const double* qq = flight.qq.data();
    const double* qv = flight.qv.data();
    const double* vq = flight.vq.data();
    const double* vv = flight.vv.data();
    Vec probe = hn::Zero(d);  // 0 as long as all results are finite, NaN from then on
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec displacement = hn::Load(d, q + k);
        const Vec velocity = hn::Load(d, v + k);
        const Vec dq = hn::MulAdd(hn::Load(d, qq + k), displacement, hn::Mul(hn::Load(d, qv + k), velocity));
        const Vec dv = hn::MulAdd(hn::Load(d, vq + k), displacement, hn::Mul(hn::Load(d, vv + k), velocity));
        const Vec q_end = hn::Add(displacement, dq);
        const Vec v_end = hn::Add(velocity, dv);
        hn::Store(q_end, d, q_out + k);
        hn::Store(v_end, d, v_out + k);
        probe = hn::MulAdd(hn::Add(q_end, v_end), hn::Zero(d), probe);
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

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

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* HWY_RESTRICT q,
                          const double* HWY_RESTRICT v, double* HWY_RESTRICT speed,
                          double* HWY_RESTRICT extent, double* HWY_RESTRICT detour) {
    const Lanes d;
    const CertificateModel& certificate = model.certificate;
    const double h = model.step_s;
    const double frame_s = h * static_cast<double>(model.steps_per_frame);
    const Vec minus_half_step = hn::Set(d, -h / 2);
    const Vec per_step = hn::Set(d, 1 / h);
    const Vec one = hn::Set(d, 1.0);
    const Vec sagitta = hn::Set(d, frame_s * frame_s / 8);  // of a curve of curvature 1 over the frame
    Vec largest_speed = hn::Zero(d);
    Vec largest_extent = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec stiffness = hn::Load(d, certificate.stiffness.data() + k);
        const Vec displacement = hn::Load(d, q + k);
        const Vec velocity = hn::Load(d, v + k);
        const Vec v2 = hn::Mul(velocity, velocity);
        const Vec middle = hn::MulAdd(minus_half_step, velocity, displacement);
        const Vec middle2 = hn::Mul(middle, middle);
        const Vec r = hn::Sqrt(hn::MulAdd(stiffness, middle2, v2));
        const Vec a = hn::Sqrt(hn::MulAdd(hn::Load(d, certificate.extent_q.data() + k), middle2,
                                          hn::Mul(hn::Load(d, certificate.extent_v.data() + k), v2)));
        // The velocity obeys the same recurrence as the displacement, so the same bound holds for its own
        // rate of change.
        const Vec lost = hn::Sub(hn::Load(d, model.carry.data() + k), one);
        const Vec change = hn::MulAdd(hn::Add(lost, hn::Load(d, model.change.data() + k)), velocity,
                                      hn::Mul(hn::Load(d, model.restoring.data() + k), displacement));
        const Vec acceleration = hn::Mul(change, per_step);
        const Vec v_next = hn::Add(velocity, change);
        const Vec v_middle = hn::MulAdd(minus_half_step, acceleration, v_next);
        const Vec curvature =
            hn::Sqrt(hn::MulAdd(stiffness, hn::Mul(v_middle, v_middle), hn::Mul(acceleration, acceleration)));
        hn::Store(r, d, speed + k);
        hn::Store(a, d, extent + k);
        hn::Store(hn::Min(hn::Mul(sagitta, curvature), hn::Add(a, a)), d, detour + k);
        largest_speed = hn::Max(largest_speed, r);
        largest_extent = hn::Max(largest_extent, a);
    }
    return {hn::GetLane(hn::MaxOfLanes(d, largest_speed)), hn::GetLane(hn::MaxOfLanes(d, largest_extent))};
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(fly);
HWY_EXPORT(add_force_response);
HWY_EXPORT(mode_bounds);

bool fly(std::size_t n, const FlightModel& flight, const double* q, const double* v, double* q_out,
         double* v_out) noexcept {
    return HWY_DYNAMIC_DISPATCH(fly)(n, flight, q, v, q_out, v_out);
}

bool add_force_response(std::size_t n, const FlightModel& flight, const double* held, const double* ramp,
                        double elapsed, double* q, double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(add_force_response)(n, flight, held, ramp, elapsed, q, v);
}

LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept {
    return HWY_DYNAMIC_DISPATCH(mode_bounds)(n, model, q, v, speed, extent, detour);
}

}  // namespace jawari::kernels
#endif
