#include "playing.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "base/decibels.h"
#include "cli/contact_warnings.h"
#include "commands/render/ensemble.h"
#include "commands/render/humanise.h"
#include "commands/render/note_offs.h"
#include "commands/render/render_score.h"
#include "commands/render/render_settings.h"
#include "commands/render/score.h"
#include "commands/render/score_notices.h"
#include "formats/midi_file/midi_reading.h"
#include "instrument/instrument_cache.h"

namespace jawari::python {

namespace {

using host::SharedInstrument;

/// The instruments of a score's parts, and the rules by which it was read.
struct Casting {
    host::InstrumentSettings settings;
    std::optional<SharedInstrument> given;  ///< of a preset that came as text
    host::ScoreRules rules;
};

host::Outcome<Casting> cast(const PresetSource& preset, const host::RenderOptions& options) {
    auto settings = host::instrument_settings(options.instrument, options.rate_hz);
    if (!settings) return settings.error();
    Casting casting{settings.value(), {}, {}};
    if (preset.text) {
        auto instrument = host::compile_preset_text(*preset.text, preset.name, casting.settings);
        if (!instrument) return instrument.error();
        casting.given = instrument.value();
    }
    auto rules = casting.given ? host::score_rules(options, &(*casting.given)->preset.instrument)
                               : host::score_rules(options, casting.settings);
    if (!rules) return rules.error();
    casting.rules = std::move(rules.value());
    return casting;
}

host::Outcome<std::vector<SharedInstrument>> instruments_of(const host::Score& score,
                                                            const Casting& casting) {
    std::vector<SharedInstrument> instruments;
    host::InstrumentCache cache(casting.settings);
    for (const host::ScorePart& part : score.parts) {
        bool compiled = false;
        const auto instrument = casting.given ? host::Outcome<SharedInstrument>(*casting.given)
                                              : cache.get(part.preset, compiled);
        if (!instrument) return instrument.error();
        instruments.push_back(instrument.value());
    }
    return instruments;
}

}  // namespace

host::Outcome<host::MidiFile> read_midi(const std::string& bytes, const std::string& name) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    auto file = host::parse_midi(std::span(data, bytes.size()), host::MidiReading::Lenient);
    if (!file) return host::invalid_input(name, file.failure());
    file.value().events = host::with_note_offs(file.value().events);
    return std::move(file.value());
}

host::MidiFile as_midi(std::vector<TimedMessage> messages, std::uint32_t rate_hz) {
    std::stable_sort(messages.begin(), messages.end(),
                     [](const TimedMessage& a, const TimedMessage& b) { return a.time_s < b.time_s; });
    host::MidiFile file;
    file.track_count = 1;
    file.time_units_per_s = rate_hz;
    for (const TimedMessage& message : messages) {
        const auto time = static_cast<std::uint64_t>(std::llround(message.time_s * rate_hz));
        file.events.push_back({.tick = time,
                               .time = time,
                               .status = message.status,
                               .data1 = message.data1,
                               .data2 = message.data2});
        file.end_time = time;
    }
    file.events = host::with_note_offs(file.events);
    return file;
}

host::Outcome<Played> play(const host::MidiFile& file, const PresetSource& preset,
                           host::RenderOptions options, const Poll& poll) {
    options.preset = preset.name;
    const auto casting = cast(preset, options);
    if (!casting) return casting.error();
    host::Score score = host::make_score(file, options.rate_hz, casting.value().rules);
    if (options.seed) host::humanise(score, *options.seed, options.rate_hz);
    host::end_notes(score);
    const auto instruments = instruments_of(score, casting.value());
    if (!instruments) return instruments.error();
    host::Ensemble ensemble = host::make_ensemble(score, instruments.value(), false,
                                                  host::factor_of(options.instrument.gain_db.value_or(0)));
    Played played;
    for (const host::MidiRepair& repair : file.repairs) played.notices.push_back(host::text_of(repair));
    for (std::string& line :
         host::score_notices(score, ensemble, static_cast<bool>(casting.value().rules.choose)))
        played.notices.push_back(std::move(line));
    host::SoundSink sink;
    sink.mix = [&](std::span<const double> left, std::span<const double> right) {
        for (std::size_t n = 0; n < left.size(); ++n) {
            played.sound.push_back(left[n]);
            played.sound.push_back(right[n]);
        }
        return poll();
    };
    const host::ScoreSettings settings{static_cast<double>(options.rate_hz), options.tail_s,
                                       options.silence_dbfs, options.instrument.limiter_dbfs, false};
    const auto rendered = host::render_score(ensemble, score, settings, sink);
    if (!rendered) return rendered.error();
    std::vector<host::NamedCounters> parts;
    for (const host::EnsemblePart& part : ensemble.parts)
        parts.push_back({part.score->preset, contact_counters(part.state)});
    for (std::string& line : host::contact_warnings("render", "preset", parts))
        played.notices.push_back(std::move(line));
    return played;
}

}  // namespace jawari::python
