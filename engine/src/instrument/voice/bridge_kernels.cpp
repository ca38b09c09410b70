#include "instrument/voice/bridge_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "instrument/voice/bridge_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

HWY_INLINE Vec load(const AlignedVector<double>& x, std::size_t j) {
    return hn::Load(Lanes(), x.data() + j);
}

void mean_of_body(const BridgeModel& bridge, const double* HWY_RESTRICT y, const double* HWY_RESTRICT v,
                  double* HWY_RESTRICT mean) {
    const Lanes d;
    const Vec half = hn::Set(d, 0.5);
    for (std::size_t j = 0; j < bridge.stride; j += hn::Lanes(d)) {
        const Vec y0 = hn::Load(d, y + j);
        const Vec y1 = hn::MulAdd(load(bridge.yv, j), hn::Load(d, v + j), hn::Mul(load(bridge.yy, j), y0));
        hn::Store(hn::MulAdd(half, hn::Sub(y1, y0), y0), d, mean + j);
    }
}

void move_body(const BridgeModel& bridge, const double* HWY_RESTRICT force_N, double* HWY_RESTRICT y,
               double* HWY_RESTRICT v, double* HWY_RESTRICT path) {
    const Lanes d;
    for (std::size_t j = 0; j < bridge.stride; j += hn::Lanes(d)) {
        const Vec y0 = hn::Load(d, y + j), v0 = hn::Load(d, v + j), force = hn::Load(d, force_N + j);
        const Vec y1 = hn::MulAdd(load(bridge.yy, j), y0,
                                  hn::MulAdd(load(bridge.yv, j), v0, hn::Mul(load(bridge.y_held, j), force)));
        const Vec v1 = hn::MulAdd(load(bridge.vy, j), y0,
                                  hn::MulAdd(load(bridge.vv, j), v0, hn::Mul(load(bridge.v_held, j), force)));
        hn::Store(hn::Sub(y1, y0), d, path + j);
        hn::Store(y1, d, y + j);
        hn::Store(v1, d, v + j);
    }
}

BodyMotion hear_body(const BridgeModel& bridge, const double* HWY_RESTRICT v) {
    const Lanes d;
    Vec left = hn::Zero(d), right = hn::Zero(d);
    for (std::size_t j = 0; j < bridge.stride; j += hn::Lanes(d)) {
        const Vec speed = hn::Load(d, v + j);
        left = hn::MulAdd(load(bridge.gain_left, j), speed, left);
        right = hn::MulAdd(load(bridge.gain_right, j), speed, right);
    }
    return {hn::GetLane(hn::SumOfLanes(d, left)), hn::GetLane(hn::SumOfLanes(d, right))};
}

double energy_of_body(const BridgeModel& bridge, const double* HWY_RESTRICT y, const double* HWY_RESTRICT v) {
    const Lanes d;
    Vec sum = hn::Zero(d);
    for (std::size_t j = 0; j < bridge.stride; j += hn::Lanes(d)) {
        const Vec y0 = hn::Load(d, y + j), v0 = hn::Load(d, v + j);
        sum = hn::MulAdd(hn::Mul(load(bridge.mass_kg, j), v0), v0, sum);
        sum = hn::MulAdd(hn::Mul(load(bridge.stiffness, j), y0), y0, sum);
    }
    return hn::GetLane(hn::SumOfLanes(d, sum)) / 2;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(mean_of_body);
HWY_EXPORT(move_body);
HWY_EXPORT(hear_body);
HWY_EXPORT(energy_of_body);

void mean_of_body(const BridgeModel& bridge, const double* y, const double* v, double* mean) noexcept {
    HWY_DYNAMIC_DISPATCH(mean_of_body)(bridge, y, v, mean);
}

void move_body(const BridgeModel& bridge, const double* force_N, double* y, double* v,
               double* path) noexcept {
    HWY_DYNAMIC_DISPATCH(move_body)(bridge, force_N, y, v, path);
}

BodyMotion hear_body(const BridgeModel& bridge, const double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(hear_body)(bridge, v);
}

double energy_of_body(const BridgeModel& bridge, const double* y, const double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(energy_of_body)(bridge, y, v);
}

}  // namespace jawari::kernels
#endif
