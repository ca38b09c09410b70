#include "commands/render/render.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/file_plan.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/output_file.h"
#include "base/text.h"
#include "cli/contact_warnings.h"
#include "commands/render/progress_board.h"
#include "commands/render/render_job.h"
#include "commands/render/render_settings.h"
#include "instrument/preset_library.h"

namespace jawari::host {

namespace {

// ------------------------------------------------------------------------------------------ the command line

/// Several files go into a folder, or one after the other into a file whose name says that it is a sound
/// file: a folder that is not there must not become one.
bool holds_several(const std::string& out) {
    return out == "-" || is_folder(out) || path_exists(out) || std::filesystem::path(out).has_extension();
}

MaybeError check_several(const RenderOptions& options) {
    if (options.midi.size() == 1) return std::nullopt;
    if (!holds_several(options.out))
        return usage_error("--out", options.out,
                           "a folder, or a sound file such as song.wav, for several MIDI files");
    const std::pair<const char*, const std::string*> single[] = {
        {"--stats", &options.stats}, {"--plot", &options.plot}, {"--stems", &options.stems}};
    for (const auto& [option, value] : single)
        if (!value->empty()) return usage_error(option, *value, "only with one MIDI file");
    if (std::count(options.midi.begin(), options.midi.end(), "-") > 0)
        return usage_error("MIDI", "-", "standard input only as the one file");
    return std::nullopt;
}

MaybeError check_times(const RenderOptions& options) {
    if (options.end_s && *options.end_s <= options.start_s)
        return usage_error("--end", shortest(*options.end_s),
                           "later than --start, " + shortest(options.start_s) + " s");
    return std::nullopt;
}

/// One job for a sound file; in a folder each WAV file has its MIDI file's name.
Outcome<std::vector<RenderJob>> jobs_of(const RenderOptions& options) {
    if (options.out == "-" || !is_folder(options.out))
        return std::vector<RenderJob>{{options.midi, options.out}};
    std::vector<RenderJob> jobs;
    std::set<std::string> taken;
    for (const std::string& midi : options.midi) {
        const std::string stem = midi == "-" ? "standard-input" : std::filesystem::path(midi).stem().string();
        const std::string out = (std::filesystem::path(options.out) / (stem + ".wav")).string();
        if (!taken.insert(out).second)
            return usage_error("MIDI", midi,
                               "files of different names, for they become WAV files in one folder");
        jobs.push_back({{midi}, out});
    }
    return jobs;
}

// ------------------------------------------------------------ files

/// What a name's ending asks for must be a format that is written here, and hold such samples.
MaybeError check_container(const char* option, const std::string& path, const RenderOptions& options) {
    if (path.empty() || is_folder(path)) return std::nullopt;
    const auto container = container_of(path);
    if (!container) return usage_error(option, path, "a name that ends in one of " + container_endings());
    if (options.format && !holds(*container, *options.format))
        return usage_error("--format", "given for " + path,
                           *container == SoundContainer::Ogg ? "none: Vorbis has no such samples"
                                                             : "pcm16 or pcm24 in FLAC");
    return std::nullopt;
}

FileContent content_of_sound(const std::string& path) {
    return container_of(path) == SoundContainer::Raw ? FileContent::RawSound : FileContent::Sound;
}

/// The last folder of a path is made; others must be there.
MaybeError make_folders(const RenderOptions& options) {
    for (const std::string& path : {options.out, options.stems})
        if (path.ends_with('/'))
            if (auto error = make_folder(path)) return error;
    return std::nullopt;
}

/// Presets: the one that is asked for, or all that programs may choose.
void add_preset_inputs(const RenderOptions& options, FilePlan& files) {
    if (options.preset != automatic_preset) {
        files.add_input("--preset", preset_path(options.preset).value_or(""));
        return;
    }
    for (const NamedPreset& preset : named_presets()) files.add_input("preset " + preset.name, preset.path);
}

MaybeError plan_files(const RenderOptions& options, const std::vector<RenderJob>& jobs, FilePlan& files) {
    for (const std::string& midi : options.midi) files.add_input("MIDI", midi);
    add_preset_inputs(options, files);
    add_inputs(options.instrument, files);
    for (const RenderJob& job : jobs) {
        if (auto error = check_container("--out", job.out, options)) return error;
        if (auto error = files.add_output("--out", job.out, content_of_sound(job.out))) return error;
    }
    if (!is_folder(options.stems)) {
        if (auto error = check_container("--stems", options.stems, options)) return error;
        if (auto error = files.add_output("--stems", options.stems, content_of_sound(options.stems)))
            return error;
    }
    if (auto error = files.add_output("--stats", options.stats, FileContent::Json)) return error;
    return files.add_output("--plot", options.plot, FileContent::Picture);
}

// ----------------------------------------------------------------------------------------------- the work

MaybeError print_summary(const RenderJob& job, const RenderOptions& options, const RenderedJob& result) {
    if (!options.stats.empty() || options.out == "-" || options.quiet) return std::nullopt;
    auto output = OutputFile::create("-");
    if (!output) return output.error();
    std::string text;
    for (std::size_t i = 0; i < result.stats.size(); ++i) {
        if (options.midi.size() > 1) text += printable(job.midi.size() > 1 ? job.midi[i] : job.out) + "\n";
        text += stats_summary(result.stats[i]);
    }
    if (auto error = output.value().write(text)) return error;
    return output.value().commit();
}

/// The number of warnings among them.
std::size_t print_messages(const RenderedJob& result, bool quiet) {
    std::size_t warnings = 0;
    for (const std::string& message : result.messages) {
        if (!quiet || !message.starts_with("notice: ")) std::fprintf(stderr, "%s\n", message.c_str());
        warnings += message.starts_with("warning: ") ? 1 : 0;
    }
    return warnings;
}

std::string subject_of(const RenderJob& job) {
    return job.midi.size() == 1 ? job.midi.front() : job.out;
}

/// Workers take jobs in order until none is left.
class Workers {
  public:
    Workers(const std::vector<RenderJob>& jobs, const RenderContext& context)
        : jobs_(jobs), context_(context), board_(jobs.size()), results_(jobs.size()) {}

