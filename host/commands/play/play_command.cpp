#include "commands/play/play_command.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>

#include "base/output_file.h"
#include "base/sound_file.h"
#include "cli/command_line.h"
#include "cli/instrument_options.h"
#include "commands/play/device_list.h"
#include "commands/play/options.h"
#include "commands/play/play.h"
#include "commands/play/verbs.h"
#include "devices/audio_devices.h"
#include "devices/midi_receiver.h"

namespace jawari::host {

namespace {

std::string footer() {
    std::vector<std::string> verbs;
    for (const Verb& verb : verb_table()) verbs.emplace_back(verb.name);
    return "auto tries " + join(audio_systems()) + " for audio and " + join(midi_systems()) +
           " for MIDI, in this order, and reports its choice.\n"
           "On a terminal a shell reads commands while you play: " +
           join(verbs) +
           ".\n"
           "help explains them; they may also come through a pipe, and with --osc-port as OSC messages.\n"
           "Options can be kept in " +
           (default_config_path().empty() ? "a file (--config)" : printable(default_config_path())) +
           " (docs/commands/play.md); the command line overrides them.\n\n"
           "Examples:\n"
           "  jawari play\n"
           "  jawari play --ui --preset sitar\n"
           "  jawari play --preset bass-fretted --midi-in keystation --record take.wav\n"
           "  jawari play --audio alsa --audio-device USB --frames 64 --lock-memory\n"
           "  jawari play --no-shell --osc-port 7770 --preset guitar-12\n"
           "  printf 'note 40 100 2\\nquit\\n' | jawari play --preset bass-fretted\n\n"
           "Exit codes: 0 ended by quit, the end of the commands, SIGINT, SIGTERM or SIGHUP; 2 wrong command "
           "line;\n"
           "3 invalid input file; 4 a file cannot be read or written; 5 internal error; 6 audio or MIDI "
           "device, or no display for --ui.";
}

std::map<std::string, std::string> system_words(const std::vector<std::string>& words) {
    std::map<std::string, std::string> map{{"auto", "auto"}};
    for (const std::string& word : words) map.emplace(word, word);
    return map;
}

const std::map<std::string, std::string> audio_words = system_words(audio_system_words());
const std::map<std::string, std::string> midi_words = system_words(midi_system_words());

void add_device_options(CLI::App& app, PlayOptions& options) {
    add_choice(app, "-a,--audio", options.audio, audio_words, "Audio system, default auto");
    app.add_option("--audio-device", options.audio_device, "Number, or part of its name (jawari devices)")
        ->type_name("NAME|INDEX")
        ->check(some_name());
    add_choice(app, "-m,--midi", options.midi, midi_words, "MIDI system, default auto");
    app.add_option("--midi-in", options.midi_in,
                   "Input: number, part of its name, virtual (a port for others to connect to), or auto: all "
                   "inputs, and a virtual one")
        ->type_name("NAME|INDEX|virtual|auto")
        ->check(some_name());
    add_whole(app, "-r,--rate", options.rate_hz, lowest_render_rate_hz, highest_render_rate_hz, " of hertz",
              "Sampling rate, default 48000; the device may require another")
        ->type_name("HZ");
    add_whole(app, "-z,--frames", options.frames, lowest_play_frames, highest_play_frames, "",
              "Frames per block, default 128; the device may require another")
        ->type_name("N");
    add_flag(app, "--no-retry", options.retry, false, "End with exit code 6 when the device is lost");
    add_flag(app, "--lock-memory", options.lock_memory, true,
             "Keep the program's memory from being swapped out");
}

void add_sound_options(CLI::App& app, PlayOptions& options) {
    app.add_option("-p,--preset", options.preset,
                   "Preset file or name, default auto: guitar-steel, then as program changes select")
        ->type_name("PRESET|auto")
        ->check(some_name());
    add_flag(app, "--fixed-quality", options.fixed_quality, true,
             "Never lower the quality under load: late blocks are then heard as gaps");
    add_instrument_options(app, options.instrument,
                           "Keeps the sound below this level, -40 to 0, with a delay of 2 ms; default off");
}

void add_control_options(CLI::App& app, PlayOptions& options) {
    app.add_option("--record", options.record,
                   "Records what is played; survives a crash up to the last second")
        ->type_name("OUT.wav")
        ->check(some_name());
    app.add_option("--record-midi", options.record_midi,
                   "Records the MIDI that was played, timed to the frame; jawari render plays it again")
        ->type_name("OUT.mid")
        ->check(some_name());
    app.add_flag("--force", options.overwrite, "Recordings may overwrite files");
    add_flag(app, "-i,--no-shell", options.shell, false,
             "Read no commands, run until a signal arrives: for services");
    add_flag(app, "--ui", options.window, true,
             "With a window: the strings as they move, every parameter, presets (docs/window.md)");
    add_flag(app, "--monitor", options.monitor, true, "Print every MIDI message in words");
    add_whole(app, "--osc-port", options.osc_port, 1, 65535, "",
              "Accept commands as OSC messages on this UDP port")
        ->type_name("PORT");
    app.add_option("--osc-host", options.osc_host,
                   "Address on which OSC is accepted, default 127.0.0.1 (this machine alone)")
        ->type_name("ADDRESS")
        ->check(some_name());
    app.add_option("--config", options.config, "Configuration file instead of the user's default file")
        ->type_name("FILE.json")
        ->check(some_name());
}

MaybeError print(const std::string& text) {
    auto output = OutputFile::create("-");
    if (!output) return output.error();
    if (auto error = output.value().write(text)) return error;
    return output.value().commit();
}

}  // namespace

void add_play_command(CLI::App& app, Command& command) {
    CLI::App* play_app = app.add_subcommand("play", "Plays live: MIDI in, sound out");
    const auto options = std::make_shared<PlayOptions>();
    add_device_options(*play_app, *options);
    add_sound_options(*play_app, *options);
    add_control_options(*play_app, *options);
    play_app->footer(footer());
    play_app->callback([options, &command] { command = [options] { return play(*options); }; });
}

void add_devices_command(CLI::App& app, Command& command) {
    CLI::App* devices_app = app.add_subcommand("devices", "Lists audio devices and MIDI inputs");
    const auto json = std::make_shared<bool>(false);
    devices_app->add_flag("--json", *json, "As JSON");
    devices_app->callback([json, &command] {
        command = [json] {
            const DeviceSurvey survey = survey_devices();
            return print(*json ? devices_json(survey) : join(devices_text(survey), "\n") + "\n");
        };
    });
}

}  // namespace jawari::host
