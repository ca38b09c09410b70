#include "near_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "near_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>

#include "jawari/aligned.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Registers of one block of modes. Lanes x width modes at a time hide the latency of the recurrence.
template <std::size_t width, bool driven>
HWY_INLINE void run_block(const ModeRun& run, std::size_t first_step, std::size_t steps, std::size_t k) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec q[width], v[width], e[width], r[width];
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t at = k + i * lanes;
        q[i] = hn::Load(d, run.q + at);
        v[i] = hn::Load(d, run.v + at);
        e[i] = hn::Add(hn::Load(d, run.carry + at), hn::Load(d, run.change + at));
        r[i] = hn::Load(d, run.restoring + at);
    }
    const Vec h = hn::Set(d, run.step_s);
    for (std::size_t n = 0; n < steps; ++n) {
        for (std::size_t i = 0; i < width; ++i) v[i] = hn::MulAdd(r[i], q[i], hn::Mul(e[i], v[i]));
        if constexpr (driven) {
            for (std::size_t f = 0; f < run.drivers; ++f) {
                const Vec impulse = hn::Set(d, run.impulses[f * run.impulse_stride + first_step + n]);
                const double* row = run.driver_rows[f] + k;
                for (std::size_t i = 0; i < width; ++i)
                    v[i] = hn::MulAdd(hn::Load(d, row + i * lanes), impulse, v[i]);
            }
        }
        for (std::size_t i = 0; i < width; ++i) q[i] = hn::MulAdd(h, v[i], q[i]);
        for (std::size_t p = 0; p < run.probes; ++p) {
            double* sum_at = run.lanes + (p * steps_per_run + n) * lane_padding;
            const double* row = run.probe_rows[p] + k;
            Vec sum = hn::Load(d, sum_at);
            for (std::size_t i = 0; i < width; ++i) sum = hn::MulAdd(hn::Load(d, row + i * lanes), v[i], sum);
            hn::Store(sum, d, sum_at);
        }
    }
    for (std::size_t i = 0; i < width; ++i) {
        hn::Store(q[i], d, run.q + k + i * lanes);
        hn::Store(v[i], d, run.v + k + i * lanes);
    }
}

template <bool driven>
void run_steps(const ModeRun& run, std::size_t first_step, std::size_t steps) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    constexpr std::size_t width = HWY_TARGET == HWY_SCALAR || HWY_TARGET >= HWY_SSE4 ? 4 : 6;
    for (std::size_t p = 0; p < run.probes; ++p) {
        std::fill_n(run.lanes + p * steps_per_run * lane_padding, steps * lane_padding, 0.0);
    }
    std::size_t k = 0;
    for (; k + width * lanes <= run.modes; k += width * lanes)
        run_block<width, driven>(run, first_step, steps, k);
    for (; k < run.modes; k += lanes) run_block<1, driven>(run, first_step, steps, k);
    for (std::size_t p = 0; p < run.probes; ++p) {
        for (std::size_t n = 0; n < steps; ++n) {
            const Vec sum = hn::Load(d, run.lanes + (p * steps_per_run + n) * lane_padding);
            run.rates[p * run.rate_stride + first_step + n] = hn::GetLane(hn::SumOfLanes(d, sum));
        }
    }
}

void run_modes(const ModeRun& run) {
    const std::size_t runs = (run.steps + steps_per_run - 1) / steps_per_run;
    for (std::size_t i = 0; i < runs; ++i) {  // of equal length, as far as possible
        const std::size_t first = run.steps * i / runs;
        const std::size_t steps = run.steps * (i + 1) / runs - first;
        if (run.drivers > 0) {
            run_steps<true>(run, first, steps);
        } else {
            run_steps<false>(run, first, steps);
        }
    }
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(run_modes);

ModeRun frame_run(const StringModel& model) noexcept {
    ModeRun run;
    run.modes = model.stride;
    run.steps = model.steps_per_frame;
    run.step_s = model.step_s;
    run.carry = model.carry.data();
    run.change = model.change.data();
    run.restoring = model.restoring.data();
    return run;
}

void run_modes(const ModeRun& run) noexcept {
    HWY_DYNAMIC_DISPATCH(run_modes)(run);
}

}  // namespace jawari::kernels
#endif
