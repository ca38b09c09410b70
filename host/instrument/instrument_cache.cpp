#include "instrument/instrument_cache.h"

#include <algorithm>
#include <utility>

#include "base/cpu_clock.h"
#include "instrument/preset_library.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"

namespace jawari::host {

namespace {

void apply(const InstrumentSettings& settings, InstrumentDescription& instrument) {
    instrument.quality = at_quality(instrument, settings.quality);
    if (!settings.tuning) return;
    instrument.note_frequency_hz.assign(settings.tuning->begin(), settings.tuning->end());
    instrument.tuning_moves_frets = settings.move_frets;
}

/// `preset`: with quality and tuning.
Outcome<SharedInstrument> compile_as_it_is(Preset preset, const InstrumentSettings& settings) {
    const double started = thread_cpu_s();
    auto model = compile_instrument(preset.instrument, settings.output_rate_hz);
    if (!model) return invalid_input(preset.file, model.failure());
    if (settings.lower_qualities) {
        const auto lower = live_qualities(preset.instrument.quality, settings.output_rate_hz);
        if (auto failure = add_qualities(model.value(), preset.instrument, lower))
            return invalid_input(preset.file, *failure);
    }
    auto loaded = std::make_shared<LoadedInstrument>();
    loaded->preset = std::move(preset);
    loaded->model = std::move(model.value());
    loaded->cpu_compile_s = thread_cpu_s() - started;
    return SharedInstrument(std::move(loaded));
}

}  // namespace

Outcome<SharedInstrument> compile_preset(Preset preset, const InstrumentSettings& settings) {
    apply(settings, preset.instrument);
    return compile_as_it_is(std::move(preset), settings);
}

Outcome<SharedInstrument> compile_preset_text(const std::string& text, const std::string& name,
                                              const InstrumentSettings& settings) {
    auto preset = read_preset(text, name);
    if (!preset) return preset.error();
    return compile_preset(std::move(preset.value()), settings);
}

Outcome<SharedInstrument> load_and_compile(const std::string& name, const InstrumentSettings& settings) {
    auto preset = load_with(name, settings);
    if (!preset) return preset.error();
    return compile_as_it_is(std::move(preset.value()), settings);
}

std::vector<QualityDescription> live_qualities(const QualityDescription& full, double output_rate_hz) {
    std::vector<QualityDescription> qualities;
    for (const auto& [share, limit_hz] : {std::pair{0.5, 10000.0}, std::pair{0.2, 5000.0}}) {
        QualityDescription quality;
        quality.contact_rate_min_hz = std::max(share * full.contact_rate_min_hz, 2 * output_rate_hz);
        quality.mode_limit_hz = std::min(full.mode_limit_hz, limit_hz);
        qualities.push_back(quality);
    }
    return qualities;
}

Outcome<Preset> load_with(const std::string& preset, const InstrumentSettings& settings) {
    auto loaded = load_preset(preset);
    if (loaded) apply(settings, loaded.value().instrument);
    return loaded;
}

Outcome<SharedInstrument> InstrumentCache::get(const std::string& preset, bool& compiled) {
    std::promise<Outcome<SharedInstrument>> promise;
    Entry entry;
    {
        const std::lock_guard lock(mutex_);
        const auto [place, inserted] = entries_.try_emplace(preset);
        if (inserted) place->second = promise.get_future().share();
        compiled = inserted;
        entry = place->second;
    }
    if (compiled) promise.set_value(load_and_compile(preset, settings_));
    return entry.get();
}

}  // namespace jawari::host
