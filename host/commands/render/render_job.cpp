#include "commands/render/render_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "base/cpu_clock.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/output_file.h"
#include "base/text.h"
#include "cli/contact_warnings.h"
#include "commands/render/audio_file.h"
#include "commands/render/humanise.h"
#include "commands/render/note_offs.h"
#include "commands/render/render_score.h"
#include "commands/render/stem_files.h"
#include "formats/midi_file/midi_file.h"
#include "plot/audio_plot.h"
#include "plot/gnuplot.h"

namespace jawari::host {

namespace {

constexpr std::size_t most_repair_notices = 20;

std::string file_name(const std::string& path) {
    return path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
}

std::string input_name(const RenderJob& job) {
    return job.midi == "-" ? "standard input" : job.midi;
}

Outcome<MidiFile> load_midi(const RenderJob& job, const RenderOptions& options) {
    const auto text = read_file(job.midi, max_midi_file_bytes);
    if (!text) return text.error();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.value().data());
    auto file = parse_midi(std::span(bytes, text.value().size()),
                           options.strict ? MidiReading::Strict : MidiReading::Lenient);
    if (!file) return invalid_input(input_name(job), file.failure());
    file.value().events = with_note_offs(file.value().events);
    return std::move(file.value());
}

void add_repairs(const RenderJob& job, const std::vector<MidiRepair>& repairs, RenderedJob& result) {
    const std::string name = "notice: " + printable(input_name(job)) + ": ";
    for (std::size_t i = 0; i < std::min(repairs.size(), most_repair_notices); ++i)
        result.messages.push_back(name + printable(text_of(repairs[i])));
    if (repairs.size() > most_repair_notices)
        result.messages.push_back(name + std::to_string(repairs.size() - most_repair_notices) +
                                  " more kinds of repairs; --strict refuses the file");
}

Outcome<Score> load_score(const RenderJob& job, const RenderContext& context, RenderedJob& result) {
    const RenderOptions& options = context.options;
    const auto file = load_midi(job, options);
    if (!file) return file.error();
    add_repairs(job, file.value().repairs, result);
    result.stats.repairs = file.value().repairs;
    Score score = make_score(file.value(), options.rate_hz, context.rules);
    if (options.seed) humanise(score, *options.seed, options.rate_hz);
    end_notes(score);
    return score;
}

SoundTags tags_of(const RenderJob& job, const RenderContext& context) {
    const RenderOptions& options = context.options;
    std::string comment =
        "preset " + options.preset + ", quality " + name_of(options.quality.value_or(Quality::Live));
    if (!options.tuning.empty()) comment += ", tuning " + file_name(options.tuning);
    if (!options.keyboard_map.empty()) comment += ", keyboard map " + file_name(options.keyboard_map);
    if (options.seed) comment += ", seed " + std::to_string(*options.seed);
    return {printable(file_name(job.midi)), printable(comment)};
}

/// The files that the command line asks for.
struct Outputs {
    AudioFile mix;
    std::optional<StemFiles> stems;
    std::optional<OutputFile> stats;
    std::vector<float> plotted;  ///< the sound in mono, if there is a picture to draw
    double cpu_s = 0;            ///< spent on writing
};

/// Opened before any work so that a wrong path is known at once.
MaybeError open_target(const std::string& path, std::optional<OutputFile>& target) {
    if (path.empty()) return std::nullopt;
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    target.emplace(std::move(file.value()));
    return std::nullopt;
}

AudioFormat format_of(const RenderJob& job, const RenderContext& context, std::uint64_t frames) {
    const RenderOptions& options = context.options;
    return {options.rate_hz, options.format.value_or(SampleFormat::Pcm24), frames, tags_of(job, context)};
}

Outcome<Outputs> open_outputs(const RenderJob& job, const RenderContext& context, std::uint64_t frames) {
    const RenderOptions& options = context.options;
    auto mix = AudioFile::create(job.out, 2, format_of(job, context, frames));
    if (!mix) return mix.error();
    Outputs outputs{std::move(mix.value()), {}, {}, {}, 0};
    if (auto error = open_target(options.stats, outputs.stats)) return *error;
    std::optional<OutputFile> plot_path;  // the plot is drawn by itself, later; only its path is tried
    if (auto error = open_target(options.plot, plot_path)) return *error;
    if (!options.plot.empty()) {
        if (auto error = plot::can_plot(options.plot)) return *error;
    }
    return outputs;
}

MaybeError open_stems(const RenderJob& job, const RenderContext& context, std::uint64_t frames,
                      const std::vector<std::string>& names, Outputs& outputs) {
    if (context.options.stems.empty()) return std::nullopt;
    auto stems =
        StemFiles::create(context.options.stems, names, format_of(job, context, frames), context.files);
    if (!stems) return stems.error();
    outputs.stems.emplace(std::move(stems.value()));
    return std::nullopt;
}

SoundSink sink_to(Outputs& outputs, bool plots, const std::function<void(double)>& progress) {
    SoundSink sink;
    sink.mix = [&outputs, plots](std::span<const double> left, std::span<const double> right) {
        const double begun = thread_cpu_s();
        for (std::size_t n = 0; n < left.size() && plots; ++n)
            outputs.plotted.push_back(static_cast<float>((left[n] + right[n]) / 2));
        const std::array sides{left, right};
        auto error = outputs.mix.write(sides);
        outputs.cpu_s += thread_cpu_s() - begun;
        return error;
    };
    if (outputs.stems) {
        sink.stems = [&outputs](const std::vector<std::vector<double>>& stems) {
            const double begun = thread_cpu_s();
            auto error = outputs.stems->write(stems);
            outputs.cpu_s += thread_cpu_s() - begun;
            return error;
        };
    }
    sink.progress = progress;
    return sink;
}

Outcome<std::vector<SharedInstrument>> load_instruments(const Score& score, InstrumentCache& cache,
                                                        RenderStats& stats) {
    std::vector<SharedInstrument> instruments;
    for (const ScorePart& part : score.parts) {
        if (auto stop = interruption()) return *stop;
        bool compiled = false;
        const auto instrument = cache.get(part.preset, compiled);
        if (!instrument) return instrument.error();
        if (compiled) stats.cpu_compile_s += instrument.value()->cpu_compile_s;
        instruments.push_back(instrument.value());
    }
    return instruments;
}

void add_notices(const Score& score, const Ensemble& ensemble, const RenderContext& context,
                 RenderedJob& result) {
    for (const EnsemblePart& part : ensemble.parts) {
        const InstrumentDescription& instrument = part.instrument->preset.instrument;
        if (instrument.law == ImpactLaw::Signorini && instrument.frets.restitution > 0)
            result.messages.push_back("notice: " + printable(part.instrument->preset.file) +
                                      ": the law signorini ignores the restitution of the frets");
    }
    if (score.silent_notes > 0)
        result.messages.push_back(
            formatted("notice: %llu notes are silent: drums, or programs without strings",
                      static_cast<unsigned long long>(score.silent_notes)));
    for (const IgnoredKind& kind : score.ignored)
        result.messages.push_back(
            formatted("notice: %llu messages do nothing: ", static_cast<unsigned long long>(kind.count)) +
            printable(kind.what));
    if (score.program_changes > 0 && !context.rules.choose)
        result.messages.emplace_back("notice: program changes do nothing; --preset auto follows them");
}

void add_contact_messages(const RenderJob& job, RenderedJob& result) {
    std::vector<NamedCounters> parts;
    for (const PartStats& part : result.stats.parts) parts.push_back({part.preset, part.contacts});
    for (std::string& line : contact_warnings(job.midi, "preset", parts))
        result.messages.push_back(std::move(line));
}

void add_level_messages(const RenderJob& job, const RenderOptions& options, const Outputs& outputs,
                        RenderedJob& result) {
    const ScoreStatistics& score = result.stats.score;
    const std::string name = printable(job.out == "-" ? "standard output" : job.out);
    const bool kept = options.format == SampleFormat::Float;
    if (score.clipped > 0) {
        const double peak = *peak_dbfs(result.stats);
        result.messages.push_back(
            "warning: " + name + ": " +
            formatted("%llu samples beyond full scale %s, peak %+.1f dBFS; use --gain %.0f",
                      static_cast<unsigned long long>(score.clipped), kept ? "kept" : "clipped", peak,
                      std::floor(options.gain_db - peak - 1)));
    }
    if (score.limited_frames > 0)
        result.messages.push_back("notice: " + name + ": " +
                                  formatted("the limiter lowered %.3g s of the sound, by up to %.1f dB",
                                            static_cast<double>(score.limited_frames) / options.rate_hz,
                                            -20 * std::log10(score.least_gain)));
    if (outputs.stems && outputs.stems->clipped() > 0)
        result.messages.push_back("warning: " + printable(options.stems) + ": " +
                                  formatted("%llu samples of stems beyond full scale %s",
                                            static_cast<unsigned long long>(outputs.stems->clipped()),
                                            kept ? "kept" : "clipped"));
}

/// Everything is written before the first file gets its name.
MaybeError finish(const RenderJob& job, const RenderOptions& options, const RenderStats& stats,
                  Outputs& outputs) {
    if (outputs.stats) {
        if (auto error = outputs.stats->write(stats_json(stats))) return error;
        if (auto error = outputs.stats->flush()) return error;
    }
    if (!options.plot.empty()) {
        const std::string title = file_name(job.midi) + ", " + options.preset;
        if (auto error = plot_audio(outputs.plotted, options.rate_hz, title, options.plot)) return error;
    }
    if (outputs.stems) {
        if (auto error = outputs.stems->commit()) return error;
    }
    if (auto error = outputs.mix.commit()) return error;
    return outputs.stats ? outputs.stats->commit() : std::nullopt;
}

ScoreSettings score_settings(const RenderOptions& options) {
    return {static_cast<double>(options.rate_hz), options.tail_s, options.silence_dbfs, options.limiter_dbfs};
}

}  // namespace

