#include "instrument/touch/touch_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "instrument/touch/touch_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, lane_padding>;
using Vec = hn::Vec<Lanes>;

/// The paths of `count` rows over modes [begin, end).
template <std::size_t count>
HWY_INLINE void paths_of(std::size_t begin, std::size_t end, double lag, const FlightModel& flight,
                         const double* HWY_RESTRICT q, const double* HWY_RESTRICT v, std::size_t first,
                         TouchedRows& rows) {
    const Lanes d;
    const Vec minus_lag = hn::Set(d, -lag);
    Vec middle[count], rise[count];
    for (std::size_t i = 0; i < count; ++i) middle[i] = rise[i] = hn::Zero(d);
    for (std::size_t k = begin; k < end; k += hn::Lanes(d)) {
        const Vec x = hn::Load(d, q + k);
        const Vec u = hn::Load(d, v + k);
        const Vec by_q =
            hn::MulAdd(minus_lag, hn::Load(d, flight.vq.data() + k), hn::Load(d, flight.qq.data() + k));
        const Vec by_v =
            hn::MulAdd(minus_lag, hn::Load(d, flight.vv.data() + k), hn::Load(d, flight.qv.data() + k));
        const Vec now = hn::MulAdd(minus_lag, u, x);
        const Vec change = hn::MulAdd(by_q, x, hn::Mul(by_v, u));
        for (std::size_t i = 0; i < count; ++i) {
            const Vec shape = hn::Load(d, rows.row[first + i] + k);
            middle[i] = hn::MulAdd(shape, now, middle[i]);
            rise[i] = hn::MulAdd(shape, change, rise[i]);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        rows.middle[first + i] = hn::GetLane(hn::SumOfLanes(d, middle[i]));
        rows.rise[first + i] = hn::GetLane(hn::SumOfLanes(d, rise[i]));
    }
}

void free_paths(std::size_t begin, std::size_t end, double lag, const FlightModel& flight,
                const double* HWY_RESTRICT q, const double* HWY_RESTRICT v, TouchedRows& rows) {
    std::size_t i = 0;
    for (; i + 2 <= rows.count; i += 2) paths_of<2>(begin, end, lag, flight, q, v, i, rows);
    if (i < rows.count) paths_of<1>(begin, end, lag, flight, q, v, i, rows);
}

void moved_by_held(std::size_t n, double lag, const FlightModel& flight, const double* HWY_RESTRICT row,
                   double* HWY_RESTRICT out) {
    const Lanes d;
    const Vec minus_lag = hn::Set(d, -lag);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec moved = hn::MulAdd(minus_lag, hn::Load(d, flight.v_held.data() + k),
                                     hn::Load(d, flight.q_held.data() + k));
        hn::Store(hn::Mul(hn::Load(d, row + k), moved), d, out + k);
    }
}

/// cos and sin of an angle's multiples, eight apart in every lane.
struct Turns {
    HWY_ALIGN double cosine[lane_padding] = {};
    HWY_ALIGN double sine[lane_padding] = {};
    double cosine_eight = 1, sine_eight = 0;
};

/// Of 1 to 8 times the angle.
HWY_INLINE Turns turns_of(double angle) {
    Turns turns;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    double x = 1;
    double y = 0;
    for (std::size_t i = 0; i < lane_padding; ++i) {
        const double next = y * c + x * s;
        x = x * c - y * s;
        y = next;
        turns.cosine[i] = x;
        turns.sine[i] = y;
    }
    turns.cosine_eight = x;
    turns.sine_eight = y;
    return turns;
}

