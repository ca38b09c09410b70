// Prints how long blocks take while every string of a guitar is held against its frets: each block's CPU time
// over seven identical passes, its least time, and the largest of these as a share of the deadline (rendering
// is deterministic, so the least time is what the block costs without the machine's scheduler).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/cpu_clock.h"
#include "jawari/denormals.h"
#include "jawari/jawari.h"
#include "scenes.h"

namespace jawari::benchmarks {
namespace {

constexpr double output_rate_hz = 48000;
constexpr std::size_t block_frames = 64;
constexpr int passes = 7;

struct BlockTimes {
    std::vector<double> least;  ///< over the passes
    std::vector<double> all;
    Counters counters;
};

BlockTimes measure_blocks(const SceneModel& model, double sound_s) {
    const NoDenormals guard;  // as jawari plays
    const auto blocks = static_cast<std::size_t>(sound_s * output_rate_hz / block_frames);
    BlockTimes times;
    times.least.assign(blocks, 1e9);
    std::vector<double> samples(model.probe_count * block_frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * block_frames);
    for (int pass = 0; pass < passes; ++pass) {
        SceneState state = make_state(model);
        for (std::size_t b = 0; b < blocks; ++b) {
            const double start = host::thread_cpu_s();
            render(model, state, outputs, block_frames);
            const double time = host::thread_cpu_s() - start;
            times.least[b] = std::min(times.least[b], time);
            times.all.push_back(time);
        }
        times.counters = {};
        for (const StringState& string : state.strings) times.counters += string.counters;
    }
    return times;
}

/// The value below which `share` of the sorted times lie.
double quantile(std::vector<double>& times, double share) {
    std::sort(times.begin(), times.end());
    return times[std::min(times.size() - 1,
                          static_cast<std::size_t>(share * static_cast<double>(times.size())))];
}

void print_row(const std::string& name, const SceneDescription& scene, double sound_s) {
    auto compiled = compile(scene);
    if (!compiled) throw std::runtime_error(compiled.failure().line());
    const SceneModel& model = compiled.value();
    BlockTimes times = measure_blocks(model, sound_s);
    const double deadline_s = block_frames / output_rate_hz;
    const auto percent = [&](double time) { return 100 * time / deadline_s; };
    const double worst = quantile(times.least, 1);
    const double cost = worst_frame_cost(model) * block_frames;
    std::printf("| %s | %.0f | %.3g | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f |\n", name.c_str(),
                100 * static_cast<double>(times.counters.near_frames) /
                    static_cast<double>(times.counters.near_frames + times.counters.flown_frames + 1),
                static_cast<double>(times.counters.impulses) / static_cast<double>(times.counters.solves + 1),
                percent(quantile(times.least, 0.5)), percent(quantile(times.least, 0.99)), percent(worst),
                percent(quantile(times.all, 0.99)), percent(quantile(times.all, 1)), cost / worst / 1e9);
    std::fflush(stdout);
}

}  // namespace
}  // namespace jawari::benchmarks

int main(int argc, char** argv) {
    using namespace jawari;
    using namespace jawari::benchmarks;
    const double sound_s = argc > 1 ? std::atof(argv[1]) : 10;
    if (!(sound_s >= 0.01 && sound_s <= 3600)) {
        std::fprintf(stderr, "adversarial: seconds: %s (allowed: 0.01 to 3600)\n", argv[1]);
        return 2;
    }
    try {
        std::printf(
            "| six strings, 22 frets each, `live` | near frames (%%) | contacts active | median (%%) | 99 %% "
            "(%%) | "
            "worst block (%%) | raw 99 %% (%%) | raw worst (%%) | multiply-adds of the model per ns |\n"
            "|---|---|---|---|---|---|---|---|---|\n");
        for (const auto& [name, hold] :
             {std::pair{"plucked, free", Hold::None},
              std::pair{"each pressed down at a fret and plucked", Hold::Pressed},
              std::pair{"each lying on all its frets and plucked", Hold::OnAllFrets}}) {
            print_row(name, at_quality(held_guitar(hold, output_rate_hz), Quality::Live), sound_s);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "adversarial: %s\n", error.what());
        return 1;
    }
    return 0;
}
