#include "string/kernels/flight.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/flight.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>

#include "jawari/detail/aligned.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Vectors of modes whose state stays in registers through the frames.
constexpr std::size_t width = HWY_TARGET == HWY_SCALAR || HWY_TARGET >= HWY_SSE4 ? 4 : 6;

/// The modes from k on through one frame.
HWY_INLINE void fly_vector(const FlightModel& flight, std::size_t k, Vec& q, Vec& v) {
    const Lanes d;
    const Vec q_kept = hn::MulAdd(hn::Load(d, flight.qq.data() + k), q, q);
    const Vec v_kept = hn::MulAdd(hn::Load(d, flight.vv.data() + k), v, v);
    const Vec q_end = hn::MulAdd(hn::Load(d, flight.qv.data() + k), v, q_kept);
    v = hn::MulAdd(hn::Load(d, flight.vq.data() + k), q, v_kept);
    q = q_end;
}

/// 0 as long as both are finite, NaN from then on.
HWY_INLINE Vec finite_probe(Vec q, Vec v, Vec probe) {
    return hn::MulAdd(hn::Add(q, v), hn::Zero(Lanes()), probe);
}

bool fly_forced(std::size_t n, std::size_t forced, const FlightModel& flight, const double* HWY_RESTRICT held,
                const double* HWY_RESTRICT q, const double* HWY_RESTRICT v, double* HWY_RESTRICT q_out,
                double* HWY_RESTRICT v_out) {
    const Lanes d;
    Vec probe = hn::Zero(d);
    for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        Vec displacement = hn::Load(d, q + k);
        Vec velocity = hn::Load(d, v + k);
        fly_vector(flight, k, displacement, velocity);
        if (k < forced) {
            const Vec force = hn::Load(d, held + k);
            displacement = hn::MulAdd(force, hn::Load(d, flight.q_held.data() + k), displacement);
            velocity = hn::MulAdd(force, hn::Load(d, flight.v_held.data() + k), velocity);
        }
        hn::Store(displacement, d, q_out + k);
        hn::Store(velocity, d, v_out + k);
        probe = finite_probe(displacement, velocity, probe);
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

bool fly(std::size_t n, const FlightModel& flight, const double* HWY_RESTRICT q, const double* HWY_RESTRICT v,
         double* HWY_RESTRICT q_out, double* HWY_RESTRICT v_out) {
    return fly_forced(n, 0, flight, nullptr, q, v, q_out, v_out);
}

/// What is left of FlightRun when its frames times readings fit `sums`.
struct Leg {
    std::size_t first;  ///< frame of the run
    std::size_t frames;
    double* sums;  ///< frames x readings x lane_padding
};

/// sums <- sums + what the readings see of a block of modes
template <std::size_t vectors>
HWY_INLINE void read_block(const FlightRun& run, std::size_t k, const Vec (&q)[vectors],
                           const Vec (&v)[vectors], double* sums) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    for (const Reading& reading : run.readings) {
        const double* row = reading.row + k;
        Vec sum = hn::Load(d, sums);
        if (reading.of_velocity) {
            for (std::size_t i = 0; i < vectors; ++i)
                sum = hn::MulAdd(hn::Load(d, row + i * lanes), v[i], sum);
        } else {
            for (std::size_t i = 0; i < vectors; ++i)
                sum = hn::MulAdd(hn::Load(d, row + i * lanes), q[i], sum);
        }
        hn::Store(sum, d, sums);
        sums += lane_padding;
    }
}

template <std::size_t vectors, ReadAt when>
HWY_INLINE Vec fly_block(const FlightRun& run, const Leg& leg, std::size_t k, Vec probe) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec q[vectors], v[vectors];
    for (std::size_t i = 0; i < vectors; ++i) {
        q[i] = hn::Load(d, run.q + k + i * lanes);
        v[i] = hn::Load(d, run.v + k + i * lanes);
    }
    double* sums = leg.sums;
    for (std::size_t n = 0; n < leg.frames; ++n) {
        if constexpr (when == ReadAt::Start) read_block(run, k, q, v, sums);
        for (std::size_t i = 0; i < vectors; ++i) fly_vector(*run.flight, k + i * lanes, q[i], v[i]);
        if constexpr (when == ReadAt::End) read_block(run, k, q, v, sums);
        sums += run.readings.size() * lane_padding;
    }
    for (std::size_t i = 0; i < vectors; ++i) {
        hn::Store(q[i], d, run.q + k + i * lanes);
        hn::Store(v[i], d, run.v + k + i * lanes);
        probe = finite_probe(q[i], v[i], probe);
    }
    return probe;
}