    void run(std::size_t threads) {
        std::vector<std::future<void>> running;
        for (std::size_t i = 1; i < threads; ++i)
            running.push_back(std::async(std::launch::async, [this] { work(); }));
        work();
        for (auto& each : running) each.get();  // hands on what a thread may have thrown
        board_.clear();
    }

    [[nodiscard]] const std::optional<Outcome<RenderedJob>>& result(std::size_t job) const {
        return results_[job];
    }

  private:
    void work() {
        for (std::size_t job = next_++; job < jobs_.size(); job = next_++) {
            if (interruption()) return;
            results_[job] = render_job(jobs_[job], context_,
                                       [this, job](double fraction) { board_.update(job, fraction); });
            board_.update(job, 1);
        }
    }

    const std::vector<RenderJob>& jobs_;
    const RenderContext& context_;
    ProgressBoard board_;
    std::vector<std::optional<Outcome<RenderedJob>>> results_;
    std::atomic<std::size_t> next_{0};
};

/// Files that were finished before the signal are there.
Error interrupted(Error error, std::size_t jobs, const Workers& workers) {
    std::size_t written = 0;
    for (std::size_t i = 0; i < jobs; ++i) written += workers.result(i) && workers.result(i)->ok() ? 1 : 0;
    if (written > 0)
        error.message = "jawari: interrupted, " + std::to_string(written) + " of " + std::to_string(jobs) +
                        " files were written";
    return error;
}

MaybeError print_results(const std::vector<RenderJob>& jobs, const RenderOptions& options,
                         const Workers& workers) {
    MaybeError last;
    const auto fail = [&last](const Error& error) {
        if (last) report(last->message);
        last = error;
    };
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto& result = workers.result(i);
        if (!result) continue;
        if (!*result) {
            fail(result->error());
            continue;
        }
        const std::size_t warnings = print_messages(result->value(), options.quiet);
        if (auto error = print_summary(jobs[i], options, result->value())) return error;
        if (auto error = strict_error(subject_of(jobs[i]), warnings); error && options.strict) fail(*error);
    }
    return last;
}

}  // namespace

MaybeError render(const RenderOptions& options) {
    for (const auto check : {check_several, check_times})
        if (auto error = check(options)) return error;
    if (auto error = check_dependencies(options.instrument, options.preset == automatic_preset)) return error;
    const auto jobs = jobs_of(options);
    if (!jobs) return jobs.error();
    FilePlan files(options.overwrite);
    if (auto error = plan_files(options, jobs.value(), files)) return error;
    const auto settings = instrument_settings(options.instrument, options.rate_hz);
    if (!settings) return settings.error();
    const auto rules = score_rules(options, settings.value());
    if (!rules) return rules.error();
    if (auto error = make_folders(options)) return error;
    InstrumentCache instruments(settings.value());
    const RenderContext context{options, rules.value(), instruments, files};

    Workers workers(jobs.value(), context);
    const std::size_t wanted =
        options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
    workers.run(std::min(wanted, jobs.value().size()));
    if (auto stop = interruption()) return interrupted(*std::move(stop), jobs.value().size(), workers);
    return print_results(jobs.value(), options, workers);
}

}  // namespace jawari::host
