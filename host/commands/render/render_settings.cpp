#include "commands/render/render_settings.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/render/preset_keys.h"
#include "instrument/preset_library.h"
#include "instrument/program_presets.h"
#include "midi/guitar_mode.h"

namespace jawari::host {

namespace {

std::optional<std::string> general_midi_preset(int bank, int program, bool only_strings) {
    auto preset = program_preset(bank, program);
    if (!preset && !only_strings && bank != numbered_bank) preset = nearest_preset(program);
    if (!preset || !preset_exists(std::string(*preset))) return std::nullopt;
    return std::string(*preset);
}

/// Bit c: channel c, from 0.
unsigned channel_bits(const std::vector<int>& channels) {
    unsigned bits = 0;
    for (const int channel : channels) bits |= 1U << static_cast<unsigned>(channel - 1);
    return bits;
}

unsigned muted_channels(const RenderOptions& options) {
    const unsigned others = options.solo.empty() ? 0 : 0xFFFFU & ~channel_bits(options.solo);
    return others | channel_bits(options.mute);
}

}  // namespace

Outcome<ScoreRules> score_rules(const RenderOptions& options, const InstrumentDescription* instrument) {
    ScoreRules rules;
    rules.preset = options.preset;
    rules.interpreter.transpose_semitones = options.transpose_semitones;
    rules.tempo = options.tempo_percent / 100;
    rules.muted = muted_channels(options);
    const auto frame = [&options](double seconds) {
        return static_cast<std::uint64_t>(std::llround(seconds * options.rate_hz));
    };
    rules.excerpt.begin = frame(options.start_s);
    if (options.end_s) rules.excerpt.end = frame(*options.end_s);
    rules.parameters = engine_parameters(options.instrument);
    if (auto error = set_interpreter(options.instrument, rules.interpreter)) return *error;
    if (instrument == nullptr) {
        rules.choose = [only_strings = options.only_strings](int bank, int program) {
            return general_midi_preset(bank, program, only_strings);
        };
        return rules;
    }
    const int channel = guitar_channel(options.instrument, *instrument);
    if (channel > 0) {
        if (auto error = set_guitar_mode(*instrument, channel - 1, rules.interpreter)) return *error;
    }
    return rules;
}

Outcome<ScoreRules> score_rules(const RenderOptions& options, const InstrumentSettings& instruments) {
    if (options.preset == automatic_preset) {
        auto rules = score_rules(options, nullptr);
        if (!rules || options.only_strings) return rules;
        rules.value().choose_for_key = [keys = std::make_shared<PresetKeys>(instruments)](
                                           const std::string& name, int key) {
            return keys->player_of(name, key);
        };
        return rules;
    }
    const auto preset = load_with(options.preset, instruments);
    if (!preset) return preset.error();
    return score_rules(options, &preset.value().instrument);
}

}  // namespace jawari::host