/// Returns false if the leg's end is not finite.
template <ReadAt when>
bool fly_leg(const FlightRun& run, const Leg& leg) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    std::fill_n(leg.sums, leg.frames * run.readings.size() * lane_padding, 0.0);
    Vec probe = hn::Zero(d);
    std::size_t k = 0;
    for (; k + width * lanes <= run.modes; k += width * lanes)
        probe = fly_block<width, when>(run, leg, k, probe);
    for (; k < run.modes; k += lanes) probe = fly_block<1, when>(run, leg, k, probe);
    const double* sum_at = leg.sums;
    for (std::size_t n = 0; n < leg.frames; ++n) {
        for (const Reading& reading : run.readings) {
            reading.out[run.first + leg.first + n] = hn::GetLane(hn::SumOfLanes(d, hn::Load(d, sum_at)));
            sum_at += lane_padding;
        }
    }
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

/// `count` readings side by side, each summed in the order of fly_block().
template <std::size_t count>
HWY_INLINE void read_together(std::size_t modes, const Reading* readings, const double* q, const double* v,
                              std::size_t at) {
    const Lanes d;
    Vec sum[count];
    const double* x[count];
    for (std::size_t i = 0; i < count; ++i) {
        sum[i] = hn::Zero(d);
        x[i] = readings[i].of_velocity ? v : q;
    }
    for (std::size_t k = 0; k < modes; k += hn::Lanes(d)) {
        for (std::size_t i = 0; i < count; ++i)
            sum[i] = hn::MulAdd(hn::Load(d, readings[i].row + k), hn::Load(d, x[i] + k), sum[i]);
    }
    for (std::size_t i = 0; i < count; ++i) readings[i].out[at] = hn::GetLane(hn::SumOfLanes(d, sum[i]));
}

void read(std::size_t modes, std::span<const Reading> readings, const double* q, const double* v,
          std::size_t at) {
    std::size_t i = 0;
    for (; i + 4 <= readings.size(); i += 4) read_together<4>(modes, readings.data() + i, q, v, at);
    for (; i < readings.size(); ++i) read_together<1>(modes, readings.data() + i, q, v, at);
}

bool fly_frames(const FlightRun& run) {
    alignas(vector_alignment) double sums[flight_sums * lane_padding];
    const std::size_t readings = std::max<std::size_t>(run.readings.size(), 1);
    const std::size_t at_once = std::max<std::size_t>(flight_sums / readings, 1);
    bool finite = true;
    for (std::size_t n = 0; n < run.frames; n += at_once) {
        const Leg leg{n, std::min(at_once, run.frames - n), sums};
        finite =
            (run.when == ReadAt::Start ? fly_leg<ReadAt::Start>(run, leg) : fly_leg<ReadAt::End>(run, leg)) &&
            finite;
    }
    return finite;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(fly);
HWY_EXPORT(fly_forced);
HWY_EXPORT(fly_frames);
HWY_EXPORT(read);

bool fly(std::size_t n, const FlightModel& flight, const double* q, const double* v, double* q_out,
         double* v_out) noexcept {
    return HWY_DYNAMIC_DISPATCH(fly)(n, flight, q, v, q_out, v_out);
}

bool fly_forced(std::size_t n, std::size_t forced, const FlightModel& flight, const double* held,
                const double* q, const double* v, double* q_out, double* v_out) noexcept {
    return HWY_DYNAMIC_DISPATCH(fly_forced)(n, forced, flight, held, q, v, q_out, v_out);
}

bool fly_frames(const FlightRun& run) noexcept {
    return HWY_DYNAMIC_DISPATCH(fly_frames)(run);
}

void read(std::size_t modes, std::span<const Reading> readings, const double* q, const double* v,
          std::size_t at) noexcept {
    HWY_DYNAMIC_DISPATCH(read)(modes, readings, q, v, at);
}

}  // namespace jawari::kernels
#endif
