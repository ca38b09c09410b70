#include "string/frame/short_frame_modes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/frame/short_frame_modes.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>

#include "string/state/excitation.h"

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Vectors of modes that move side by side.
constexpr std::size_t width = 4;
/// Steps of a block of sums. With up to three vectors their sums fit the registers and hide the latency of
/// their additions.
constexpr std::size_t block_steps = 4;

/// Calls work.run<vectors>(i) for all vectors of `size` doubles, three at a time, or two where one would be
/// left.
template <class Work>
HWY_INLINE void for_blocks(std::size_t size, const Work& work) {
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t left = size / lanes;
    std::size_t i = 0;
    for (; left == 3 || left > 4; left -= 3, i += 3 * lanes) work.template run<3>(i);
    for (; left > 1; left -= 2, i += 2 * lanes) work.template run<2>(i);
    if (left > 0) work.template run<1>(i);
}

/// 0 as long as both are finite, NaN from then on.
HWY_INLINE Vec finite_probe(Vec q, Vec v, Vec probe) {
    return hn::MulAdd(hn::Add(q, v), hn::Zero(Lanes()), probe);
}

// ------------------------------------------------------------ free motion

/// Moves `vectors` vectors of modes from k on through the frame and writes their velocity at each step.
template <std::size_t vectors, bool forced>
HWY_INLINE Vec move_block(const StringModel& model, StringState& state, std::size_t k, Vec probe) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const ExcitationState& excitation = state.excitation;
    const Vec h = hn::Set(d, model.shape->step_s);
    Vec q[vectors], v[vectors], e[vectors], r[vectors], push[vectors], growth[vectors];
    for (std::size_t i = 0; i < vectors; ++i) {
        const std::size_t at = k + i * lanes;
        q[i] = hn::Load(d, state.displacement.data() + at);
        v[i] = hn::Load(d, state.velocity.data() + at);
        e[i] = hn::Add(hn::Load(d, model.shape->carry.data() + at),
                       hn::Load(d, model.shape->change.data() + at));
        r[i] = hn::Load(d, model.tuning.restoring.data() + at);
        if constexpr (forced) {
            const Vec mobility = hn::Mul(h, hn::Load(d, model.shape->mobility.data() + at));
            const Vec rate = hn::Load(d, excitation.ramp.data() + at);
            const Vec elapsed = hn::Set(d, static_cast<double>(excitation.elapsed));
            push[i] = hn::Mul(mobility, hn::MulAdd(elapsed, rate, hn::Load(d, excitation.held.data() + at)));
            growth[i] = hn::Mul(mobility, rate);
        }
    }
    double* out = state.short_frame.velocities.data() + k;
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n, out += model.shape->stride) {
        for (std::size_t i = 0; i < vectors; ++i) {
            if constexpr (forced) {
                v[i] = hn::MulAdd(r[i], q[i], hn::MulAdd(e[i], v[i], push[i]));
                push[i] = hn::Add(push[i], growth[i]);
            } else {
                v[i] = hn::MulAdd(r[i], q[i], hn::Mul(e[i], v[i]));
            }
            q[i] = hn::MulAdd(h, v[i], q[i]);
            hn::Store(v[i], d, out + i * lanes);
        }
    }
    for (std::size_t i = 0; i < vectors; ++i) {
        hn::Store(q[i], d, state.displacement_flown.data() + k + i * lanes);
        hn::Store(v[i], d, state.velocity_flown.data() + k + i * lanes);
        probe = finite_probe(q[i], v[i], probe);
    }
    return probe;
}

template <bool forced>
bool move_modes(const StringModel& model, StringState& state) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec probe = hn::Zero(d);
    std::size_t k = 0;
    for (; k + width * lanes <= state.active_modes; k += width * lanes)
        probe = move_block<width, forced>(model, state, k, probe);
    for (; k < state.active_modes; k += lanes) probe = move_block<1, forced>(model, state, k, probe);
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

/// Where rates of all gaps go: `step_stride` apart from step to step.
struct Rates {
    double* out;
    std::size_t step_stride;
};

