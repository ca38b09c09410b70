// Each kernel of the engine on the 862 modes of the bass. `fma_share` is the rate of multiply-adds (a lone
// multiplication or addition counts as one, since it takes the same slot) over that of `fma_peak`, measured
// in the same run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "fma_peak.h"
#include "formats/scene/read_scene.h"
#include "jawari/jawari.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_run.h"
#include "string/kernels/mode_sums.h"

namespace jawari::benchmarks {
namespace {

const StringModel& bass() {
    static const SceneModel model = [] {
        auto scene = host::load_scene("lab/bass");
        SceneDescription description = scene.value().description;
        description.output_rate_hz = 48000;
        description.contact_rate_hz = 48000 * 64;
        description.law = ImpactLaw::Signorini;
        return compile(description).value();
    }();
    return model.strings[0];
}

/// Multiply-adds per second, the best of several trials.
double peak_rate() {
    static const double peak = [] {
        double best = 0;
        for (int trial = 0; trial < 20; ++trial) {
            double sink = 0;
            const auto start = std::chrono::steady_clock::now();
            const std::size_t done = multiply_adds(1000000, sink);
            benchmark::DoNotOptimize(sink);
            const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
            best = std::max(best, static_cast<double>(done) / time.count());
        }
        return best;
    }();
    return peak;
}

/// `operations`: multiply-adds of one iteration.
void report(benchmark::State& state, double mode_steps, double operations) {
    const auto iterations = static_cast<double>(state.iterations());
    state.counters["mode_steps"] = benchmark::Counter(mode_steps * iterations, benchmark::Counter::kIsRate);
    state.counters["fma_share"] =
        benchmark::Counter(operations * iterations / peak_rate(), benchmark::Counter::kIsRate);
}

void fma_peak(benchmark::State& state) {
    double sink = 0;
    std::size_t done = 0;
    for (auto _ : state) {
        done = multiply_adds(10000, sink);
        benchmark::DoNotOptimize(sink);
    }
    report(state, 0, static_cast<double>(done));
}

constexpr std::size_t run_steps = 64;

/// All modes through run_steps steps, with the first rows of the frets as drivers or probes.
struct RunOfModes {
    const StringModel& model = bass();
    std::vector<const double*> rows;
    AlignedVector<double> rates, impulses, lanes;
    AlignedVector<double> q = model.shape->initial_displacement, v = model.shape->initial_velocity;
    kernels::ModeRun run = kernels::frame_run(model);

    RunOfModes(std::size_t drivers, std::size_t probes) {
        const std::size_t count = std::max<std::size_t>(drivers + probes, 1);
        for (std::size_t p = 0; p < count; ++p)
            rows.push_back(model.shape->contact_rows.data() + p * model.shape->stride);
        rates.assign(count * run_steps, 0.0);
        impulses.assign(count * run_steps, 1e-12);
        lanes.assign(count * kernels::steps_per_run * lane_padding, 0.0);
        run.drivers = drivers;
        run.driver_rows = rows.data();
        run.impulses = impulses.data();
        run.impulse_stride = run_steps;
        run.probes = probes;
        run.probe_rows = rows.data();
        run.rates = rates.data();
        run.rate_stride = run_steps;
        run.lanes = lanes.data();
        run.q = q.data();
        run.v = v.data();
    }

    void measure(benchmark::State& state) {
        for (auto _ : state) {
            std::copy(model.shape->initial_displacement.begin(), model.shape->initial_displacement.end(),
                      q.begin());
            std::copy(model.shape->initial_velocity.begin(), model.shape->initial_velocity.end(), v.begin());
            kernels::run_modes(run);
            benchmark::DoNotOptimize(rates.data());
            benchmark::ClobberMemory();
        }
        const double mode_steps = static_cast<double>(model.shape->stride * run_steps);
        report(state, mode_steps, mode_steps * static_cast<double>(3 + run.drivers + run.probes));
    }
};

/// Free motion with state.range(0) gap rates.
void run_modes(benchmark::State& state) {
    RunOfModes(0, static_cast<std::size_t>(state.range(0))).measure(state);
}

/// Motion under the impulses of state.range(0) contacts.
void run_impulses(benchmark::State& state) {
    RunOfModes(static_cast<std::size_t>(state.range(0)), 0).measure(state);
}

/// One frame of free flight.
void fly(benchmark::State& state) {
    const StringModel& model = bass();
    AlignedVector<double> q(model.shape->stride), v(model.shape->stride);
    for (auto _ : state) {
        benchmark::DoNotOptimize(kernels::fly(model.shape->stride, model.tuning.flight,
                                              model.shape->initial_displacement.data(),
                                              model.shape->initial_velocity.data(), q.data(), v.data()));
        benchmark::ClobberMemory();
    }
    report(state, static_cast<double>(model.shape->stride), 8 * static_cast<double>(model.shape->stride));
}

/// The gaps of all 20 frets.
void row_products(benchmark::State& state) {
    const StringModel& model = bass();
    std::vector<double> out(model.shape->contact_count);
    for (auto _ : state) {
        kernels::row_products(model.shape->contact_count, model.shape->stride, model.shape->stride,
                              model.shape->contact_rows.data(), model.shape->initial_displacement.data(),
                              out.data());
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    report(state, static_cast<double>(model.shape->stride),
           static_cast<double>(model.shape->contact_count * model.shape->stride));
}

/// All bounds of the certificate, per mode.
void mode_bounds(benchmark::State& state) {
    const StringModel& model = bass();
    AlignedVector<double> speed(model.shape->stride), extent(model.shape->stride),
        detour(model.shape->stride);
    for (auto _ : state) {
        benchmark::DoNotOptimize(kernels::mode_bounds(
            model.shape->stride, model, model.shape->initial_displacement.data(),
            model.shape->initial_velocity.data(), speed.data(), extent.data(), detour.data()));
        benchmark::ClobberMemory();
    }
    report(state, static_cast<double>(model.shape->stride), 23 * static_cast<double>(model.shape->stride));
}

BENCHMARK(fma_peak);
BENCHMARK(run_modes)->Arg(0)->Arg(1)->Arg(2)->Arg(3)->Arg(4)->Arg(8)->Arg(20);
BENCHMARK(run_impulses)->Arg(1)->Arg(2)->Arg(4)->Arg(20);
BENCHMARK(fly);
BENCHMARK(row_products);
BENCHMARK(mode_bounds);

}  // namespace
}  // namespace jawari::benchmarks

BENCHMARK_MAIN();
