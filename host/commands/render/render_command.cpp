#include "commands/render/render_command.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/instrument_options.h"
#include "commands/render/options.h"
#include "commands/render/render.h"
#include "instrument/preset_library.h"

namespace jawari::host {

namespace {

const std::map<std::string, SampleFormat> formats{
    {"pcm16", SampleFormat::Pcm16}, {"pcm24", SampleFormat::Pcm24}, {"float", SampleFormat::Float}};

std::string footer() {
    std::vector<std::string> names;
    for (const NamedPreset& preset : named_presets()) names.push_back(preset.name);
    return "MIDI is a standard MIDI file; - is standard input. PRESET is a JSON file "
           "(docs/formats/preset.md) or\na name: " +
           join(names) +
           ".\n"
           "With auto each channel plays its own instrument, which the channel's program changes select "
           "(docs/formats/midi.md);\nwith a preset all channels play one instrument. Notes outside its range "
           "are ignored and counted.\n\n"
           "Several MIDI files go into a folder, a WAV file each, or one after the other into one sound "
           "file.\n"
           "A TIME is 90.5 (seconds), 1:30.5 or 1:02:03, at the tempo that is played.\n\n"
           "Examples:\n"
           "  jawari render song.mid -o song.wav\n"
           "  jawari render song.mid --preset bass-fretted -o song.wav --plot song.png\n"
           "  jawari render song.mid --preset my-bass.json -o song.wav --rate 96000 --format float --tail 2\n"
           "  jawari render song.mid -o song.wav --stems stems/ --set palm_mute=0.3 --limiter -1\n"
           "  jawari render *.mid -o out/ --jobs 4\n"
           "  jawari render one.mid two.mid -o both.flac --start 0:10 --end 1:30 --mono\n"
           "  jawari render - -o - --preset bass-fretted < song.mid | aplay\n\n"
           "Exit codes: 0 done; 2 wrong command line; 3 invalid input file; 4 a file cannot be read or "
           "written;\n"
           "5 internal error; 7 warnings with --strict; 129 hung up; 130 interrupted; 143 terminated.";
}

CLI::Validator tail() {
    const auto check = [](const std::string& text) {
        const auto value = parse_number(text);
        if (text == "auto" || (value && *value >= 0 && *value <= longest_tail_s)) return std::string();
        return refusal(text, "auto, or 0 to " + shortest(longest_tail_s) + " seconds");
    };
    return {check, ""};
}

CLI::Validator time_of_music() {
    const auto check = [](const std::string& text) {
        const auto value = parse_time(text);
        if (value && *value <= latest_time_s) return std::string();
        return refusal(text, "seconds, M:SS or H:MM:SS, to " + shortest(latest_time_s) + " s");
    };
    return {check, ""};
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
           "-r,-s,--rate",
           [&options](const std::string& text) {
               options.rate_hz = static_cast<std::uint32_t>(*parse_number(text));
           },
           "Sampling rate, default 48000")
        ->type_name("HZ")
        ->check(whole_between(lowest_render_rate_hz, highest_render_rate_hz, " of hertz"));
    add_choice(app, "--format", options.format, formats, "Sample format, default pcm24");
    app.add_option_function<std::string>(
           "--tail",
           [&options](const std::string& text) {
               if (text != "auto") options.tail_s = *parse_number(text);
           },
           "Sound after the last event: seconds, or auto: until it has stayed below --silence for " +
               shortest(silence_s) + " s, at most " + shortest(automatic_tail_limit_s) + " s")
        ->type_name("S|auto")
        ->check(tail());
    app.add_option("--silence", options.silence_dbfs, "Level below which --tail auto ends, default -90 dBFS")
        ->type_name("DBFS")
        ->check(number_between(-180, -20));
    add_instrument_options(app, options.instrument,
                           "Keeps the mix below this level, -40 to 0, and reports when it acts; default off");
}

void add_music_options(CLI::App& app, RenderOptions& options) {
    app.add_flag("--only-strings", options.only_strings,
                 "With auto: programs without strings are silent instead of played by the nearest preset");
    app.add_flag(
        "--strict", options.strict,
        "Refuse MIDI files that depart from the standard instead of repairing what they lack; warnings are "
        "an error (exit code 7), the outputs are written nevertheless");
    app.add_option_function<std::string>(
           "--start", [&options](const std::string& text) { options.start_s = *parse_time(text); },
           "Leave out what comes before; its programs, controllers and bends hold, its notes do not")
        ->type_name("TIME")
        ->check(time_of_music());
    app.add_option_function<std::string>(
           "--end", [&options](const std::string& text) { options.end_s = *parse_time(text); },
           "Let go of all notes at this time of the music; --tail follows")
        ->type_name("TIME")
        ->check(time_of_music());
    app.add_option("-T,--tempo", options.tempo_percent, "Tempo, 10 to 1000 % of the file's, default 100")
        ->type_name("PERCENT")
        ->check(number_between(10, 1000));
    const auto channel = whole_between(1, 16, "");
    app.add_option("-Q,--mute", options.mute, "Channels whose notes are left out, 1 to 16; may be repeated")
        ->type_name("CHANNEL[,CHANNEL...]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(channel);
    app.add_option("--solo", options.solo, "Channels whose notes alone are played; may be repeated")
        ->type_name("CHANNEL[,CHANNEL...]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(channel);
    app.add_option_function<std::string>(
           "-K,--transpose",
           [&options](const std::string& text) {
               options.transpose_semitones = static_cast<int>(*parse_number(text));
           },
           "Semitones by which all notes but drums are moved, -48 to 48")
        ->type_name("SEMITONES")
        ->check(whole_between(-48, 48, ""));
    app.add_option_function<std::string>(
           "--seed",
           [&options](const std::string& text) {
               options.seed = static_cast<std::uint64_t>(*parse_number(text));
           },
           "Small irregularities of times and velocities, reproducible for the same number; default none")
        ->type_name("N")
        ->check(whole_between(0, 9007199254740991, ""));
}

void add_output_options(CLI::App& app, RenderOptions& options) {
    app.add_option(
           "-o,-F,--out", options.out,
           "Sound file: .wav, .flac, .ogg, .aiff, .caf, .w64 or .raw; a folder for a WAV file of each "
           "MIDI file; - for WAV on standard output")
        ->required()
        ->type_name("FILE")
        ->check(some_name());
    app.add_option("--stems", options.stems,
                   "Each string separately: one channel each in one WAV file, or with FOLDER/ one file each")
        ->type_name("FILE|FOLDER/")
        ->check(some_name());
    app.add_option("--stats", options.stats, "Statistics as JSON; - for standard output")
        ->type_name("FILE.json")
        ->check(some_name());
    app.add_option("--plot", options.plot, "Waveform and spectrogram: FILE.svg or FILE.png")
        ->type_name("FILE")
        ->check(picture());
    app.add_flag("--mono", options.mono, "One channel, the mean of left and right");
    app.add_flag("-q,--quiet", options.quiet, "Print neither a summary nor notices");
    app.add_flag("--overwrite", options.overwrite,
                 "Outputs may replace files of other kinds; never what is read");
    app.add_option_function<std::string>(
           "-j,--jobs",
           [&options](const std::string& text) { options.jobs = static_cast<unsigned>(*parse_number(text)); },
           "Number of files rendered at the same time, default one per processor")
        ->type_name("N")
        ->check(whole_between(1, 256, ""));
}

}  // namespace

void add_render_command(CLI::App& app, Command& command) {
    CLI::App* render_app = app.add_subcommand("render", "Plays MIDI files on instruments, into sound files");
    const auto options = std::make_shared<RenderOptions>();
    render_app->add_option("midi", options->midi, "Standard MIDI files; - for standard input")
        ->required()
        ->type_name("MIDI...");
    render_app->add_option("-p,--preset", options->preset, "Preset file or name, default auto")
        ->type_name("PRESET|auto")
        ->check(some_name());
    add_output_options(*render_app, *options);
    add_sound_options(*render_app, *options);
    add_music_options(*render_app, *options);
    render_app->footer(footer());
    render_app->callback([options, &command] { command = [options] { return render(*options); }; });
}

}  // namespace jawari::host
