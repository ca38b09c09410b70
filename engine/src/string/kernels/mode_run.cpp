#include "string/kernels/mode_run.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/mode_run.cpp"
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

/// Vectors of modes whose state stays in registers through the steps: enough to hide the latency of the
/// recurrence.
constexpr std::size_t width = HWY_TARGET == HWY_SCALAR || HWY_TARGET >= HWY_SSE4 ? 4 : 6;
/// Vectors of modes whose motion through a run of steps fits the first-level cache (24 KiB).
constexpr std::size_t tile_vectors = HWY_MAX_BYTES > 32 ? 2 * width : 4 * width;
/// Up to so many rows are each used at the step where they are needed; more go through the tile's motion.
constexpr std::size_t few_drivers = 4;
constexpr std::size_t few_probes = 2;

/// Steps [first, first + count) of a run, at most steps_per_run.
struct Steps {
    std::size_t first;
    std::size_t count;
};

template <std::size_t vectors>
HWY_INLINE void load_block(const ModeRun& run, std::size_t k, Vec (&q)[vectors], Vec (&v)[vectors],
                           Vec (&e)[vectors], Vec (&r)[vectors]) {
    const Lanes d;
    for (std::size_t i = 0; i < vectors; ++i) {
        const std::size_t at = k + i * hn::Lanes(d);
        q[i] = hn::Load(d, run.q + at);
        v[i] = hn::Load(d, run.v + at);
        e[i] = hn::Add(hn::Load(d, run.carry + at), hn::Load(d, run.change + at));
        r[i] = hn::Load(d, run.restoring + at);
    }
}

template <std::size_t vectors>
HWY_INLINE void store_block(const ModeRun& run, std::size_t k, const Vec (&q)[vectors],
                            const Vec (&v)[vectors]) {
    const Lanes d;
    for (std::size_t i = 0; i < vectors; ++i) {
        hn::Store(q[i], d, run.q + k + i * hn::Lanes(d));
        hn::Store(v[i], d, run.v + k + i * hn::Lanes(d));
    }
}

HWY_INLINE double* lanes_at(const ModeRun& run, std::size_t probe, std::size_t n) {
    return run.lanes + (probe * steps_per_run + n) * lane_padding;
}

// ---------------------------------------------------------------------------------------------- few rows

template <std::size_t vectors, bool driven>
HWY_INLINE void run_block(const ModeRun& run, const Steps& steps, std::size_t k) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec q[vectors], v[vectors], e[vectors], r[vectors];
    load_block(run, k, q, v, e, r);
    const Vec h = hn::Set(d, run.step_s);
    for (std::size_t n = 0; n < steps.count; ++n) {
        for (std::size_t i = 0; i < vectors; ++i) {
            v[i] = hn::MulAdd(r[i], q[i], hn::Mul(e[i], v[i]));
        }
        if constexpr (driven) {
            for (std::size_t f = 0; f < run.drivers; ++f) {
                const Vec impulse = hn::Set(d, run.impulses[f * run.impulse_stride + steps.first + n]);
                const double* row = run.driver_rows[f] + k;
                for (std::size_t i = 0; i < vectors; ++i)
                    v[i] = hn::MulAdd(hn::Load(d, row + i * lanes), impulse, v[i]);
            }
        }
        for (std::size_t i = 0; i < vectors; ++i) q[i] = hn::MulAdd(h, v[i], q[i]);
        for (std::size_t p = 0; p < run.probes; ++p) {
            double* sum_at = lanes_at(run, p, n);
            const double* row = run.probe_rows[p] + k;
            Vec sum = hn::Load(d, sum_at);
            for (std::size_t i = 0; i < vectors; ++i)
                sum = hn::MulAdd(hn::Load(d, row + i * lanes), v[i], sum);
            hn::Store(sum, d, sum_at);
        }
    }
    store_block(run, k, q, v);
}

template <bool driven>
void run_with_few_rows(const ModeRun& run, const Steps& steps) {
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t k = 0;
    for (; k + width * lanes <= run.modes; k += width * lanes) run_block<width, driven>(run, steps, k);
    for (; k < run.modes; k += lanes) run_block<1, driven>(run, steps, k);
}

// ---------------------------------------------------------------------------------------------- many rows

