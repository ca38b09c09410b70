#include "render/instrument_cache.h"

#include <utility>

#include "common/cpu_clock.h"
#include "library/preset_library.h"

namespace jawari::host {

Outcome<SharedInstrument> load_and_compile(const std::string& name, const InstrumentSettings& settings) {
    auto preset = load_with(name, settings);
    if (!preset) return preset.error();
    const double started = thread_cpu_s();
    auto model = compile_instrument(preset.value().instrument, settings.output_rate_hz);
    if (!model) return invalid_input(preset.value().file, model.failure());
    auto loaded = std::make_shared<LoadedInstrument>();
    loaded->preset = std::move(preset.value());
    loaded->model = std::move(model.value());
    loaded->cpu_compile_s = thread_cpu_s() - started;
    return SharedInstrument(std::move(loaded));
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
