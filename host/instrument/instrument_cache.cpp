#include "instrument/instrument_cache.h"

#include <algorithm>
#include <utility>

#include "base/cpu_clock.h"
#include "instrument/preset_library.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"

namespace jawari::host {

Outcome<SharedInstrument> load_and_compile(const std::string& name, const InstrumentSettings& settings) {
    auto preset = load_with(name, settings);
    if (!preset) return preset.error();
    const double started = thread_cpu_s();
    auto model = compile_instrument(preset.value().instrument, settings.output_rate_hz);
    if (!model) return invalid_input(preset.value().file, model.failure());
    if (settings.lower_qualities) {
        const auto lower = live_qualities(preset.value().instrument.quality, settings.output_rate_hz);
        if (auto failure = add_qualities(model.value(), preset.value().instrument, lower))
            return invalid_input(preset.value().file, *failure);
    }
    auto loaded = std::make_shared<LoadedInstrument>();
    loaded->preset = std::move(preset.value());
    loaded->model = std::move(model.value());
    loaded->cpu_compile_s = thread_cpu_s() - started;
    return SharedInstrument(std::move(loaded));
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
    if (!loaded) return loaded;
    InstrumentDescription& instrument = loaded.value().instrument;
    instrument.quality = at_quality(instrument, settings.quality);
    if (settings.tuning) {
        instrument.note_frequency_hz.assign(settings.tuning->begin(), settings.tuning->end());
        instrument.tuning_moves_frets = settings.move_frets;
    }
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
