#include "string/kernels/touched_flight.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/touched_flight.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Sums in the order of modes, with one sum for each row, as kernels::read() and free_paths() have them: the
/// numbers do not tell in how many sweeps they were made.
template <std::size_t count, bool looks_ahead>
HWY_INLINE bool fly_under(TouchedFlight& run) {
    const Lanes d;
    const FlightModel& flight = *run.flight;
    const Vec minus_lag = hn::Set(d, -run.lag);
    Vec force[count], middle[count], rise[count];
    const double* row[count];
    for (std::size_t i = 0; i < count; ++i) {
        force[i] = hn::Set(d, run.force_N[i]);
        middle[i] = rise[i] = hn::Zero(d);
        row[i] = run.row[i];
    }
    const double *HWY_RESTRICT qq = flight.qq.data(), *HWY_RESTRICT qv = flight.qv.data();
    const double *HWY_RESTRICT vq = flight.vq.data(), *HWY_RESTRICT vv = flight.vv.data();
    const double *HWY_RESTRICT q_held = flight.q_held.data(), *HWY_RESTRICT v_held = flight.v_held.data();
    const double *HWY_RESTRICT q_in = run.q, *HWY_RESTRICT v_in = run.v, *HWY_RESTRICT read = run.read_row;
    double *HWY_RESTRICT q_out = run.q_out, *HWY_RESTRICT v_out = run.v_out;
    Vec reading = hn::Zero(d), probe = hn::Zero(d);
    for (std::size_t k = 0; k < run.modes; k += hn::Lanes(d)) {
        const Vec q = hn::Load(d, q_in + k), v = hn::Load(d, v_in + k);
        const Vec a = hn::Load(d, qq + k), b = hn::Load(d, qv + k);
        const Vec c = hn::Load(d, vq + k), e = hn::Load(d, vv + k);
        Vec shape[count];
        for (std::size_t i = 0; i < count; ++i) shape[i] = hn::Load(d, row[i] + k);
        Vec held = hn::Mul(force[0], shape[0]);
        for (std::size_t i = 1; i < count; ++i) held = hn::MulAdd(force[i], shape[i], held);
        const Vec q_free = hn::MulAdd(b, v, hn::MulAdd(a, q, q));
        const Vec v_free = hn::MulAdd(c, q, hn::MulAdd(e, v, v));
        const Vec q_end = hn::MulAdd(held, hn::Load(d, q_held + k), q_free);
        const Vec v_end = hn::MulAdd(held, hn::Load(d, v_held + k), v_free);
        hn::Store(q_end, d, q_out + k);
        hn::Store(v_end, d, v_out + k);
        probe = hn::MulAdd(hn::Add(q_end, v_end), hn::Zero(d), probe);  // NaN from where one is not finite
        reading = hn::MulAdd(hn::Load(d, read + k), q_end, reading);
        if constexpr (looks_ahead) {
            const Vec now = hn::MulAdd(minus_lag, v_end, q_end);
            const Vec change =
                hn::MulAdd(hn::MulAdd(minus_lag, c, a), q_end, hn::Mul(hn::MulAdd(minus_lag, e, b), v_end));
            for (std::size_t i = 0; i < count; ++i) {
                middle[i] = hn::MulAdd(shape[i], now, middle[i]);
                rise[i] = hn::MulAdd(shape[i], change, rise[i]);
            }
        }
    }
    run.reading = hn::GetLane(hn::SumOfLanes(d, reading));
    for (std::size_t i = 0; looks_ahead && i < count; ++i) {
        run.middle[i] = hn::GetLane(hn::SumOfLanes(d, middle[i]));
        run.rise[i] = hn::GetLane(hn::SumOfLanes(d, rise[i]));
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

template <std::size_t count>
HWY_INLINE bool fly_under(TouchedFlight& run) {
    return run.looks_ahead ? fly_under<count, true>(run) : fly_under<count, false>(run);
}

bool fly_touched(TouchedFlight& run) {
    switch (run.count) {
        case 1:
            return fly_under<1>(run);
        case 2:
            return fly_under<2>(run);
        case 3:
            return fly_under<3>(run);
        default:
            return fly_under<most_flight_forces>(run);
    }
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(fly_touched);

bool fly_touched(TouchedFlight& run) noexcept {
    return HWY_DYNAMIC_DISPATCH(fly_touched)(run);
}

}  // namespace jawari::kernels
#endif
