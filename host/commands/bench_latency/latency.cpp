#include "commands/bench_latency/latency.h"

#include <algorithm>
#include <utility>

#include "base/builtin.h"
#include "base/file_plan.h"
#include "base/output_file.h"
#include "base/platform.h"
#include "base/progress.h"
#include "base/text.h"
#include "commands/bench_latency/adversary.h"
#include "commands/bench_latency/report.h"
#include "instrument/preset_library.h"
#include "plot/gnuplot.h"

namespace jawari::host {

namespace {

constexpr const char* guitar = "guitar-steel";
constexpr std::size_t survey_frames = 64;
constexpr std::uint64_t survey_blocks = 1000;  // each passage of the adversary once
constexpr double histogram_width = 0.005;
constexpr std::size_t histogram_bins = 2000;

MaybeError write_text(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    if (auto error = file.value().write(text)) return error;
    return file.value().commit();
}

AdversaryReach reach_of(const LatencyOptions& options) {
    return options.two_hands ? AdversaryReach::TwoHands : AdversaryReach::AllCourses;
}

struct Job {
    SharedInstrument instrument;
    PresetResult result;
    PluginState plugin_state;  ///< the same instrument in the plugin
};

/// Loads a preset and measures what every preset is measured for.
Outcome<Job> survey(const std::string& preset, const LatencyOptions& options) {
    InstrumentSettings settings;
    settings.output_rate_hz = options.rate_hz;
    settings.quality = options.quality;
    settings.lower_qualities = options.governor;
    InstrumentCache cache(settings);
    bool compiled = false;
    auto instrument = cache.get(preset, compiled);
    if (!instrument) return instrument.error();
    Job job{instrument.value(), {}, {}};
    job.result.preset = preset;
    const auto text = preset_text(preset);
    if (!text) return text.error();
    job.plugin_state.preset_name = preset;
    job.plugin_state.preset_text = text.value();
    job.plugin_state.quality = options.quality;
    job.plugin_state.midi_map_text = adversary_map_text();
    job.result.delay = measure_event_delay(job.instrument, options.rate_hz);
    if (!options.presets.empty()) return job;
    BlockTimeSettings timing;
    timing.rate_hz = options.rate_hz;
    timing.frames = survey_frames;
    timing.blocks = survey_blocks;
    timing.passes = 1;
    timing.seed = options.seed;
    timing.reach = reach_of(options);
    auto times = measure_blocks(job.instrument, timing);
    if (!times) return times.error();
    job.result.survey_cost = distribution_of(std::move(times.value().raw)).p99;
    return job;
}

MaybeError measure_size(Job& job, std::size_t frames, const LatencyOptions& options) {
    BlockTimeSettings timing;
    timing.rate_hz = options.rate_hz;
    timing.frames = frames;
    timing.passes = options.passes;
    timing.blocks = (options.blocks + options.passes - 1) / options.passes;
    timing.seed = options.seed;
    timing.reach = reach_of(options);
    timing.governor = options.governor;
    timing.plugin = options.plugin;
    timing.plugin_state = job.plugin_state;
    ProgressBar bar(job.result.preset + ", " + std::to_string(frames) + " frames");
    timing.progress = [&bar](double fraction) { bar.update(fraction); };
    auto times = measure_blocks(job.instrument, timing);
    if (!times) return times.error();
    BlockSizeResult result;
    result.frames = frames;
    result.blocks = timing.blocks;
    result.passes = timing.passes;
    result.late = times.value().late;
    result.raw_histogram = histogram_of(times.value().raw, histogram_width, histogram_bins);
    result.minimum_histogram = histogram_of(times.value().minimum, histogram_width, histogram_bins);
    result.raw = distribution_of(std::move(times.value().raw));
    result.minimum = distribution_of(std::move(times.value().minimum));
    job.result.sizes.push_back(std::move(result));
    return std::nullopt;
}

std::vector<std::string> presets_to_survey(const LatencyOptions& options) {
    if (!options.presets.empty()) return options.presets;
    std::vector<std::string> names;
    for (const BuiltinFile& file : builtin_files("instruments")) names.emplace_back(file.name);
    return names;
}

/// The asked ones; or the heaviest, and the guitar.
bool is_chosen(const LatencyOptions& options, const std::vector<Job>& jobs, const Job& job) {
    if (!options.presets.empty() || job.result.preset == guitar) return true;
    const auto heavier = std::count_if(jobs.begin(), jobs.end(), [&](const Job& other) {
        return other.result.survey_cost > job.result.survey_cost;
    });
    return static_cast<std::size_t>(heavier) < heaviest_presets;
}

MaybeError check_files(const LatencyOptions& options) {
    FilePlan files(options.overwrite);
    for (const std::string& preset : options.presets)
        files.add_input("--preset", preset_path(preset).value_or(""));
    if (auto error = files.add_output("--json", options.json, FileContent::Json)) return error;
    if (auto error = files.add_output("--csv", options.csv, FileContent::Table)) return error;
    return files.add_output("--plot", options.plot, FileContent::Picture);
}

MaybeError write_report(const LatencyReport& report, const LatencyOptions& options) {
    if (!options.csv.empty()) {
        if (auto error = write_text(options.csv, latency_csv(report))) return error;
    }
    if (!options.plot.empty()) {
        if (auto error = plot_latency(report, options.plot)) return error;
    }
    if (!options.json.empty()) {
        if (auto error = write_text(options.json, latency_json(report))) return error;
    }
    return options.json == "-" ? std::nullopt : write_text("-", latency_text(report));
}

}  // namespace

MaybeError bench_latency(const LatencyOptions& options) {
    if (options.plugin && options.governor)
        return usage_error("--governor", "together with --plugin", "one of them: a plugin keeps its quality");
    if (auto error = check_files(options)) return error;
    if (!options.plot.empty()) {
        if (auto error = plot::can_plot(options.plot)) return error;
    }
    std::vector<Job> jobs;
    {
        ProgressBar bar("surveying");
        const std::vector<std::string> names = presets_to_survey(options);
        for (const std::string& name : names) {
            bar.update(static_cast<double>(jobs.size()) / static_cast<double>(names.size()));
            auto job = survey(name, options);
            if (!job) return job.error();
            jobs.push_back(std::move(job.value()));
        }
    }
    for (Job& job : jobs) {
        if (!is_chosen(options, jobs, job)) continue;
        for (const std::size_t frames : options.frames) {
            if (auto error = measure_size(job, frames, options)) return error;
        }
    }
    LatencyReport report;
    report.processor = printable(platform::processor_name());
    report.rate_hz = options.rate_hz;
    report.quality = std::string(name_of(options.quality)) + (options.governor ? ", governed" : "") +
                     (options.plugin ? ", in the plugin" : "");
    report.two_hands = options.two_hands;
    for (Job& job : jobs) report.presets.push_back(std::move(job.result));
    return write_report(report, options);
}

}  // namespace jawari::host
