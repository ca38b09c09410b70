#include "commands/simulate/simulate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "base/cpu_clock.h"
#include "base/file_plan.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "base/text.h"
#include "cli/contact_warnings.h"
#include "commands/simulate/overrides.h"
#include "commands/simulate/probe_output.h"
#include "commands/simulate/recorder.h"
#include "commands/simulate/row_renderer.h"
#include "commands/simulate/simulation_warnings.h"
#include "commands/simulate/stats.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/read_scene.h"
#include "formats/scene_sound/load_sounds.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/snapshot.h"
#include "plot/gnuplot.h"
#include "plot/scene_plot.h"

namespace jawari::host {

namespace {

constexpr std::size_t longest_state_bytes = std::size_t{1} << 32;

/// Files of the command line, opened before any work so that a wrong path is known at once.
struct Targets {
    std::optional<OutputFile> out;
    std::optional<OutputFile> stats;
    std::optional<OutputFile> state;
};

MaybeError open_target(const std::string& path, std::optional<OutputFile>& target) {
    if (path.empty()) return std::nullopt;
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    target.emplace(std::move(file.value()));
    return std::nullopt;
}

MaybeError open_targets(const SimulateOptions& options, Targets& targets) {
    std::optional<OutputFile>
        probe_of_plot_path;  // the plot is drawn by itself, later; only its path is tried
    if (auto error = open_target(options.plot, probe_of_plot_path)) return error;
    if (!options.plot.empty())
        if (auto error = plot::can_plot(options.plot)) return error;
    if (auto error = open_target(options.out, targets.out)) return error;
    if (auto error = open_target(options.save_state, targets.state)) return error;
    return open_target(options.stats, targets.stats);
}

MaybeError check_options(const SimulateOptions& options, std::size_t probes) {
    const auto format = output_format(options.out);
    if (!options.out.empty() && probes == 0 && format != OutputFormat::Hdf5)
        return usage_error("--out", options.out, "for scenes with probes, " + options.scene + " has none");
    return std::nullopt;
}

FileContent content_of(const std::string& out) {
    switch (output_format(out).value_or(OutputFormat::Csv)) {
        case OutputFormat::Hdf5:
            return FileContent::Hdf5;
        case OutputFormat::Wav:
            return FileContent::Sound;
        case OutputFormat::Csv:
            break;
    }
    return FileContent::Table;
}

MaybeError check_files(const SimulateOptions& options, const Scene& scene) {
    FilePlan files(options.overwrite);
    files.add_input("SCENE", options.scene);
    plan_sounds(scene, files);
    files.add_input("--resume", options.resume);
    if (auto error = files.add_output("--out", options.out, content_of(options.out))) return error;
    if (auto error = files.add_output("--stats", options.stats, FileContent::Json)) return error;
    if (auto error = files.add_output("--save-state", options.save_state, FileContent::State)) return error;
    return files.add_output("--plot", options.plot, FileContent::Picture);
}

void notice_ignored_restitution(const Scene& scene) {
    if (scene.description.law != ImpactLaw::Signorini) return;
    for (const StringDescription& string : scene.description.strings)
        for (const ContactDescription& contact : string.contacts)
            if (contact.restitution > 0) {
                std::fputs("notice: the law signorini ignores the restitution of the contacts\n", stderr);
                return;
            }
}

/// A simulation under way.
struct Run {
    const SimulateOptions& options;
    const Scene& scene;
    const SceneModel& model;
    std::vector<ProbeLabel> probes;
    std::uint64_t first_row = 0;
    std::uint64_t last_row = 0;
    Metering metering = Metering::Frame;
    std::optional<ProbeOutput> output;
    std::optional<Recorder> recorder;
    double cpu_output_s = 0;
};

MaybeError create_outputs(Run& run, Targets& targets) {
    if (!run.options.plot.empty()) run.recorder.emplace(run.scene, run.model, run.probes, run.last_row);
    if (!targets.out) return std::nullopt;
    const OutputFormat format = *output_format(run.options.out);
    auto output = create_output(format, std::move(*targets.out), run.scene, run.model, run.probes,
                                run.last_row + 1 - run.first_row, run.metering);
    if (!output) return output.error();
    run.output.emplace(std::move(output.value()));
    return std::nullopt;
}

MaybeError store(Run& run, const RowBlock& block) {
    if (run.recorder) run.recorder->add(block);
    if (!run.output) return std::nullopt;
    return std::visit([&](auto& output) { return output.write(block); }, *run.output);
}

RowRenderer make_renderer(Run& run) {
    RowRenderer::Observer observer;
    if (run.recorder)
        observer = [&run](std::uint64_t row, const SceneState& state) { run.recorder->observe(row, state); };
    const bool with_contacts =
        run.recorder || (run.output && std::holds_alternative<Hdf5Output>(*run.output));
    return {run.model, run.last_row, run.metering, run.options.skipping, with_contacts, observer};
}

MaybeError render_all(Run& run, RowRenderer& renderer) {
    ProgressBar progress("simulating");
    const double rows = static_cast<double>(run.last_row) + 1;
    while (!renderer.finished()) {
        if (auto stop = interruption()) return stop;
        const RowBlock& block = renderer.next();
        const double started = thread_cpu_s();
        if (auto error = store(run, block)) return error;
        run.cpu_output_s += thread_cpu_s() - started;
        progress.update(static_cast<double>(renderer.next_row()) / rows);
    }
    return std::nullopt;
}

/// Everything is written before the first file gets its name.
MaybeError finish(Run& run, Targets& targets, const SceneState& state, SimulationStats& stats) {
    const double started = thread_cpu_s();
    if (run.output)
        if (auto* hdf5 = std::get_if<Hdf5Output>(&*run.output))
            if (auto error = hdf5->write_final(run.model, state, stats)) return error;
    if (run.recorder)
        if (auto error = plot_scene(run.recorder->recording(), run.options.plot)) return error;
    if (run.output)
        if (auto error = std::visit([](auto& output) { return output.commit(); }, *run.output)) return error;
    if (targets.state) {
        const std::vector<std::uint8_t> bytes = save(run.model, state);
        if (auto error = targets.state->write({reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
            return error;
        if (auto error = targets.state->commit()) return error;
    }
    stats.cpu_output_s = run.cpu_output_s + (thread_cpu_s() - started);
    if (targets.stats) {
        if (auto error = targets.stats->write(stats_json(stats))) return error;
        if (auto error = targets.stats->commit()) return error;
    }
    return std::nullopt;
}

/// At t = 0, or as --resume has saved it.
Outcome<SceneState> start_of(const SimulateOptions& options, const Scene& scene, const SceneModel& model,
                             std::uint64_t last_row) {
    SceneState state =
        make_state(model, options.meter_steps ? Metering::Step : Metering::Frame, options.skipping);
    if (options.resume.empty()) return state;
    const auto bytes = read_file(options.resume, longest_state_bytes);
    if (!bytes) return bytes.error();
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.value().data());
    const auto restored = restore(model, {first, bytes.value().size()}, state);
    if (!restored) return invalid_input(options.resume, restored.failure());
    if (restored.value() == Restored::Converted)
        report("notice: " + printable(options.resume) +
               ": saved at another rate or with other settings; its motion goes on, its bits do not");
    const double time_s = static_cast<double>(state.frame) / model.output_rate_hz;
    if (state.frame > last_row)
        return usage_error("--resume", shortest(time_s) + " s",
                           "a state before the end of the scene, at " + shortest(scene.duration_s) + " s");
    return state;
}

MaybeError print_summary(const SimulateOptions& options, const SimulationStats& stats) {
    if (!options.out.empty() || !options.stats.empty() || !options.plot.empty() ||
        !options.save_state.empty())
        return std::nullopt;
    auto output = OutputFile::create("-");
    if (!output) return output.error();
    if (auto error =
            output.value().write("scene     " + printable(stats.scene) + "\n" + stats_summary(stats)))
        return error;
    return output.value().commit();
}

}  // namespace

MaybeError simulate(const SimulateOptions& options) {
    auto loaded = load_scene(options.scene);
    if (!loaded) return loaded.error();
    Scene& scene = loaded.value();
    if (auto error = check_files(options, scene)) return error;
    if (auto error = load_sounds(scene)) return error;
    if (auto error = apply_overrides(options.overrides, scene)) return error;
    const auto probes = probe_labels(scene.description);
    if (auto error = check_options(options, probes.size())) return error;
    Targets targets;
    if (auto error = open_targets(options, targets)) return error;

    const double started = thread_cpu_s();
    const auto model = compile(scene.description);
    const double cpu_compile_s = thread_cpu_s() - started;
    if (!model) return explain(model.failure(), options.overrides, scene);
    if (auto stop = interruption()) return stop;

    const auto last_row =
        static_cast<std::uint64_t>(std::llround(scene.duration_s * scene.description.output_rate_hz));
    const Metering metering = options.meter_steps ? Metering::Step : Metering::Frame;
    auto start = start_of(options, scene, model.value(), last_row);
    if (!start) return start.error();
    Run run{options, scene, model.value(), probes, start.value().frame, last_row, metering, {}, {}, 0};
    if (auto error = create_outputs(run, targets)) return error;
    notice_ignored_restitution(scene);
    RowRenderer renderer = make_renderer(run);
    const auto resolutions = resolutions_at_start(scene.description, model.value(), renderer.state());
    if (!options.resume.empty()) renderer.go_on_from(std::move(start.value()));
    if (auto error = render_all(run, renderer)) return error;

    SimulationStats stats =
        collect_stats(scene, model.value(), renderer.state(), run.metering, last_row + 1 - run.first_row);
    stats.cpu_compile_s = cpu_compile_s;
    stats.cpu_render_s = renderer.cpu_render_s();
    if (auto error = finish(run, targets, renderer.state(), stats)) return error;
    const auto warnings = simulation_warnings(stats, resolutions);
    for (const std::string& line : warnings) report(line);
    if (auto error = print_summary(options, stats)) return error;
    return options.strict ? strict_error(stats.scene, warnings.size()) : std::nullopt;
}

}  // namespace jawari::host