/// rates <- S v for `vectors` vectors of contacts from c on and `steps` steps from n on
template <std::size_t vectors, std::size_t steps>
HWY_INLINE void sum_rates(const StringModel& model, const StringState& state, Rates rates, std::size_t c,
                          std::size_t n) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t stride = model.shape->contact_stride;
    const double* HWY_RESTRICT velocities = state.short_frame.velocities.data() + n * model.shape->stride;
    const double* HWY_RESTRICT column = model.shape->contact_columns.data() + c;
    Vec sum[steps][vectors];
    for (std::size_t j = 0; j < steps; ++j) {
        for (std::size_t i = 0; i < vectors; ++i) sum[j][i] = hn::Zero(d);
    }
    const std::size_t modes = state.active_modes;
    for (std::size_t k = 0; k < modes; ++k, column += stride) {
        Vec shape[vectors];
        for (std::size_t i = 0; i < vectors; ++i) shape[i] = hn::Load(d, column + i * lanes);
        for (std::size_t j = 0; j < steps; ++j) {
            const Vec velocity = hn::Set(d, velocities[j * model.shape->stride + k]);
            for (std::size_t i = 0; i < vectors; ++i) sum[j][i] = hn::MulAdd(shape[i], velocity, sum[j][i]);
        }
    }
    double* out = rates.out + n * rates.step_stride + c;
    for (std::size_t j = 0; j < steps; ++j) {
        for (std::size_t i = 0; i < vectors; ++i)
            hn::Store(sum[j][i], d, out + j * rates.step_stride + i * lanes);
    }
}

/// The rates of the steps from `first` on.
struct SumRates {
    const StringModel& model;
    const StringState& state;
    Rates rates;
    std::size_t first;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t c) const {
        std::size_t n = first;
        for (; n + block_steps <= model.shape->steps_per_frame; n += block_steps)
            sum_rates<vectors, block_steps>(model, state, rates, c, n);
        for (; n < model.shape->steps_per_frame; ++n) sum_rates<vectors, 1>(model, state, rates, c, n);
    }
};

bool run_freely(const StringModel& model, StringState& state) {
    const bool finite = is_excited(state) ? move_modes<true>(model, state) : move_modes<false>(model, state);
    for_blocks(model.shape->contact_stride,
               SumRates{model, state, {state.short_frame.rates.data(), model.shape->contact_stride}, 0});
    return finite;
}

/// The velocities of all modes in the steps after an impulse of 1 N s.
void respond_to_unit_impulse(const StringModel& model, StringState& state, std::size_t struck) {
    const Lanes d;
    const Vec h = hn::Set(d, model.shape->step_s);
    const double* row = model.shape->contact_rows.data() + struck * model.shape->stride;
    for (std::size_t k = 0; k < model.shape->stride; k += hn::Lanes(d)) {
        const Vec e =
            hn::Add(hn::Load(d, model.shape->carry.data() + k), hn::Load(d, model.shape->change.data() + k));
        const Vec r = hn::Load(d, model.tuning.restoring.data() + k);
        Vec v = hn::Mul(hn::Load(d, model.shape->mobility.data() + k), hn::Load(d, row + k));
        Vec q = hn::Mul(h, v);
        double* out = state.short_frame.velocities.data() + model.shape->stride + k;
        for (std::size_t n = 1; n < model.shape->steps_per_frame; ++n, out += model.shape->stride) {
            v = hn::MulAdd(r, q, hn::Mul(e, v));
            q = hn::MulAdd(h, v, q);
            hn::Store(v, d, out);
        }
    }
}

void find_response(const StringModel& model, StringState& state, std::size_t struck) {
    respond_to_unit_impulse(model, state, struck);
    const std::size_t stride = model.shape->contact_stride;
    const Rates rates{state.short_frame.step_response.data() + struck * stride,
                      model.shape->contact_count * stride};
    const std::size_t active_modes = state.active_modes;
    state.active_modes = model.shape->stride;
    for_blocks(stride, SumRates{model, state, rates, 1});
    state.active_modes = active_modes;
    state.short_frame.response_known[struck] = 1;
}

// ------------------------------------------------------------------------------------------ impulse response

