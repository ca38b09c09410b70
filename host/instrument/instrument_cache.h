// Compiled instruments by preset, shared by the files that are rendered at the same time.
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/preset/read_preset.h"
#include "formats/tuning/tuning.h"
#include "instrument/quality.h"
#include "jawari/instrument/model.h"

namespace jawari::host {

/// What is the same for all instruments of a run.
struct InstrumentSettings {
    double output_rate_hz = 48000;
    Quality quality = Quality::Live;
    std::optional<KeyFrequencies> tuning;
    bool move_frets = false;
    bool lower_qualities = false;  ///< compiled at lower qualities too (live_qualities()), for playing live
};

struct LoadedInstrument {
    Preset preset;  ///< with quality and tuning applied
    InstrumentModel model;
    double cpu_compile_s = 0;
};

using SharedInstrument = std::shared_ptr<const LoadedInstrument>;

/// Thread-safe. Each preset is loaded and compiled once, by the thread that asks first; others wait for it.
class InstrumentCache {
  public:
    explicit InstrumentCache(const InstrumentSettings& settings) : settings_(settings) {}

    /// `preset`: as load_preset() takes it. `compiled` becomes true if this call did the work.
    Outcome<SharedInstrument> get(const std::string& preset, bool& compiled);

  private:
    using Entry = std::shared_future<Outcome<SharedInstrument>>;

    const InstrumentSettings settings_;
    std::mutex mutex_;
    std::map<std::string, Entry> entries_;
};

/// Compiles what is in memory; nothing is read from files. `preset` is as read_preset() gives it; quality and
/// tuning of the settings are applied to it first. Threads: any.
Outcome<SharedInstrument> compile_preset(Preset preset, const InstrumentSettings& settings);

/// The same from a preset's text; problems name `name`. Threads: any.
Outcome<SharedInstrument> compile_preset_text(const std::string& text, const std::string& name,
                                              const InstrumentSettings& settings);

/// Loads and compiles without a cache: a preset's file is read anew.
Outcome<SharedInstrument> load_and_compile(const std::string& name, const InstrumentSettings& settings);

/// The preset with quality and tuning, before compile_instrument().
Outcome<Preset> load_with(const std::string& preset, const InstrumentSettings& settings);

/// What live playing falls back to under overload: half, then a fifth of the contact rate, and modes up to 10
/// kHz, then 5 kHz; where that is less than the instrument has.
std::vector<QualityDescription> live_qualities(const QualityDescription& full, double output_rate_hz);

}  // namespace jawari::host
