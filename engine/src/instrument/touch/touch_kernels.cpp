#include "instrument/touch/touch_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "instrument/touch/touch_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/contrib/math/math-inl.h>
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

template <std::size_t count>
HWY_INLINE void compliances(std::size_t n, double lag, const FlightModel& flight, const double* const* rows,
                            double* HWY_RESTRICT out) {
    const Lanes d;
    const Vec minus_lag = hn::Set(d, -lag);
    Vec sum[count][count];
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j <= i; ++j) sum[i][j] = hn::Zero(d);
    }
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const Vec moved = hn::MulAdd(minus_lag, hn::Load(d, flight.v_held.data() + k),
                                     hn::Load(d, flight.q_held.data() + k));
        Vec shape[count];
        for (std::size_t i = 0; i < count; ++i) {
            shape[i] = hn::Load(d, rows[i] + k);
            const Vec pushed = hn::Mul(shape[i], moved);
            for (std::size_t j = 0; j <= i; ++j) sum[i][j] = hn::MulAdd(pushed, shape[j], sum[i][j]);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            out[i * count + j] = out[j * count + i] = hn::GetLane(hn::SumOfLanes(d, sum[i][j]));
    }
}

void compliances_of(std::size_t n, std::size_t count, double lag, const FlightModel& flight,
                    const double* const* rows, double* HWY_RESTRICT out) {
    switch (count) {
        case 1:
            return compliances<1>(n, lag, flight, rows, out);
        case 2:
            return compliances<2>(n, lag, flight, rows, out);
        case 3:
            return compliances<3>(n, lag, flight, rows, out);
        default:
            return compliances<most_compliant_rows>(n, lag, flight, rows, out);
    }
}

/// cos and sin of an angle's multiples: 1 to lanes times, and lane_padding times.
struct Turns {
    HWY_INLINE Turns() {}  // NOLINT(modernize-use-equals-default): written out so that it is compiled for the
                           // target, as Vec's own is
    Vec cosine, sine, cosine_eight, sine_eight;
};

/// Of the multiples from `lane` + 1 on.
HWY_INLINE Turns turns_of(double angle, std::size_t lane) {
    const Lanes d;
    const Vec multiple = hn::Mul(hn::Iota(d, static_cast<double>(lane + 1)), hn::Set(d, angle));
    const Vec eight = hn::Set(d, static_cast<double>(lane_padding) * angle);
    Turns turns;
    turns.cosine = hn::Cos(d, multiple);
    turns.sine = hn::Sin(d, multiple);
    turns.cosine_eight = hn::Cos(d, eight);
    turns.sine_eight = hn::Sin(d, eight);
    return turns;
}

/// On by lane_padding multiples.
HWY_INLINE void turn(Turns& turns) {
    const Vec sine = hn::MulAdd(turns.sine, turns.cosine_eight, hn::Mul(turns.cosine, turns.sine_eight));
    turns.cosine = hn::NegMulAdd(turns.sine, turns.sine_eight, hn::Mul(turns.cosine, turns.cosine_eight));
    turns.sine = sine;
}

void point_row(std::size_t n, const PointShape& shape, double* HWY_RESTRICT row) {
    const Lanes d;
    const bool has_width = shape.b > 0;
    const Vec scale = hn::Set(d, shape.scale);
    const Vec eight_b = hn::Set(d, static_cast<double>(lane_padding) * shape.b);
    for (std::size_t lane = 0; lane < lane_padding; lane += hn::Lanes(d)) {
        Turns a = turns_of(shape.a, lane);
        Turns b = has_width ? turns_of(shape.b, lane) : a;
        Vec z = hn::Mul(hn::Iota(d, static_cast<double>(lane + 1)), hn::Set(d, shape.b));
        for (std::size_t k = lane; k < n; k += lane_padding) {
            Vec value = hn::Mul(scale, a.sine);
            if (has_width) value = hn::Mul(value, hn::Div(b.sine, z));
            hn::Store(value, d, row + k);
            turn(a);
            if (!has_width) continue;
            turn(b);
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
HWY_EXPORT(compliances_of);
HWY_EXPORT(point_row);
HWY_EXPORT(advance_body);

void free_paths(std::size_t begin, std::size_t end, double lag, const FlightModel& flight, const double* q,
                const double* v, TouchedRows& rows) noexcept {
    HWY_DYNAMIC_DISPATCH(free_paths)(begin, end, lag, flight, q, v, rows);
}

void compliances_of(std::size_t n, std::size_t count, double lag, const FlightModel& flight,
                    const double* const* rows, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(compliances_of)(n, count, lag, flight, rows, out);
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