/// drive <- sum over the struck contacts of phi lambda, for the modes from k on and the steps from n on
template <std::size_t vectors, std::size_t steps>
HWY_INLINE void sum_impulses(const StringModel& model, const StringState& state, std::size_t k, std::size_t n,
                             Vec (&drive)[steps][vectors]) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const ShortFrameState& frame = state.short_frame;
    for (std::size_t j = 0; j < steps; ++j) {
        for (std::size_t i = 0; i < vectors; ++i) drive[j][i] = hn::Zero(d);
    }
    for (const std::size_t c : frame.struck) {
        const double* row = model.shape->contact_rows.data() + c * model.shape->stride + k;
        const double* impulses = frame.impulses.data() + n * model.shape->contact_stride + c;
        Vec shape[vectors];
        for (std::size_t i = 0; i < vectors; ++i) shape[i] = hn::Load(d, row + i * lanes);
        for (std::size_t j = 0; j < steps; ++j) {
            const Vec impulse = hn::Set(d, impulses[j * model.shape->contact_stride]);
            for (std::size_t i = 0; i < vectors; ++i)
                drive[j][i] = hn::MulAdd(shape[i], impulse, drive[j][i]);
        }
    }
}

template <std::size_t vectors, std::size_t steps>
HWY_INLINE void respond(const StringModel& model, const StringState& state, std::size_t k, std::size_t n,
                        Vec (&q)[vectors], Vec (&v)[vectors]) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const Vec h = hn::Set(d, model.shape->step_s);
    Vec drive[steps][vectors];
    sum_impulses<vectors, steps>(model, state, k, n, drive);
    for (std::size_t i = 0; i < vectors; ++i) {
        const std::size_t at = k + i * lanes;
        const Vec e = hn::Add(hn::Load(d, model.shape->carry.data() + at),
                              hn::Load(d, model.shape->change.data() + at));
        const Vec r = hn::Load(d, model.tuning.restoring.data() + at);
        for (std::size_t j = 0; j < steps; ++j) {
            v[i] = hn::MulAdd(r, q[i], hn::MulAdd(e, v[i], drive[j][i]));
            q[i] = hn::MulAdd(h, v[i], q[i]);
        }
    }
}

/// The response is run for unit mobility and scaled when it is added.
struct AddResponse {
    const StringModel& model;
    StringState& state;
    Vec& probe;

    template <std::size_t vectors>
    HWY_INLINE void run(std::size_t k) const {
        const Lanes d;
        const std::size_t lanes = hn::Lanes(d);
        Vec q[vectors], v[vectors];
        for (std::size_t i = 0; i < vectors; ++i) q[i] = v[i] = hn::Zero(d);
        std::size_t n = 0;
        for (; n + block_steps <= model.shape->steps_per_frame; n += block_steps)
            respond<vectors, block_steps>(model, state, k, n, q, v);
        for (; n < model.shape->steps_per_frame; ++n) respond<vectors, 1>(model, state, k, n, q, v);
        for (std::size_t i = 0; i < vectors; ++i) {
            const std::size_t at = k + i * lanes;
            const Vec mobility = hn::Load(d, model.shape->mobility.data() + at);
            const Vec q_end = hn::MulAdd(mobility, q[i], hn::Load(d, state.displacement_flown.data() + at));
            const Vec v_end = hn::MulAdd(mobility, v[i], hn::Load(d, state.velocity_flown.data() + at));
            hn::Store(q_end, d, state.displacement_flown.data() + at);
            hn::Store(v_end, d, state.velocity_flown.data() + at);
            probe = finite_probe(q_end, v_end, probe);
        }
    }
};

bool add_response(const StringModel& model, StringState& state) {
    const Lanes d;
    Vec probe = hn::Zero(d);
    for_blocks(model.shape->stride, AddResponse{model, state, probe});
    return hn::GetLane(hn::SumOfLanes(d, probe)) == 0;
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(run_freely);
HWY_EXPORT(find_response);
HWY_EXPORT(add_response);

bool run_freely(const StringModel& model, StringState& state) noexcept {
    return HWY_DYNAMIC_DISPATCH(run_freely)(model, state);
}

void find_response(const StringModel& model, StringState& state, std::size_t struck) noexcept {
    HWY_DYNAMIC_DISPATCH(find_response)(model, state, struck);
}

bool add_response(const StringModel& model, StringState& state) noexcept {
    return HWY_DYNAMIC_DISPATCH(add_response)(model, state);
}

}  // namespace jawari::kernels
#endif
