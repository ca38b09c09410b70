#include "render/render_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/text.h"
#include "preset/read_preset.h"
#include "render/options.h"
#include "render/render.h"

namespace jawari::host {

namespace {

const std::map<std::string, SampleFormat> formats{
    {"pcm16", SampleFormat::Pcm16}, {"pcm24", SampleFormat::Pcm24}, {"float", SampleFormat::Float}};

std::string footer() {
    return "MIDI is a standard MIDI file of type 0 or 1. PRESET is a JSON file (docs/preset-format.md) or a "
           "built-in "
           "preset: " +
           join(builtin_preset_names()) +
           ".\n"
           "All channels play the instrument; notes outside its range are ignored and counted.\n\n"
           "Examples:\n"
           "  jawari render song.mid --preset bass-fretted -o song.wav\n"
           "  jawari render song.mid --preset bass-fretted -o song.wav --plot song.png\n"
           "  jawari render song.mid --preset my-bass.json -o song.wav --rate 96000 --format float --tail "
           "2\n\n"
           "Exit codes: 0 done; 2 wrong command line; 3 invalid MIDI file or preset; 4 a file cannot be read "
           "or written;\n"
           "5 internal error; 130 interrupted; 143 terminated.";
}

CLI::Validator whole_rate() {
    const auto check = [](const std::string& text) {
        const auto value = parse_number(text);
        const bool whole = value && *value == std::floor(*value);
        if (whole && *value >= lowest_render_rate_hz && *value <= highest_render_rate_hz)
            return std::string();
        return refusal(text, "a whole number of hertz, " + std::to_string(lowest_render_rate_hz) + " to " +
                                 std::to_string(highest_render_rate_hz));
    };
    return {check, ""};
}

CLI::Validator tail() {
    const auto check = [](const std::string& text) {
        const auto value = parse_number(text);
        if (text == "auto" || (value && *value >= 0 && *value <= longest_tail_s)) return std::string();
        return refusal(text, "auto, or 0 to " + shortest(longest_tail_s) + " seconds");
    };
    return {check, ""};
}

CLI::Validator name() {
    return {[](const std::string& text) { return text.empty() ? refusal(text, "a name") : std::string(); },
            ""};
}

CLI::Validator picture() {
    const auto check = [](const std::string& text) {
        const std::string lower = lower_case(text);
        if (lower.ends_with(".svg") || lower.ends_with(".png")) return std::string();
        return refusal(text, "a name that ends in .svg or .png");
    };
    return {check, ""};
}

void add_sound_options(CLI::App& app, RenderOptions& options) {
    app.add_option_function<std::string>(
           "--rate",
           [&options](const std::string& text) {
               options.rate_hz = static_cast<std::uint32_t>(*parse_number(text));
           },
           "Sampling rate of the WAV file, 48000 unless told")
        ->type_name("HZ")
        ->check(whole_rate());
    add_choice(app, "--format", options.format, formats, "Samples of the WAV file, pcm24 unless told");
    app.add_option_function<std::string>(
           "--tail",
           [&options](const std::string& text) {
               if (text != "auto") options.tail_s = *parse_number(text);
           },
           "Sound after the last event: seconds, or auto: until it has stayed below " +
               shortest(silence_dbfs) + " dBFS for " + shortest(silence_s) + " s, at most " +
               shortest(automatic_tail_limit_s) + " s")
        ->type_name("S|auto")
        ->check(tail());
    app.add_option("--gain", options.gain_db, "Louder or softer than the preset says, -120 to 60 dB")
        ->type_name("DB")
        ->check(number_between(-120, 60));
}

}  // namespace

void add_render_command(CLI::App& app, Command& command) {
    CLI::App* render_app =
        app.add_subcommand("render", "Plays a MIDI file on an instrument, into a WAV file");
    const auto options = std::make_shared<RenderOptions>();
    render_app->add_option("midi", options->midi, "Standard MIDI file")->required()->type_name("MIDI");
    render_app->add_option("--preset", options->preset, "Preset file or built-in name")
        ->required()
        ->type_name("PRESET");
    render_app->add_option("-o,--out", options->out, "WAV file to write")
        ->required()
        ->type_name("FILE.wav")
        ->check(name());
    add_sound_options(*render_app, *options);
    render_app->add_option("--stats", options->stats, "Statistics as JSON; - for standard output")
        ->type_name("FILE.json")
        ->check(name());
    render_app->add_option("--plot", options->plot, "Waveform and spectrogram: FILE.svg or FILE.png")
        ->type_name("FILE")
        ->check(picture());
    render_app->footer(footer());
    render_app->callback([options, &command] { command = [options] { return render(*options); }; });
}

}  // namespace jawari::host
