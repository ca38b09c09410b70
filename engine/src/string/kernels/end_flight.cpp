#include "string/kernels/end_flight.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/end_flight.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Vectors of modes whose state stays in registers through the run.
constexpr std::size_t width = HWY_TARGET == HWY_SCALAR || HWY_TARGET >= HWY_SSE4 ? 4 : 6;
/// A^longest_end_run is made by squaring.
constexpr std::size_t squarings = 5;
static_assert(std::size_t{1} << squarings == longest_end_run);
/// Two frames are computed at a time.
constexpr std::size_t most_moments = longest_end_run + 2;

/// A^n - I
struct Motion {
    Vec qq, qv, vq, vv;
};

/// (I + E)^2 - I = 2 E + E^2, without the rounding of 1 + E
HWY_INLINE Motion squared(const Motion& e) {
    const Vec two = hn::Set(Lanes(), 2.0);
    const Vec cross = hn::Mul(e.qv, e.vq), sum = hn::Add(two, hn::Add(e.qq, e.vv));
    return {hn::MulAdd(e.qq, hn::Add(two, e.qq), cross), hn::Mul(e.qv, sum), hn::Mul(e.vq, sum),
            hn::MulAdd(e.vv, hn::Add(two, e.vv), cross)};
}

void set_end_coefficients(std::size_t n, const FlightModel& flight, const double* end,
                          EndCoefficients& coefficients) {
    const Lanes d;
    const Vec one = hn::Set(d, 1.0);
    EndCoefficients& to = coefficients;
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const auto at = [&](const AlignedVector<double>& x) { return hn::Load(d, x.data() + k); };
        const auto store = [&](Vec value, AlignedVector<double>& x) { hn::Store(value, d, x.data() + k); };
        Motion motion{at(flight.qq), at(flight.qv), at(flight.vq), at(flight.vv)};
        const Vec sum = hn::Add(motion.qq, motion.vv);
        store(hn::Add(hn::Add(one, one), sum), to.trace);
        const Vec product = hn::MulSub(motion.qq, motion.vv, hn::Mul(motion.qv, motion.vq));
        store(hn::Add(one, hn::Add(sum, product)), to.determinant);
        const Vec row = hn::Load(d, end + k);
        const Vec q = hn::Mul(row, at(flight.q_held)), v = hn::Mul(row, at(flight.v_held));
        store(q, to.q_last);
        store(v, to.v_last);
        store(hn::MulSub(motion.qv, v, hn::MulAdd(motion.vv, q, q)), to.q_before);
        store(hn::MulSub(motion.vq, q, hn::MulAdd(motion.qq, v, v)), to.v_before);
        for (std::size_t i = 0; i < squarings; ++i) motion = squared(motion);
        store(motion.qq, to.qq);
        store(motion.qv, to.qv);
        store(motion.vq, to.vq);
        store(motion.vv, to.vv);
    }
}

/// Adds what the rows read of x, a block of modes from k on, to the sums of a moment; `first`: there are none
/// yet.
template <std::size_t vectors, std::size_t rows, bool first>
HWY_INLINE void read_moment(const std::array<const double*, most_end_rows>& row, const Vec (&x)[vectors],
                            double* sums) {
    const Lanes d;
    for (std::size_t r = 0; r < rows; ++r) {
        const Vec product = hn::Mul(hn::Load(d, row[r]), x[0]);
        Vec sum = first ? product : hn::Add(hn::Load(d, sums + r * lane_padding), product);
        for (std::size_t i = 1; i < vectors; ++i)
            sum = hn::MulAdd(hn::Load(d, row[r] + i * hn::Lanes(d)), x[i], sum);
        hn::Store(sum, d, sums + r * lane_padding);
    }
}

