#include "commands/render/render_settings.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/render/preset_keys.h"
#include "formats/tuning/tuning.h"
#include "instrument/preset_library.h"
#include "instrument/program_presets.h"
#include "midi/guitar_mode.h"
#include "midi/read_midi_map.h"

namespace jawari::host {

namespace {

std::optional<std::string> general_midi_preset(int bank, int program, bool only_strings) {
    auto preset = program_preset(bank, program);
    if (!preset && !only_strings && bank != numbered_bank) preset = nearest_preset(program);
    if (!preset || !preset_exists(std::string(*preset))) return std::nullopt;
    return std::string(*preset);
}

/// The engine reads the other parameters; the bend range belongs to the interpreter.
void set_parameters(const RenderOptions& options, ScoreRules& rules) {
    for (const auto& [parameter, value] : options.parameters) {
        if (parameter == ParameterId::BendRange) {
            rules.interpreter.bend_range_semitones = value;
        } else {
            rules.parameters.emplace_back(parameter, value);
            rules.interpreter.initial[static_cast<std::size_t>(parameter)] = value;
        }
    }
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

Outcome<InstrumentSettings> instrument_settings(const RenderOptions& options) {
    InstrumentSettings settings;
    settings.output_rate_hz = options.rate_hz;
    settings.quality = options.quality.value_or(Quality::Live);
    settings.move_frets = options.move_frets;
    if (options.tuning.empty()) return settings;
    const auto tuning = load_tuning(options.tuning, options.keyboard_map);
    if (!tuning) return tuning.error();
    settings.tuning = tuning.value();
    return settings;
}

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
    set_parameters(options, rules);
    if (!options.midi_map.empty()) {
        const auto map = load_midi_map(options.midi_map);
        if (!map) return map.error();
        rules.interpreter.map = map.value();
    }
    if (instrument == nullptr) {
        rules.choose = [only_strings = options.only_strings](int bank, int program) {
            return general_midi_preset(bank, program, only_strings);
        };
        return rules;
    }
    if (options.guitar_channel > 0 || instrument->play == PlayMode::Guitar) {
        const int first = std::max(1, options.guitar_channel) - 1;
        if (auto error = set_guitar_mode(*instrument, first, rules.interpreter)) return *error;
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
