// jawari: reads the command line and runs one subcommand. Every failure becomes one line and an exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "base/suggestion.h"
#include "base/text.h"
#include "cli/command.h"
#include "commands/bench_latency/latency_command.h"
#include "commands/campaign/campaign_command.h"
#include "commands/info/info_command.h"
#ifdef JAWARI_LIVE
#include "commands/play/play_command.h"
#endif
#include "commands/render/render_command.h"
#include "commands/simulate/simulate_command.h"
#include "exit_codes.h"
#include "jawari/version.h"

namespace jawari::host {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  jawari simulate lab/bass --plot bass.svg\n"
    "  jawari simulate my-scene.json --out probes.csv --stats -\n"
    "  jawari render song.mid --preset bass-fretted -o song.wav\n"
    "  jawari play --preset bass-fretted\n"
    "  jawari presets\n"
    "  jawari info bass-fretted\n"
    "\n"
    "Exit codes: 0 done; 2 wrong command line; 3 invalid input file; 4 a file cannot be read or written;\n"
    "5 internal error; 6 audio or MIDI device; 7 warnings with --strict; 129 hung up; 130 interrupted;\n"
    "143 terminated. Every failure prints one line on standard error.";

/// A word that no option or command has; nothing if all words are known.
std::optional<std::string> unknown_word(const CLI::App& app, const std::vector<std::string>& words) {
    const auto parsed = app.get_subcommands();
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    std::vector<std::string> options, commands;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; }))
        commands.push_back(each->get_name());
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with("-")) return name + ": unknown option" + did_you_mean(name, options);
        if (parsed.empty())
            return name + ": unknown command" + did_you_mean(name, commands) +
                   " (allowed: " + join(commands) + ")";
    }
    return std::nullopt;
}

/// A misspelt option is the reason, whatever is missing because of it.
MaybeError usage(const CLI::App& app, const CLI::ParseError& problem) {
    const auto unknown = unknown_word(app, app.remaining(true));
    std::string message = unknown ? *unknown : problem.what();
    std::replace(message.begin(), message.end(), '\n', ' ');
    const auto parsed = app.get_subcommands();
    const std::string subcommand = parsed.empty() ? "" : parsed.front()->get_name() + " ";
    const char* see = message.ends_with('?') ? " See" : "; see";
    return Error{ErrorKind::Usage, message + see + " jawari " + subcommand + "--help"};
}

MaybeError run(int argc, char** argv, int& help_exit_code) {
    CLI::App app{"Strings that strike things: simulates strings against frets, necks and bridges.", "jawari"};
    app.footer(footer);
    app.set_version_flag("-V,--version", "jawari " JAWARI_VERSION);
    app.require_subcommand(1);
    Command command;
    add_simulate_command(app, command);
    add_render_command(app, command);
    add_presets_command(app, command);
    add_info_command(app, command);
    add_bench_latency_command(app, command);
    add_campaign_command(app, command);
#ifdef JAWARI_LIVE
    add_play_command(app, command);
    add_devices_command(app, command);
#endif
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        help_exit_code = app.exit(help);
        return std::nullopt;
    } catch (const CLI::ParseError& problem) {
        return usage(app, problem);
    }
    return command();
}

int guarded_main(int argc, char** argv) {
    install_signal_handlers();
    MaybeError error;
    int help_exit_code = 0;
    try {
        error = run(argc, argv, help_exit_code);
    } catch (const std::bad_alloc&) {
        error = Error{ErrorKind::Internal, "jawari: out of memory"};
    } catch (const std::exception& problem) {
        error = Error{ErrorKind::Internal, std::string("jawari: internal error: ") + problem.what()};
    }
    if (!error) return help_exit_code;
    report(error->message);
    return exit_code(error->kind);
}

}  // namespace
}  // namespace jawari::host

int main(int argc, char** argv) {
    return jawari::host::guarded_main(argc, argv);
}
