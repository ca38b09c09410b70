#include "engine_methods.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "repeat.h"

namespace jawari::benchmarks {
namespace {

constexpr std::size_t block_frames = 64;

void render_rows(const SceneModel& model, SceneState& state, Trajectory& result) {
    std::vector<double> block(model.probe_count * block_frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(block.data() + p * block_frames);
    for (std::size_t row = 0; row < result.rows; row += block_frames) {
        const std::size_t count = std::min(block_frames, result.rows - row);
        render(model, state, outputs, count);
        for (std::size_t p = 0; p < model.probe_count; ++p) {
            for (std::size_t i = 0; i < count; ++i)
                result.samples[(row + i) * result.probes + p] = outputs[p][i];
        }
    }
}

}  // namespace

Trajectory run_engine(const SceneDescription& scene, double duration_s, const Skipping& skipping,
                      const Repetition& repetition) {
    const double compile_start = host::thread_cpu_s();
    const auto compiled = compile(scene);
    if (!compiled) throw std::runtime_error(compiled.failure().line());
    const SceneModel& model = compiled.value();
    Trajectory result;
    result.compile_s = host::thread_cpu_s() - compile_start;
    result.rows = static_cast<std::size_t>(std::llround(duration_s * model.output_rate_hz)) + 1;
    result.probes = model.probe_count;
    result.samples.resize(result.rows * result.probes);
    for (const StringModel& string : model.strings) result.unknowns += string.shape->mode_count;
    std::optional<SceneState> state;
    result.render_s = least_cpu_s(
        repetition, [&] { state = make_state(model, Metering::Off, skipping); },
        [&] { render_rows(model, *state, result); });
    return result;
}

}  // namespace jawari::benchmarks