template <std::size_t vectors, std::size_t rows, bool first>
HWY_INLINE void read_block(const EndReading& run, std::size_t k, double* HWY_RESTRICT sums) {
    const Lanes d;
    const FlightModel& flight = *run.flight;
    const double* HWY_RESTRICT trace = run.coefficients->trace.data() + k;
    const double* HWY_RESTRICT determinant = run.coefficients->determinant.data() + k;
    const Vec of_q = hn::Set(d, run.of_q), of_v = hn::Set(d, run.of_v);
    std::array<const double*, most_end_rows> row{};
    for (std::size_t r = 0; r < rows; ++r) row[r] = run.row[r] + k;
    Vec a[vectors], b[vectors];
    for (std::size_t i = 0; i < vectors; ++i) {
        const std::size_t at = k + i * hn::Lanes(d);
        const Vec q = hn::Load(d, run.q + at), v = hn::Load(d, run.v + at);
        const Vec q_end = hn::MulAdd(hn::Load(d, flight.qv.data() + at), v,
                                     hn::MulAdd(hn::Load(d, flight.qq.data() + at), q, q));
        const Vec v_end = hn::MulAdd(hn::Load(d, flight.vq.data() + at), q,
                                     hn::MulAdd(hn::Load(d, flight.vv.data() + at), v, v));
        a[i] = hn::MulAdd(of_v, v, hn::Mul(of_q, q));
        b[i] = hn::MulAdd(of_v, v_end, hn::Mul(of_q, q_end));
    }
    constexpr std::size_t moment = rows * lane_padding;
    read_moment<vectors, rows, first>(row, a, sums);
    read_moment<vectors, rows, first>(row, b, sums + moment);
    const auto go_on = [&](const Vec(&now)[vectors], Vec(&before)[vectors]) {
        for (std::size_t i = 0; i < vectors; ++i) {
            const std::size_t at = i * hn::Lanes(d);
            before[i] = hn::MulSub(hn::Load(d, trace + at), now[i],
                                   hn::Mul(hn::Load(d, determinant + at), before[i]));
        }
    };
    for (std::size_t n = 2; n <= run.frames; n += 2) {
        sums += 2 * moment;
        go_on(b, a);
        read_moment<vectors, rows, first>(row, a, sums);
        go_on(a, b);
        read_moment<vectors, rows, first>(row, b, sums + moment);
    }
}

template <std::size_t rows>
void read_rows(const EndReading& run) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    alignas(vector_alignment) double sums[most_moments * rows * lane_padding];
    std::size_t k = run.modes < width * lanes ? lanes : width * lanes;
    if (k == lanes) {
        read_block<1, rows, true>(run, 0, sums);
    } else {
        read_block<width, rows, true>(run, 0, sums);
    }
    for (; k + width * lanes <= run.modes; k += width * lanes) read_block<width, rows, false>(run, k, sums);
    for (; k + 2 * lanes <= run.modes; k += 2 * lanes) read_block<2, rows, false>(run, k, sums);
    for (; k < run.modes; k += lanes) read_block<1, rows, false>(run, k, sums);
    const double* sum_at = sums;
    for (std::size_t n = 0; n <= run.frames; ++n) {
        for (std::size_t r = 0; r < rows; ++r) {
            run.out[r][n] = hn::GetLane(hn::SumOfLanes(d, hn::Load(d, sum_at)));
            sum_at += lane_padding;
        }
    }
}

void read_end_run(const EndReading& run) {
    if (run.rows == 1) {
        read_rows<1>(run);
    } else {
        read_rows<2>(run);
    }
}

void add_end_response(std::size_t readings, std::size_t count, double zeta,
                      const double* HWY_RESTRICT response, double* HWY_RESTRICT values) {
    const Lanes d;
    const Vec factor = hn::Set(d, zeta);
    for (std::size_t t = 0; t < readings; ++t) {
        for (std::size_t n = 0; n < count; n += hn::Lanes(d))
            hn::StoreU(hn::MulAdd(factor, hn::Load(d, response + n), hn::LoadU(d, values + n)), d,
                       values + n);
        response += end_run_stride;
        values += end_run_stride;
    }
}

/// 0 as long as both are finite, NaN from then on.
HWY_INLINE Vec finite_probe(Vec q, Vec v, Vec probe) {
    return hn::MulAdd(hn::Add(q, v), hn::Zero(Lanes()), probe);
}

template <std::size_t vectors>
HWY_INLINE Vec end_long_block(const EndCoefficients& c, std::size_t k, const double* HWY_RESTRICT zeta,
                              double* HWY_RESTRICT q_at, double* HWY_RESTRICT v_at, Vec probe) {
    const Lanes d;
    const double* HWY_RESTRICT trace = c.trace.data() + k;
    const double* HWY_RESTRICT determinant = c.determinant.data() + k;
    Vec a[vectors], b[vectors];
    for (std::size_t i = 0; i < vectors; ++i) a[i] = b[i] = hn::Zero(d);
    const auto go_on = [&](double last, const Vec(&now)[vectors], Vec(&before)[vectors]) {
        const Vec added = hn::Set(d, last);
        for (std::size_t i = 0; i < vectors; ++i) {
            const std::size_t at = i * hn::Lanes(d);
            before[i] = hn::NegMulAdd(hn::Load(d, determinant + at), before[i],
                                      hn::MulAdd(hn::Load(d, trace + at), now[i], added));
        }
    };
    for (std::size_t n = 0; n < longest_end_run; n += 2) {
        go_on(zeta[n], b, a);
        go_on(zeta[n + 1], a, b);
    }
    for (std::size_t i = 0; i < vectors; ++i) {
        const std::size_t at = k + i * hn::Lanes(d);
        const auto coefficient = [&](const AlignedVector<double>& x) { return hn::Load(d, x.data() + at); };
        const Vec q = hn::Load(d, q_at + at), v = hn::Load(d, v_at + at);
        const Vec q_added = hn::MulAdd(coefficient(c.q_last), b[i], hn::Mul(coefficient(c.q_before), a[i]));
        const Vec v_added = hn::MulAdd(coefficient(c.v_last), b[i], hn::Mul(coefficient(c.v_before), a[i]));
        const Vec q_change = hn::MulAdd(coefficient(c.qv), v, hn::MulAdd(coefficient(c.qq), q, q_added));
        const Vec v_change = hn::MulAdd(coefficient(c.vq), q, hn::MulAdd(coefficient(c.vv), v, v_added));
        const Vec q_end = hn::Add(q, q_change), v_end = hn::Add(v, v_change);
        hn::Store(q_end, d, q_at + at);
        hn::Store(v_end, d, v_at + at);
        probe = finite_probe(q_end, v_end, probe);
    }
    return probe;
}