/// What happens to a tile of modes in a run of steps: first the impulses' drive, then the velocities; vectors
/// of one step lie side by side.
// Written before it is read, and too large to be cleared first.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct TileMotion {
    std::size_t first_mode = 0;
    std::size_t vectors = 0;
    alignas(vector_alignment) double values[steps_per_run * tile_vectors * lane_padding];

    [[nodiscard]] HWY_INLINE double* at(std::size_t n, std::size_t vector) {
        return values + (n * tile_vectors + vector) * hn::Lanes(Lanes());
    }
};

/// motion <- sum_f row_f impulse_f for `vectors` x `count` of its entries
template <std::size_t vectors, std::size_t count>
HWY_INLINE void drive(const ModeRun& run, const Steps& steps, TileMotion& tile, std::size_t vector,
                      std::size_t n) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t k = tile.first_mode + vector * lanes;
    Vec sum[vectors][count];
    for (std::size_t i = 0; i < vectors; ++i) {
        for (std::size_t j = 0; j < count; ++j) sum[i][j] = hn::Zero(d);
    }
    for (std::size_t f = 0; f < run.drivers; ++f) {
        const double* impulses = run.impulses + f * run.impulse_stride + steps.first + n;
        Vec row[vectors];
        for (std::size_t i = 0; i < vectors; ++i) row[i] = hn::Load(d, run.driver_rows[f] + k + i * lanes);
        for (std::size_t j = 0; j < count; ++j) {
            const Vec impulse = hn::Set(d, impulses[j]);
            for (std::size_t i = 0; i < vectors; ++i) sum[i][j] = hn::MulAdd(row[i], impulse, sum[i][j]);
        }
    }
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = 0; i < vectors; ++i) hn::Store(sum[i][j], d, tile.at(n + j, vector + i));
    }
}

template <std::size_t vectors>
HWY_INLINE void drive_vectors(const ModeRun& run, const Steps& steps, TileMotion& tile, std::size_t vector) {
    std::size_t n = 0;
    for (; n + 4 <= steps.count; n += 4) drive<vectors, 4>(run, steps, tile, vector, n);
    for (; n < steps.count; ++n) drive<vectors, 1>(run, steps, tile, vector, n);
}

void drive_tile(const ModeRun& run, const Steps& steps, TileMotion& tile) {
    std::size_t vector = 0;
    for (; vector + 2 <= tile.vectors; vector += 2) drive_vectors<2>(run, steps, tile, vector);
    for (; vector < tile.vectors; ++vector) drive_vectors<1>(run, steps, tile, vector);
}

/// The recurrence of `vectors` vectors of modes; motion <- velocities.
template <std::size_t vectors, bool driven>
HWY_INLINE void move_vectors(const ModeRun& run, const Steps& steps, TileMotion& tile, std::size_t vector) {
    const Lanes d;
    const std::size_t k = tile.first_mode + vector * hn::Lanes(d);
    Vec q[vectors], v[vectors], e[vectors], r[vectors];
    load_block(run, k, q, v, e, r);
    const Vec h = hn::Set(d, run.step_s);
    for (std::size_t n = 0; n < steps.count; ++n) {
        for (std::size_t i = 0; i < vectors; ++i) {
            const Vec kept =
                driven ? hn::MulAdd(e[i], v[i], hn::Load(d, tile.at(n, vector + i))) : hn::Mul(e[i], v[i]);
            v[i] = hn::MulAdd(r[i], q[i], kept);
        }
        for (std::size_t i = 0; i < vectors; ++i) {
            q[i] = hn::MulAdd(h, v[i], q[i]);
            hn::Store(v[i], d, tile.at(n, vector + i));
        }
    }
    store_block(run, k, q, v);
}

template <bool driven>
void move_tile(const ModeRun& run, const Steps& steps, TileMotion& tile) {
    std::size_t vector = 0;
    for (; vector + width <= tile.vectors; vector += width)
        move_vectors<width, driven>(run, steps, tile, vector);
    for (; vector + 2 <= tile.vectors; vector += 2) move_vectors<2, driven>(run, steps, tile, vector);
    for (; vector < tile.vectors; ++vector) move_vectors<1, driven>(run, steps, tile, vector);
}

