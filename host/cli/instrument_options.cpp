#include "cli/instrument_options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "cli/command_line.h"
#include "formats/tuning/tuning.h"
#include "formats/words/quality_words.h"
#include "midi/read_midi_map.h"

namespace jawari::host {

namespace {

const std::map<std::string, Quality> qualities = quality_words();

void add_sound_options(CLI::App& app, InstrumentOptions& options, const std::string& limiter) {
    add_choice(app, "--quality", options.quality, qualities,
               "Resolution of the strings, default live (the values of the preset)");
    app.add_option("--gain", options.gain_db, "Gain relative to the preset, -120 to 60 dB")
        ->type_name("DB")
        ->check(number_between(-120, 60));
    app.add_option("--limiter", options.limiter_dbfs, limiter)
        ->type_name("DBFS")
        ->check(number_between(-40, 0));
    add_parameter_settings(app, options.parameters);
}

}  // namespace

void add_instrument_options(CLI::App& app, InstrumentOptions& options, const std::string& limiter) {
    add_sound_options(app, options, limiter);
    app.add_option("--tuning", options.tuning,
                   "Pitches of all keys: a Scala scale, with Ableton's lines or without, or an AnaMark file")
        ->type_name("FILE.scl|FILE.ascl|FILE.tun")
        ->check(some_name());
    app.add_option("--keyboard-map", options.keyboard_map, "Scala keyboard map of the scale")
        ->type_name("FILE.kbm")
        ->check(some_name());
    add_flag(app, "--move-frets", options.move_frets, true, "Move the frets to the notes of the tuning");
    app.add_option("--midi-map", options.midi_map, "Assigns controllers to parameters (docs/formats/midi.md)")
        ->type_name("FILE.json")
        ->check(some_name());
    add_whole(app, "--guitar-mode", options.guitar_channel, 1, 16, "",
              "One string per channel: this channel plays the last string of the preset, the next channel "
              "the one before")
        ->type_name("CHANNEL");
}

MaybeError check_dependencies(const InstrumentOptions& options, bool programs_choose) {
    if (!options.tuning && options.keyboard_map)
        return usage_error("--keyboard-map", *options.keyboard_map, "only with --tuning");
    if (!options.tuning && options.move_frets.value_or(false))
        return usage_error("--move-frets", "given", "only with --tuning");
    if (options.guitar_channel && programs_choose)
        return usage_error("--guitar-mode", std::to_string(*options.guitar_channel),
                           "only with --preset NAME");
    return std::nullopt;
}

void add_inputs(const InstrumentOptions& options, FilePlan& files) {
    files.add_input("--tuning", options.tuning.value_or(""));
    files.add_input("--keyboard-map", options.keyboard_map.value_or(""));
    files.add_input("--midi-map", options.midi_map.value_or(""));
}

Outcome<InstrumentSettings> instrument_settings(const InstrumentOptions& options, double rate_hz) {
    InstrumentSettings settings;
    settings.output_rate_hz = rate_hz;
    settings.quality = options.quality.value_or(Quality::Live);
    settings.move_frets = options.move_frets.value_or(false);
    if (!options.tuning) return settings;
    const auto tuning = load_tuning(*options.tuning, options.keyboard_map.value_or(""));
    if (!tuning) return tuning.error();
    settings.tuning = tuning.value();
    return settings;
}

MaybeError set_interpreter(const InstrumentOptions& options, InterpreterSettings& settings) {
    for (const auto& [parameter, value] : options.parameters) {
        if (parameter == ParameterId::BendRange)
            settings.bend_range_semitones = value;
        else
            settings.initial[static_cast<std::size_t>(parameter)] = value;
    }
    if (!options.midi_map) return std::nullopt;
    const auto map = load_midi_map(*options.midi_map);
    if (!map) return map.error();
    settings.map = map.value();
    return std::nullopt;
}

std::vector<std::pair<ParameterId, double>> engine_parameters(const InstrumentOptions& options) {
    auto parameters = options.parameters;
    std::erase_if(parameters, [](const auto& each) { return each.first == ParameterId::BendRange; });
    return parameters;
}

int guitar_channel(const InstrumentOptions& options, const InstrumentDescription& instrument) {
    return options.guitar_channel.value_or(instrument.play == PlayMode::Guitar ? 1 : 0);
}

}  // namespace jawari::host
