#include "plugin/core/compile_state.h"

#include "midi/guitar_mode.h"
#include "midi/read_midi_map.h"

namespace jawari::host {

namespace {

Outcome<std::optional<KeyFrequencies>> tuning_of(const PluginState& state) {
    if (state.scale_text.empty() && state.tun_text.empty()) return std::optional<KeyFrequencies>();
    NamedText scale{"scale", state.scale_text};
    if (!state.tun_text.empty()) scale = {"scale.tun", state.tun_text};
    std::optional<NamedText> keyboard_map;
    if (!state.keyboard_text.empty()) keyboard_map = NamedText{"keyboard map", state.keyboard_text};
    const auto tuned = read_tuning(scale, keyboard_map);
    if (!tuned) return tuned.error();
    return std::optional<KeyFrequencies>(tuned.value());
}

}  // namespace

Outcome<CompiledState> compile_state(const PluginState& state, Quality quality, double rate_hz) {
    InstrumentSettings settings;
    settings.output_rate_hz = rate_hz;
    settings.quality = quality;
    settings.move_frets = state.move_frets;
    auto tuning = tuning_of(state);
    if (!tuning) return tuning.error();
    settings.tuning = tuning.value();
    CompiledState compiled;
    if (!state.midi_map_text.empty()) {
        const auto map = read_midi_map(state.midi_map_text, "MIDI map");
        if (!map) return map.error();
        compiled.interpreter.map = map.value();
    }
    const std::string name = state.preset_name.empty() ? "preset" : state.preset_name;
    auto instrument = compile_preset_text(state.preset_text, name, settings);
    if (!instrument) return instrument.error();
    compiled.instrument = instrument.value();
    if (state.guitar_channel > 0) {
        const auto& description = compiled.instrument->preset.instrument;
        if (auto error = set_guitar_mode(description, state.guitar_channel - 1, compiled.interpreter))
            return *error;
    }
    return compiled;
}

bool compile_alike(const PluginState& a, const PluginState& b) {
    return a.preset_text == b.preset_text && a.scale_text == b.scale_text && a.tun_text == b.tun_text &&
           a.keyboard_text == b.keyboard_text && a.move_frets == b.move_frets &&
           a.midi_map_text == b.midi_map_text && a.guitar_channel == b.guitar_channel;
}

}  // namespace jawari::host
