#include "commands/simulate/simulate_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/text.h"
#include "cli/command_line.h"
#include "commands/simulate/options.h"
#include "commands/simulate/probe_output.h"
#include "commands/simulate/simulate.h"
#include "formats/scene/read_scene.h"
#include "formats/words/quality_words.h"
#include "jawari/scene/description.h"

namespace jawari::host {

namespace {

const std::map<std::string, Scheme> schemes{{"exact", Scheme::Exact}, {"theta", Scheme::Theta}};
const std::map<std::string, Quality> qualities = quality_words();
const std::map<std::string, Start> starts{{"exact", Start::Exact}, {"backward", Start::Backward}};
const std::map<std::string, ImpactLaw> laws{{"newton", ImpactLaw::Newton},
                                            {"passive", ImpactLaw::Passive},
                                            {"signorini", ImpactLaw::Signorini},
                                            {"paoli-schatzman", ImpactLaw::PaoliSchatzman}};

std::string footer() {
    return "SCENE is a JSON file (docs/formats/scene.md), - for standard input, or a built-in scene: " +
           join(builtin_scene_names()) +
           ".\n\n"
           "Row n of an output is t = n/output rate, n = 0 to round(duration x output rate). Without --out, "
           "--stats and\n"
           "--plot a summary is printed.\n\n"
           "Examples:\n"
           "  jawari simulate lab/bass                                      a summary\n"
           "  jawari simulate lab/bass --out bass.csv --stats bass.json     probes and statistics\n"
           "  jawari simulate lab/bass --law signorini --plot bass.svg      pictures\n"
           "  jawari simulate lab/one-contact --output-rate 48000 --contact-rate 2016000 --out one.wav\n"
           "  jawari simulate lab/fretless --duration 0.01 --out - > probes.csv\n\n"
           "Exit codes: 0 done; 2 wrong command line; 3 invalid scene; 4 a file cannot be read or written;\n"
           "5 internal error; 7 warnings with --strict; 129 hung up; 130 interrupted; 143 terminated.";
}

void add_settings(CLI::App& app, Overrides& overrides) {
    const auto rate = number_between(limits::min_rate_hz, limits::max_rate_hz);
    app.add_option("--output-rate", overrides.output_rate_hz, "Rows per second [Hz]")
        ->type_name("HZ")
        ->check(rate);
    app.add_option("--contact-rate", overrides.contact_rate_hz,
                   "Contact steps per second [Hz], an integer multiple of the output rate")
        ->type_name("HZ")
        ->check(rate);
    app.add_option("--duration", overrides.duration_s, "Length of the simulation [s]")
        ->type_name("S")
        ->check(number_between(0, longest_duration_s));
    add_choice(app, "--quality", overrides.quality, qualities,
               "Cut the modes and choose the contact rate for an error of 20, 1 or 0.1 %");
    add_choice(app, "--scheme", overrides.scheme, schemes, "Time-stepping scheme");
    app.add_option("--theta", overrides.theta, "Parameter of --scheme theta, 0.5 to 1")
        ->type_name("X")
        ->check(number_between(0.5, 1));
    add_choice(app, "--law", overrides.law, laws, "Impact law (theta: newton only)");
    app.add_option("--restitution", overrides.restitution, "Restitution of every contact, 0 to 1")
        ->type_name("E")
        ->check(number_between(0, 1));
    add_choice(app, "--start", overrides.start, starts,
               "First backward velocity: from the exact motion before t = 0, or the velocity itself");
}

void add_files(CLI::App& app, SimulateOptions& options) {
    app.add_option("-o,--out", options.out,
                   "Probes: FILE.csv, FILE.h5 (with contacts and energies), FILE.wav; - for CSV")
        ->type_name("FILE")
        ->check(CLI::Validator(
            [](const std::string& path) {
                if (output_format(path)) return std::string();
                return refusal(path, "a name that ends in .csv, .h5 or .wav, or -");
            },
            ""));
    app.add_flag(
        "--meter-steps", options.meter_steps,
        "Meter losses and work at each contact step, for FILE.h5; computes every step, which is slow");
    app.add_flag("--overwrite", options.overwrite,
                 "Outputs may replace files of other kinds; never what is read");
    app.add_option("--stats", options.stats, "Statistics as JSON; - for standard output")
        ->type_name("FILE.json")
        ->check(CLI::Validator(
            [](const std::string& path) { return path.empty() ? refusal(path, "a name") : ""; }, ""));
    app.add_option("--save-state", options.save_state, "State at the end, from which --resume goes on")
        ->type_name("FILE")
        ->check(some_name());
    app.add_option("--resume", options.resume,
                   "Goes on from a saved state, with its time, to the end of the scene")
        ->type_name("FILE")
        ->check(some_name());
    app.add_option("--plot", options.plot, "Snapshots, probe signals and contactogram: FILE.svg or FILE.png")
        ->type_name("FILE")
        ->check(CLI::Validator(
            [](const std::string& path) {
                const std::string name = lower_case(path);
                if (name.ends_with(".svg") || name.ends_with(".png")) return std::string();
                return refusal(path, "a name that ends in .svg or .png");
            },
            ""));
}

/// The switches of Skipping by the words of --no-skip.
const std::map<std::string, bool Skipping::*> skips{{"flight", &Skipping::flight},
                                                    {"certificate", &Skipping::certificate},
                                                    {"near", &Skipping::near},
                                                    {"lazy", &Skipping::lazy},
                                                    {"sleep", &Skipping::sleep}};

void switch_off(Skipping& skipping, const std::string& what) {
    if (what == "all") {
        skipping = skip_nothing;
    } else {
        skipping.*skips.at(what) = false;
    }
}

void add_skipping(CLI::App& app, Skipping& skipping) {
    app.add_option_function<std::vector<std::string>>(
           "--no-skip",
           [&skipping](const std::vector<std::string>& words) {
               for (const std::string& what : words) switch_off(skipping, what);
           },
           "What not to skip, for measurement: all, or some of flight, certificate, near, lazy, sleep")
        ->type_name("WHAT[,WHAT...]")
        ->delimiter(',')
        ->expected(1)
        ->check(CLI::Validator(
            [](const std::string& what) {
                const std::vector<std::string> words{"all", "flight", "certificate", "near", "lazy", "sleep"};
                return what == "all" || skips.contains(what)
                           ? std::string()
                           : refusal(what + did_you_mean(what, words), join(words));
            },
            ""));
}

}  // namespace

void add_simulate_command(CLI::App& app, Command& command) {
    CLI::App* simulate_app =
        app.add_subcommand("simulate", "Simulates a scene: strings, obstacles and probes from a JSON file");
    const auto options = std::make_shared<SimulateOptions>();
    simulate_app->add_option("SCENE", options->scene, "Scene file, built-in name, or -")
        ->required()
        ->type_name("");
    add_settings(*simulate_app, options->overrides);
    add_skipping(*simulate_app, options->skipping);
    add_files(*simulate_app, *options);
    simulate_app->add_flag("--strict", options->strict,
                           "Warnings are an error (exit code 7); the outputs are written nevertheless");
    simulate_app->footer(footer());
    simulate_app->callback([options, &command] { command = [options] { return simulate(*options); }; });
}

}  // namespace jawari::host
