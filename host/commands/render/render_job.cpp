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
#include "base/decibels.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/output_file.h"
#include "base/text.h"
#include "cli/contact_warnings.h"
#include "commands/render/audio_file.h"
#include "commands/render/humanise.h"
#include "commands/render/note_offs.h"
#include "commands/render/render_score.h"
#include "commands/render/score_notices.h"
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

std::string input_name(const std::string& midi) {
    return midi == "-" ? "standard input" : midi;
}

/// One MIDI file of a job.
struct Piece {
    std::string midi;
    Score score;
    RenderStats stats;
};

Outcome<MidiFile> load_midi(const std::string& midi, const RenderOptions& options) {
    const auto text = read_file(midi, max_midi_file_bytes);
    if (!text) return text.error();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.value().data());
    auto file = parse_midi(std::span(bytes, text.value().size()),
                           options.strict ? MidiReading::Strict : MidiReading::Lenient);
    if (!file) return invalid_input(input_name(midi), file.failure());
    file.value().events = with_note_offs(file.value().events);
    return std::move(file.value());
}

void add_repairs(const Piece& piece, RenderedJob& result) {
    const std::vector<MidiRepair>& repairs = piece.stats.repairs;
    const std::string name = "notice: " + printable(input_name(piece.midi)) + ": ";
    for (std::size_t i = 0; i < std::min(repairs.size(), most_repair_notices); ++i)
        result.messages.push_back(name + printable(text_of(repairs[i])));
    if (repairs.size() > most_repair_notices)
        result.messages.push_back(name + std::to_string(repairs.size() - most_repair_notices) +
                                  " more kinds of repairs; --strict refuses the file");
}

/// An excerpt that begins after the music has nothing to play.
MaybeError check_start(const Piece& piece, const RenderOptions& options, const Excerpt& excerpt) {
    if (excerpt.begin == 0 || excerpt.begin < piece.score.whole_frames) return std::nullopt;
    const double end_s = static_cast<double>(piece.score.whole_frames) / options.rate_hz;
    return usage_error("--start", shortest(options.start_s),
                       formatted("below %.9g s, the end of ", end_s) + printable(input_name(piece.midi)));
}

Outcome<Piece> load_piece(const std::string& midi, const RenderContext& context, RenderedJob& result) {
    const RenderOptions& options = context.options;
    const auto file = load_midi(midi, options);
    if (!file) return file.error();
    Piece piece{midi, {}, {}};
    piece.stats.repairs = file.value().repairs;
    add_repairs(piece, result);
    piece.score = make_score(file.value(), options.rate_hz, context.rules);
    if (auto error = check_start(piece, options, context.rules.excerpt)) return *error;
    if (options.seed) humanise(piece.score, *options.seed, options.rate_hz);
    end_notes(piece.score);
    return piece;
}

Outcome<std::vector<Piece>> load_pieces(const RenderJob& job, const RenderContext& context,
                                        RenderedJob& result) {
    std::vector<Piece> pieces;
    for (const std::string& midi : job.midi) {
        if (auto stop = interruption()) return *stop;
        auto piece = load_piece(midi, context, result);
        if (!piece) return piece.error();
        pieces.push_back(std::move(piece.value()));
    }
    return pieces;
}

std::string title_of(const RenderJob& job) {
    const std::string first = file_name(job.midi.front());
    return job.midi.size() == 1 ? first : first + " and " + std::to_string(job.midi.size() - 1) + " more";
}