/// lanes += rows velocities for `rows` x `count` of the rates
template <std::size_t rows, std::size_t count>
HWY_INLINE void probe(const ModeRun& run, TileMotion& tile, std::size_t first_probe, std::size_t n) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vec sum[rows][count];
    for (std::size_t p = 0; p < rows; ++p) {
        for (std::size_t j = 0; j < count; ++j)
            sum[p][j] = hn::Load(d, lanes_at(run, first_probe + p, n + j));
    }
    for (std::size_t i = 0; i < tile.vectors; ++i) {
        Vec velocity[count];
        for (std::size_t j = 0; j < count; ++j) velocity[j] = hn::Load(d, tile.at(n + j, i));
        for (std::size_t p = 0; p < rows; ++p) {
            const Vec row = hn::Load(d, run.probe_rows[first_probe + p] + tile.first_mode + i * lanes);
            for (std::size_t j = 0; j < count; ++j) sum[p][j] = hn::MulAdd(row, velocity[j], sum[p][j]);
        }
    }
    for (std::size_t p = 0; p < rows; ++p) {
        for (std::size_t j = 0; j < count; ++j)
            hn::Store(sum[p][j], d, lanes_at(run, first_probe + p, n + j));
    }
}

template <std::size_t rows>
HWY_INLINE void probe_rows(const ModeRun& run, const Steps& steps, TileMotion& tile,
                           std::size_t first_probe) {
    constexpr std::size_t together = HWY_TARGET >= HWY_AVX2 ? 3 : 4;  // sums that fit the registers
    std::size_t n = 0;
    for (; n + together <= steps.count; n += together) probe<rows, together>(run, tile, first_probe, n);
    for (; n < steps.count; ++n) probe<rows, 1>(run, tile, first_probe, n);
}

void probe_tile(const ModeRun& run, const Steps& steps, TileMotion& tile) {
    std::size_t p = 0;
    for (; p + 4 <= run.probes; p += 4) probe_rows<4>(run, steps, tile, p);
    switch (run.probes - p) {
        case 3:
            probe_rows<3>(run, steps, tile, p);
            break;
        case 2:
            probe_rows<2>(run, steps, tile, p);
            break;
        case 1:
            probe_rows<1>(run, steps, tile, p);
            break;
        default:
            break;
    }
}

void run_with_many_rows(const ModeRun& run, const Steps& steps) {
    const std::size_t lanes = hn::Lanes(Lanes());
    TileMotion tile;
    for (std::size_t k = 0; k < run.modes; k += tile_vectors * lanes) {
        tile.first_mode = k;
        tile.vectors = std::min(tile_vectors, (run.modes - k) / lanes);
        if (run.drivers > 0) {
            drive_tile(run, steps, tile);
            move_tile<true>(run, steps, tile);
        } else {
            move_tile<false>(run, steps, tile);
        }
        probe_tile(run, steps, tile);
    }
}

// ---------------------------------------------------------------------------------------------- a run

void run_steps(const ModeRun& run, const Steps& steps) {
    const Lanes d;
    for (std::size_t p = 0; p < run.probes; ++p) {
        std::fill_n(lanes_at(run, p, 0), steps.count * lane_padding, 0.0);
    }
    if (run.drivers > few_drivers || run.probes > few_probes) {
        run_with_many_rows(run, steps);
    } else if (run.drivers > 0) {
        run_with_few_rows<true>(run, steps);
    } else {
        run_with_few_rows<false>(run, steps);
    }
    for (std::size_t p = 0; p < run.probes; ++p) {
        for (std::size_t n = 0; n < steps.count; ++n) {
            const Vec sum = hn::Load(d, lanes_at(run, p, n));
            run.rates[p * run.rate_stride + steps.first + n] = hn::GetLane(hn::SumOfLanes(d, sum));
        }
    }
}

void run_modes(const ModeRun& run) {
    const std::size_t runs = (run.steps + steps_per_run - 1) / steps_per_run;
    for (std::size_t i = 0; i < runs; ++i) {  // of equal length, as far as possible
        const std::size_t first = run.steps * i / runs;
        run_steps(run, {first, run.steps * (i + 1) / runs - first});
    }
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(run_modes);

ModeRun frame_run(const StringModel& model) noexcept {
    ModeRun run;
    run.modes = model.shape->stride;
    run.steps = model.shape->steps_per_frame;
    run.step_s = model.shape->step_s;
    run.carry = model.shape->carry.data();
    run.change = model.shape->change.data();
    run.restoring = model.tuning.restoring.data();
    return run;
}

void run_modes(const ModeRun& run) noexcept {
    HWY_DYNAMIC_DISPATCH(run_modes)(run);
}

}  // namespace jawari::kernels
#endif
