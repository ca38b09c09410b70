#include "measure.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/cpu_clock.h"
#include "jawari/denormals.h"

namespace jawari::benchmarks {
namespace {

constexpr std::size_t block_frames = 64;

void render_frames(const SceneModel& model, SceneState& state, std::vector<double*>& outputs,
                   std::size_t frames) {
    for (std::size_t done = 0; done < frames; done += block_frames) {
        render(model, state, outputs, std::min(block_frames, frames - done));
    }
}

Counters counters_of(const SceneState& state) {
    Counters sum;
    for (const StringState& string : state.strings) sum += string.counters;
    return sum;
}

}  // namespace

Measurement measure(const SceneModel& model, double sound_s, const Skipping& skipping, double skip_s,
                    int repetitions) {
    // Uniform stepping would crawl through numbers that skipping never meets.
    const NoDenormals guard;
    const auto frames_in = [&](double seconds) {
        return static_cast<std::size_t>(seconds * model.output_rate_hz);
    };
    std::vector<double> samples(model.probe_count * block_frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * block_frames);
    Measurement result{sound_s, std::numeric_limits<double>::infinity(), {}};
    for (int i = 0; i < repetitions; ++i) {
        SceneState state = make_state(model, Metering::Off, skipping);
        render_frames(model, state, outputs, frames_in(skip_s));
        for (StringState& string : state.strings) string.counters = {};
        const double start = host::thread_cpu_s();
        render_frames(model, state, outputs, frames_in(sound_s));
        result.cpu_s = std::min(result.cpu_s, host::thread_cpu_s() - start);
        result.counters = counters_of(state);
    }
    return result;
}

}  // namespace jawari::benchmarks