Outcome<RenderedJob> render_job(const RenderJob& job, const RenderContext& context,
                                const std::function<void(double fraction)>& progress) {
    const RenderOptions& options = context.options;
    RenderedJob result;
    const auto score = load_score(job, context, result);
    if (!score) return score.error();
    const ScoreSettings settings = score_settings(options);
    const std::uint64_t frames = most_frames(score.value(), settings);
    auto outputs = open_outputs(job, context, frames);
    if (!outputs) return outputs.error();

    const auto instruments = load_instruments(score.value(), context.instruments, result.stats);
    if (!instruments) return instruments.error();
    Ensemble ensemble = make_ensemble(score.value(), instruments.value(), !options.stems.empty(),
                                      std::pow(10.0, options.gain_db / 20));
    if (auto error = open_stems(job, context, frames, ensemble.stem_names, outputs.value())) return *error;
    add_notices(score.value(), ensemble, context, result);

    const SoundSink sink = sink_to(outputs.value(), !options.plot.empty(), progress);
    const auto rendered = render_score(ensemble, score.value(), settings, sink);
    if (!rendered) return rendered.error();
    result.stats.score = rendered.value();
    result.stats.cpu_output_s = outputs.value().cpu_s;
    describe_job(job.midi, options, score.value(), ensemble, result.stats);
    if (auto error = finish(job, options, result.stats, outputs.value())) return *error;
    add_level_messages(job, options, outputs.value(), result);
    add_contact_messages(job, result);
    return result;
}

}  // namespace jawari::host