bool end_long_run(std::size_t modes, const EndCoefficients& coefficients, const double* zeta, double* q,
                  double* v) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec probe = hn::Zero(d);
    std::size_t k = 0;
    for (; k + width * lanes <= modes; k += width * lanes)
        probe = end_long_block<width>(coefficients, k, zeta, q, v, probe);
    for (; k + 2 * lanes <= modes; k += 2 * lanes)
        probe = end_long_block<2>(coefficients, k, zeta, q, v, probe);
    for (; k < modes; k += lanes) probe = end_long_block<1>(coefficients, k, zeta, q, v, probe);
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

bool end_short_run(std::size_t modes, std::size_t frames, const FlightModel& flight,
                   const EndCoefficients& coefficients, const double* HWY_RESTRICT zeta,
                   const double* HWY_RESTRICT q_in, const double* HWY_RESTRICT v_in,
                   double* HWY_RESTRICT q_out, double* HWY_RESTRICT v_out) {
    const Lanes d;
    Vec probe = hn::Zero(d);
    for (std::size_t k = 0; k < modes; k += hn::Lanes(d)) {
        const auto at = [&](const AlignedVector<double>& x) { return hn::Load(d, x.data() + k); };
        const Vec qq = at(flight.qq), qv = at(flight.qv), vq = at(flight.vq), vv = at(flight.vv);
        const Vec q_last = at(coefficients.q_last), v_last = at(coefficients.v_last);
        Vec q = hn::Load(d, q_in + k), v = hn::Load(d, v_in + k);
        for (std::size_t n = 0; n < frames; ++n) {
            const Vec end = hn::Set(d, zeta[n]);
            const Vec q_change = hn::MulAdd(qv, v, hn::MulAdd(qq, q, hn::Mul(q_last, end)));
            const Vec v_change = hn::MulAdd(vq, q, hn::MulAdd(vv, v, hn::Mul(v_last, end)));
            q = hn::Add(q, q_change);
            v = hn::Add(v, v_change);
        }
        hn::Store(q, d, q_out + k);
        hn::Store(v, d, v_out + k);
        probe = finite_probe(q, v, probe);
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(set_end_coefficients);
HWY_EXPORT(read_end_run);
HWY_EXPORT(add_end_response);
HWY_EXPORT(end_long_run);
HWY_EXPORT(end_short_run);

void set_end_coefficients(std::size_t n, const FlightModel& flight, const double* end,
                          EndCoefficients& coefficients) noexcept {
    HWY_DYNAMIC_DISPATCH(set_end_coefficients)(n, flight, end, coefficients);
}

void read_end_run(const EndReading& run) noexcept {
    HWY_DYNAMIC_DISPATCH(read_end_run)(run);
}

void add_end_response(std::size_t readings, std::size_t count, double zeta, const double* response,
                      double* values) noexcept {
    HWY_DYNAMIC_DISPATCH(add_end_response)(readings, count, zeta, response, values);
}

bool end_long_run(std::size_t modes, const EndCoefficients& coefficients, const double* zeta, double* q,
                  double* v) noexcept {
    return HWY_DYNAMIC_DISPATCH(end_long_run)(modes, coefficients, zeta, q, v);
}

bool end_short_run(std::size_t modes, std::size_t frames, const FlightModel& flight,
                   const EndCoefficients& coefficients, const double* zeta, const double* q, const double* v,
                   double* q_out, double* v_out) noexcept {
    return HWY_DYNAMIC_DISPATCH(end_short_run)(modes, frames, flight, coefficients, zeta, q, v, q_out, v_out);
}

}  // namespace jawari::kernels
#endif