SoundTags tags_of(const RenderJob& job, const RenderContext& context) {
    const RenderOptions& options = context.options;
    std::string comment = "preset " + options.preset + ", quality " +
                          name_of(options.instrument.quality.value_or(Quality::Live));
    if (const auto& tuning = options.instrument.tuning) comment += ", tuning " + file_name(*tuning);
    if (const auto& map = options.instrument.keyboard_map) comment += ", keyboard map " + file_name(*map);
    if (options.seed) comment += ", seed " + std::to_string(*options.seed);
    return {printable(title_of(job)), printable(comment)};
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
    auto mix = AudioFile::create(job.out, options.mono ? 1 : 2, format_of(job, context, frames));
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

SoundSink sink_to(Outputs& outputs, const RenderOptions& options) {
    SoundSink sink;
    const std::size_t channels = options.mono ? 1 : 2;
    sink.mix = [&outputs, channels, plots = !options.plot.empty()](std::span<const double> left,
                                                                   std::span<const double> right) {
        const double begun = thread_cpu_s();
        for (std::size_t n = 0; n < left.size() && plots; ++n)
            outputs.plotted.push_back(static_cast<float>((left[n] + right[n]) / 2));
        const std::array sides{left, right};
        auto error = outputs.mix.write(std::span(sides).first(channels));
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

void add_notices(const Piece& piece, const Ensemble& ensemble, const RenderContext& context,
                 RenderedJob& result) {
    const std::string notice =
        context.options.midi.size() == 1 ? "notice: " : "notice: " + printable(input_name(piece.midi)) + ": ";
    for (const std::string& line :
         score_notices(piece.score, ensemble, static_cast<bool>(context.rules.choose)))
        result.messages.push_back(notice + line);
}

void add_contact_messages(const Piece& piece, RenderedJob& result) {
    std::vector<NamedCounters> parts;
    for (const PartStats& part : piece.stats.parts) parts.push_back({part.preset, part.contacts});
    for (std::string& line : contact_warnings(piece.midi, "preset", parts))
        result.messages.push_back(std::move(line));
}

void add_level_messages(const RenderJob& job, const RenderOptions& options, const Outputs& outputs,
                        const ScoreStatistics& sound, RenderedJob& result) {
    const std::string name = printable(job.out == "-" ? "standard output" : job.out);
    const bool kept = options.format == SampleFormat::Float;
    if (sound.clipped > 0) {
        const double peak = 20 * std::log10(sound.peak);
        result.messages.push_back(
            "warning: " + name + ": " +
            formatted("%llu samples beyond full scale %s, peak %+.1f dBFS; use --gain %.0f or --limiter -1",
                      static_cast<unsigned long long>(sound.clipped), kept ? "kept" : "clipped", peak,
                      std::floor(options.instrument.gain_db.value_or(0) - peak - 1)));
    }
    if (sound.limited_frames > 0)
        result.messages.push_back("notice: " + name + ": " +
                                  formatted("the limiter lowered %.3g s of the sound, by up to %.1f dB",
                                            static_cast<double>(sound.limited_frames) / options.rate_hz,
                                            -20 * std::log10(sound.least_gain)));
    if (outputs.stems && outputs.stems->clipped() > 0)
        result.messages.push_back("warning: " + printable(options.stems) + ": " +
                                  formatted("%llu samples of stems beyond full scale %s",
                                            static_cast<unsigned long long>(outputs.stems->clipped()),
                                            kept ? "kept" : "clipped"));
}

/// Of all pieces of a sound file.
ScoreStatistics whole_sound(const std::vector<Piece>& pieces) {
    ScoreStatistics whole;
    for (const Piece& piece : pieces) {
        const ScoreStatistics& each = piece.stats.score;
        whole.peak = std::max(whole.peak, each.peak);
        whole.clipped += each.clipped;
        whole.limited_frames += each.limited_frames;
        whole.least_gain = std::min(whole.least_gain, each.least_gain);
    }
    return whole;
}

/// Everything is written before the first file gets its name.
MaybeError finish(const RenderJob& job, const RenderOptions& options, const std::vector<Piece>& pieces,
                  Outputs& outputs) {
    if (outputs.stats) {
        if (auto error = outputs.stats->write(stats_json(pieces.front().stats))) return error;
        if (auto error = outputs.stats->flush()) return error;
    }
    if (!options.plot.empty()) {
        const std::string title = title_of(job) + ", " + options.preset;
        if (auto error = plot_audio(outputs.plotted, options.rate_hz, title, options.plot)) return error;
    }
    if (outputs.stems) {
        if (auto error = outputs.stems->commit()) return error;
    }
    if (auto error = outputs.mix.commit()) return error;
    return outputs.stats ? outputs.stats->commit() : std::nullopt;
}

ScoreSettings score_settings(const RenderOptions& options) {
    return {static_cast<double>(options.rate_hz), options.tail_s, options.silence_dbfs,
            options.instrument.limiter_dbfs, options.mono};
}

/// Appends the piece to what is written already. `most_frames`: of all pieces.
MaybeError play_piece(const RenderJob& job, const RenderContext& context, std::uint64_t most_frames,
                      const std::function<void(double fraction)>& progress, Piece& piece, Outputs& outputs,
                      RenderedJob& result) {
    const RenderOptions& options = context.options;
    const auto instruments = load_instruments(piece.score, context.instruments, piece.stats);
    if (!instruments) return instruments.error();
    Ensemble ensemble = make_ensemble(piece.score, instruments.value(), !options.stems.empty(),
                                      factor_of(options.instrument.gain_db.value_or(0)));
    if (auto error = open_stems(job, context, most_frames, ensemble.stem_names, outputs)) return error;
    add_notices(piece, ensemble, context, result);
    SoundSink sink = sink_to(outputs, options);
    sink.progress = progress;
    const double written_cpu_s = outputs.cpu_s;
    const auto rendered = render_score(ensemble, piece.score, score_settings(options), sink);
    if (!rendered) return rendered.error();
    piece.stats.score = rendered.value();
    piece.stats.cpu_output_s = outputs.cpu_s - written_cpu_s;
    describe_job(piece.midi, options, piece.score, ensemble, piece.stats);
    return std::nullopt;
}

}  // namespace

Outcome<RenderedJob> render_job(const RenderJob& job, const RenderContext& context,
                                const std::function<void(double fraction)>& progress) {
    const RenderOptions& options = context.options;
    RenderedJob result;
    auto loaded = load_pieces(job, context, result);
    if (!loaded) return loaded.error();
    std::vector<Piece>& pieces = loaded.value();
    std::uint64_t frames = 0;
    for (const Piece& piece : pieces) frames += most_frames(piece.score, score_settings(options));
    auto outputs = open_outputs(job, context, frames);
    if (!outputs) return outputs.error();

    const auto count = static_cast<double>(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto so_far = [&progress, i, count](double fraction) {
            progress((static_cast<double>(i) + fraction) / count);
        };
        if (auto error = play_piece(job, context, frames, so_far, pieces[i], outputs.value(), result))
            return *error;
    }
    if (auto error = finish(job, options, pieces, outputs.value())) return *error;
    add_level_messages(job, options, outputs.value(), whole_sound(pieces), result);
    for (Piece& piece : pieces) {
        add_contact_messages(piece, result);
        result.stats.push_back(std::move(piece.stats));
    }
    return result;
}

}  // namespace jawari::host
