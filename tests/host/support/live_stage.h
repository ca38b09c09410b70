// Instruments and players for tests of live playing.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "commands/bench_latency/adversary.h"
#include "instrument/instrument_cache.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "player/player.h"

namespace jawari::test {

/// A factory preset made cheap: few strings, few modes, a low contact rate.
inline host::SharedInstrument small_live_instrument(const std::string& name, double rate_hz = 48000,
                                                    std::size_t strings = 3, bool lower_qualities = false) {
    const host::InstrumentSettings settings;
    host::Preset preset = host::load_with(name, settings).value();
    preset.instrument.quality = {2 * rate_hz, 3000};
    if (preset.instrument.strings.size() > strings) preset.instrument.strings.resize(strings);
    auto loaded = std::make_shared<host::LoadedInstrument>();
    loaded->model = compile_instrument(preset.instrument, rate_hz).value();
    if (lower_qualities) {
        const std::vector<QualityDescription> lower{{2 * rate_hz, 1500}, {rate_hz, 800}};
        EXPECT_FALSE(add_qualities(loaded->model, preset.instrument, lower));
    }
    loaded->preset = preset;
    return loaded;
}

inline host::LiveSettings live_settings(double rate_hz = 48000) {
    host::LiveSettings settings;
    settings.rate_hz = rate_hz;
    settings.interpreter.map = host::adversary_map();
    settings.overload.enabled = false;  // a busy machine must not decide what tests hear
    return settings;
}

struct LiveSound {
    std::vector<double> left, right;

    /// One block of `frames` frames at its end; returns the time after it.
    std::int64_t add(host::LivePlayer& player, std::size_t frames, std::int64_t now_ns, double rate_hz) {
        const std::size_t begin = left.size();
        left.resize(begin + frames);
        right.resize(begin + frames);
        player.process(left.data() + begin, right.data() + begin, frames, now_ns);
        return now_ns + static_cast<std::int64_t>(1e9 * static_cast<double>(frames) / rate_hz);
    }
};

}  // namespace jawari::test
