#include "render/render.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/cpu_clock.h"
#include "common/input_file.h"
#include "common/interrupt.h"
#include "common/output_file.h"
#include "common/text.h"
#include "jawari/instrument_model.h"
#include "midi/midi_file.h"
#include "plot/audio_plot.h"
#include "plot/gnuplot.h"
#include "preset/read_preset.h"
#include "render/audio_file.h"
#include "render/midi_events.h"
#include "render/render_score.h"
#include "render/render_stats.h"

namespace jawari::host {

namespace {

Outcome<MidiScore> load_score(const std::string& path, std::uint32_t rate_hz) {
    const auto text = read_file(path, max_midi_file_bytes);
    if (!text) return text.error();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.value().data());
    const auto file = parse_midi(std::span(bytes, text.value().size()));
    if (!file) return invalid_input(path, file.failure());
    return midi_score(file.value(), rate_hz);
}

MaybeError check_names(const RenderOptions& options) {
    if (options.out == options.stats || options.out == options.plot) {
        return usage_error("--out", options.out, "another name than that of --stats and --plot");
    }
    if (!options.stats.empty() && options.stats == options.plot) {
        return usage_error("--stats", options.stats, "another name than that of --plot");
    }
    return std::nullopt;
}

/// Opened before any work so that a wrong path is known at once.
MaybeError open_target(const std::string& path, std::optional<OutputFile>& target) {
    if (path.empty()) return std::nullopt;
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    target.emplace(std::move(file.value()));
    return std::nullopt;
}

void print_notices(const InstrumentDescription& instrument, const MidiScore& score) {
    if (instrument.law == ImpactLaw::Signorini && instrument.frets.restitution > 0) {
        std::fputs("notice: the law signorini ignores the restitution of the frets\n", stderr);
    }
    if (score.pitch_bends > 0) {
        std::fprintf(stderr, "notice: %llu pitch-bend messages are ignored\n",
                     static_cast<unsigned long long>(score.pitch_bends));
    }
}

void warn_of_clipping(const RenderOptions& options, const RenderStats& stats) {
    if (stats.score.clipped == 0) return;
    const double peak = *peak_dbfs(stats);
    const bool kept = options.format == SampleFormat::Float;
    std::fprintf(stderr, "warning: %s: %llu samples beyond full scale %s, peak %+.1f dBFS; use --gain %.0f\n",
                 printable(options.out).c_str(), static_cast<unsigned long long>(stats.score.clipped),
                 kept ? "kept" : "clipped", peak, std::floor(options.gain_db - peak - 1));
}

MaybeError print_summary(const RenderOptions& options, const RenderStats& stats) {
    if (!options.stats.empty()) return std::nullopt;
    auto output = OutputFile::create("-");
    if (!output) return output.error();
    if (auto error = output.value().write(stats_summary(stats))) return error;
    return output.value().commit();
}

/// The files that the command line asks for.
struct Outputs {
    AudioFile audio;
    std::optional<OutputFile> stats;
    std::vector<float> plotted;  ///< the sound, if there is a picture to draw
};

Outcome<Outputs> open_outputs(const RenderOptions& options, std::uint64_t most_frames) {
    auto audio = AudioFile::create(options.out, options.rate_hz, options.format.value_or(SampleFormat::Pcm24),
                                   most_frames);
    if (!audio) return audio.error();
    Outputs outputs{std::move(audio.value()), {}, {}};
    if (auto error = open_target(options.stats, outputs.stats)) return *error;
    std::optional<OutputFile> plot_path;  // the plot is drawn by itself, later; only its path is tried
    if (auto error = open_target(options.plot, plot_path)) return *error;
    if (!options.plot.empty()) {
        if (auto error = plot::can_plot(options.plot)) return *error;
    }
    return outputs;
}

/// Everything is written before the first file gets its name.
MaybeError finish(const RenderOptions& options, const RenderStats& stats, Outputs& outputs) {
    if (outputs.stats) {
        if (auto error = outputs.stats->write(stats_json(stats))) return error;
        if (auto error = outputs.stats->flush()) return error;
    }
    if (!options.plot.empty()) {
        const std::string title =
            std::filesystem::path(options.midi).filename().string() + ", " + options.preset;
        if (auto error = plot_audio(outputs.plotted, options.rate_hz, title, options.plot)) return error;
    }
    if (auto error = outputs.audio.commit()) return error;
    return outputs.stats ? outputs.stats->commit() : std::nullopt;
}

}  // namespace

MaybeError render(const RenderOptions& options) {
    if (auto error = check_names(options)) return error;
    const auto preset = load_preset(options.preset);
    if (!preset) return preset.error();
    const auto score = load_score(options.midi, options.rate_hz);
    if (!score) return score.error();
    const ScoreSettings settings{std::pow(10.0, options.gain_db / 20), options.tail_s};
    auto outputs = open_outputs(options, most_frames(score.value(), settings, options.rate_hz));
    if (!outputs) return outputs.error();

    RenderStats stats;
    stats.midi = options.midi;
    stats.preset = options.preset;
    stats.pitch_bends = score.value().pitch_bends;
    const double started = thread_cpu_s();
    const auto model = compile_instrument(preset.value().instrument, options.rate_hz);
    stats.cpu_compile_s = thread_cpu_s() - started;
    if (!model) return invalid_input(preset.value().file, model.failure());
    if (auto stop = interruption()) return stop;
    stats.output_rate_hz = model.value().output_rate_hz;
    stats.contact_rate_hz = model.value().contact_rate_hz;
    print_notices(preset.value().instrument, score.value());

    const SampleSink sink = [&](std::span<const double> block) {
        const double begun = thread_cpu_s();
        if (!options.plot.empty()) {
            for (const double sample : block) outputs.value().plotted.push_back(static_cast<float>(sample));
        }
        auto error = outputs.value().audio.write(block);
        stats.cpu_output_s += thread_cpu_s() - begun;
        return error;
    };
    const auto rendered = render_score(model.value(), score.value(), settings, sink);
    if (!rendered) return rendered.error();
    stats.score = rendered.value();
    if (auto error = finish(options, stats, outputs.value())) return error;
    warn_of_clipping(options, stats);
    return print_summary(options, stats);
}

}  // namespace jawari::host