void point_row(std::size_t n, const PointShape& shape, double* HWY_RESTRICT row) {
    const Lanes d;
    const Turns a = turns_of(shape.a);
    const bool has_width = shape.b > 0;
    const Turns b = has_width ? turns_of(shape.b) : Turns();
    HWY_ALIGN double first[lane_padding];
    for (std::size_t i = 0; i < lane_padding; ++i) first[i] = static_cast<double>(i + 1) * shape.b;
    const Vec scale = hn::Set(d, shape.scale);
    const Vec ca8 = hn::Set(d, a.cosine_eight), sa8 = hn::Set(d, a.sine_eight);
    const Vec cb8 = hn::Set(d, b.cosine_eight), sb8 = hn::Set(d, b.sine_eight);
    const Vec eight_b = hn::Set(d, static_cast<double>(lane_padding) * shape.b);
    for (std::size_t lane = 0; lane < lane_padding; lane += hn::Lanes(d)) {
        Vec ca = hn::Load(d, a.cosine + lane), sa = hn::Load(d, a.sine + lane);
        Vec cb = hn::Load(d, b.cosine + lane), sb = hn::Load(d, b.sine + lane);
        Vec z = hn::Load(d, first + lane);
        for (std::size_t k = lane; k < n; k += lane_padding) {
            Vec value = hn::Mul(scale, sa);
            if (has_width) value = hn::Mul(value, hn::Div(sb, z));
            hn::Store(value, d, row + k);
            const Vec next_sa = hn::MulAdd(sa, ca8, hn::Mul(ca, sa8));
            ca = hn::NegMulAdd(sa, sa8, hn::Mul(ca, ca8));
            sa = next_sa;
            if (!has_width) continue;
            const Vec next_sb = hn::MulAdd(sb, cb8, hn::Mul(cb, sb8));
            cb = hn::NegMulAdd(sb, sb8, hn::Mul(cb, cb8));
            sb = next_sb;
            z = hn::Add(z, eight_b);
        }
    }
}

BodyFrame advance_body(std::size_t n, const BodyModel& body, double force_before_N, double force_change_N,
                       double* HWY_RESTRICT y, double* HWY_RESTRICT v) {
    const Lanes d;
    const Vec before = hn::Set(d, force_before_N);
    const Vec change = hn::Set(d, force_change_N);
    Vec left = hn::Zero(d), right = hn::Zero(d), largest = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const auto at = [&](const AlignedVector<double>& x) { return hn::Load(d, x.data() + k); };
        const Vec y0 = hn::Load(d, y + k);
        const Vec v0 = hn::Load(d, v + k);
        const Vec y_force = hn::MulAdd(at(body.y_ramp), change, hn::Mul(at(body.y_held), before));
        const Vec v_force = hn::MulAdd(at(body.v_ramp), change, hn::Mul(at(body.v_held), before));
        const Vec v1 = hn::MulAdd(at(body.vy), y0, hn::MulAdd(at(body.vv), v0, v_force));
        hn::Store(hn::MulAdd(at(body.yy), y0, hn::MulAdd(at(body.yv), v0, y_force)), d, y + k);
        hn::Store(v1, d, v + k);
        const Vec gain_left = at(body.gain_left);
        const Vec gain_right = at(body.gain_right);
        left = hn::MulAdd(gain_left, v1, left);
        right = hn::MulAdd(gain_right, v1, right);
        const Vec gain = hn::Max(hn::Abs(gain_left), hn::Abs(gain_right));
        largest = hn::Max(largest, hn::Mul(gain, hn::Add(hn::Abs(v1), hn::Abs(v0))));
    }
    return {hn::GetLane(hn::SumOfLanes(d, left)), hn::GetLane(hn::SumOfLanes(d, right)),
            hn::GetLane(hn::MaxOfLanes(d, largest))};
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(free_paths);
HWY_EXPORT(moved_by_held);
HWY_EXPORT(point_row);
HWY_EXPORT(advance_body);

void free_paths(std::size_t begin, std::size_t end, double lag, const FlightModel& flight, const double* q,
                const double* v, TouchedRows& rows) noexcept {
    HWY_DYNAMIC_DISPATCH(free_paths)(begin, end, lag, flight, q, v, rows);
}

void moved_by_held(std::size_t n, double lag, const FlightModel& flight, const double* row,
                   double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(moved_by_held)(n, lag, flight, row, out);
}

void point_row(std::size_t n, const PointShape& shape, double* row) noexcept {
    HWY_DYNAMIC_DISPATCH(point_row)(n, shape, row);
}

BodyFrame advance_body(std::size_t n, const BodyModel& body, double force_before_N, double force_change_N,
                       double* y, double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(advance_body)(n, body, force_before_N, force_change_N, y, v);
}

}  // namespace jawari::kernels
#endif
