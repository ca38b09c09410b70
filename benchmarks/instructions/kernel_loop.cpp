// Runs one piece of the engine a fixed number of times, for callgrind: everything outside of the loop is
// excluded from the count.
#include <hwy/highway.h>
#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/builtin.h"
#include "formats/scene/read_scene.h"
#include "jawari/denormals.h"
#include "jawari/jawari.h"
#include "preset_chord.h"
#include "ringing_strings.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_run.h"
#include "string/kernels/mode_sums.h"

namespace jawari::benchmarks {
namespace {

SceneModel compiled(const char* name, double contact_rate_hz, ImpactLaw law) {
    auto scene = host::load_scene(name);
    if (!scene) throw std::runtime_error(scene.error().message);
    SceneDescription description = scene.value().description;
    description.output_rate_hz = 48000;
    description.contact_rate_hz = contact_rate_hz;
    description.law = law;
    auto model = compile(description);
    if (!model) throw std::runtime_error(model.failure().line());
    return std::move(model.value());
}

template <class Work>
void counted(Work&& work) {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_TOGGLE_COLLECT;
    work();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_STOP_INSTRUMENTATION;
}

/// `frames` output frames of a built-in scene after `before` uncounted ones.
void render_scene(const char* name, double contact_rate_hz, ImpactLaw law, const Skipping& skipping,
                  std::size_t before, std::size_t frames) {
    const SceneModel model = compiled(name, contact_rate_hz, law);
    SceneState state = make_state(model, Metering::Off, skipping);
    const std::size_t room = std::max(before, frames);
    std::vector<double> samples(model.probe_count * room);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * room);
    render(model, state, outputs, before);
    counted([&] { render(model, state, outputs, frames); });
}

/// Free motion of the bass' modes through 64 steps with `probes` gap rates.
void run_modes(std::size_t probes) {
    const SceneModel scene = compiled("lab/bass", 48000.0 * 64, ImpactLaw::Signorini);
    const StringModel& model = scene.strings[0];
    std::vector<const double*> rows;
    for (std::size_t p = 0; p < probes; ++p)
        rows.push_back(model.shape->contact_rows.data() + p * model.shape->stride);
    AlignedVector<double> rates(std::max<std::size_t>(probes, 1) * 64);
    AlignedVector<double> lanes(std::max<std::size_t>(probes, 1) * kernels::steps_per_run * lane_padding);
    AlignedVector<double> q = model.shape->initial_displacement, v = model.shape->initial_velocity;
    kernels::ModeRun run = kernels::frame_run(model);
    run.probes = probes;
    run.probe_rows = rows.data();
    run.rates = rates.data();
    run.rate_stride = 64;
    run.lanes = lanes.data();
    run.q = q.data();
    run.v = v.data();
    kernels::run_modes(run);  // dispatch is resolved at the first call
    counted([&] { kernels::run_modes(run); });
}

void fly() {
    const SceneModel scene = compiled("lab/bass", 2016000, ImpactLaw::Signorini);
    const StringModel& model = scene.strings[0];
    AlignedVector<double> q(model.shape->stride), v(model.shape->stride);
    const auto once = [&] {
        kernels::fly(model.shape->stride, model.tuning.flight, model.shape->initial_displacement.data(),
                     model.shape->initial_velocity.data(), q.data(), v.data());
    };
    once();
    counted(once);
}

void row_products() {
    const SceneModel scene = compiled("lab/bass", 2016000, ImpactLaw::Signorini);
    const StringModel& model = scene.strings[0];
    std::vector<double> out(model.shape->contact_count);
    const auto once = [&] {
        kernels::row_products(model.shape->contact_count, model.shape->stride, model.shape->stride,
                              model.shape->contact_rows.data(), model.shape->initial_displacement.data(),
                              out.data());
    };
    once();
    counted(once);
}

void mode_bounds() {
    const SceneModel scene = compiled("lab/bass", 2016000, ImpactLaw::Signorini);
    const StringModel& model = scene.strings[0];
    AlignedVector<double> speed(model.shape->stride), extent(model.shape->stride),
        detour(model.shape->stride);
    const auto once = [&] {
        kernels::mode_bounds(model.shape->stride, model, model.shape->initial_displacement.data(),
                             model.shape->initial_velocity.data(), speed.data(), extent.data(),
                             detour.data());
    };
    once();
    counted(once);
}

/// A complementarity problem of 20 contacts, all of them pressed.
void lcp() {
    const SceneModel scene = compiled("lab/bass", 2016000, ImpactLaw::Signorini);
    const StringModel& model = scene.strings[0];
    const std::size_t n = model.shape->contact_count;
    const ContactOperator A{model.shape->compliance.data(), model.shape->contact_stride, nullptr,
                            model.shape->compliance_id};
    std::vector<double> pressure(n), lambda(n), residual(n);
    for (std::size_t c = 0; c < n; ++c)
        pressure[c] = (c % 3 == 0 ? 1e-6 : -1e-6) * static_cast<double>(c + 1);
    std::vector<std::uint32_t> candidates(n);
    std::iota(candidates.begin(), candidates.end(), 0U);
    LcpWorkspace workspace = make_lcp_workspace(n);
    counted([&] { solve_lcp(A, pressure, candidates, lambda, residual, workspace); });
}

struct Entry {
    std::string name;
    std::function<void()> run;
};

/// The block of a chord on a preset, with denormals off as in live playing.
void chord(const std::string& preset) {
    const NoDenormals guard;
    PresetChord playing(preset);
    counted([&] { playing.play(); });
}

/// The classical guitar on a moving bridge.
constexpr const char* coupled_guitar = "docs/examples/render/coupled-guitar.json";

void ring(bool moves) {
    const NoDenormals guard;
    RingingStrings playing(coupled_guitar, moves);
    counted([&] { playing.play(); });
}

const Entry kernels_and_scenes[] = {
    {"run_modes/0", [] { run_modes(0); }},
    {"run_modes/1", [] { run_modes(1); }},
    {"run_modes/4", [] { run_modes(4); }},
    {"run_modes/20", [] { run_modes(20); }},
    {"fly", fly},
    {"row_products", row_products},
    {"mode_bounds", mode_bounds},
    {"solve_lcp/20", lcp},
    {"bass, first 480 frames",
     [] { render_scene("lab/bass", 2016000, ImpactLaw::Signorini, skip_all, 0, 480); }},
    {"bass, 480 frames after 0.5 s",
     [] { render_scene("lab/bass", 2016000, ImpactLaw::Signorini, skip_all, 24000, 480); }},
    {"bass newton, first 480 frames",
     [] { render_scene("lab/bass", 2016000, ImpactLaw::Newton, skip_all, 0, 480); }},
    {"bass uniform, first 48 frames at 240 kHz",
     [] { render_scene("lab/bass", 240000, ImpactLaw::Signorini, skip_nothing, 0, 48); }},
    {"one-contact, first 480 frames",
     [] { render_scene("lab/one-contact", 2016000, ImpactLaw::Signorini, skip_all, 0, 480); }},
    {"fretless, first 120 frames at 240 kHz",
     [] { render_scene("lab/fretless", 240000, ImpactLaw::Signorini, skip_all, 0, 120); }},
    {"six strings on a rigid bridge, 4800 frames", [] { ring(false); }},
    {"six strings on a moving bridge, 4800 frames", [] { ring(true); }},
};

std::vector<Entry> entries() {
    std::vector<Entry> all(std::begin(kernels_and_scenes), std::end(kernels_and_scenes));
    for (const host::BuiltinFile& file : host::builtin_files("instruments")) {
        const std::string preset(file.name);
        all.push_back({"chord on " + preset, [preset] { chord(preset); }});
    }
    return all;
}

}  // namespace
}  // namespace jawari::benchmarks

int main(int argc, char** argv) {
    const auto entries = jawari::benchmarks::entries();
    if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
        for (const auto& entry : entries) std::puts(entry.name.c_str());
        return 0;
    }
    if (argc == 2 && std::strcmp(argv[1], "--isa") == 0) {
        const auto supported = static_cast<std::uint64_t>(hwy::SupportedTargets());
        std::puts(hwy::TargetName(
            static_cast<std::int64_t>(supported & (~supported + 1))));  // the best is the lowest bit
        return 0;
    }
    try {
        for (const auto& entry : entries) {
            if (argc == 2 && entry.name == argv[1]) {
                entry.run();
                return 0;
            }
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "kernel_loop: %s\n", error.what());
        return 1;
    }
    std::fputs("usage: kernel_loop --list | --isa | NAME\n", stderr);
    return 2;
}
