#include "commands/bench_latency/latency_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/sound_file.h"
#include "cli/command_line.h"
#include "commands/bench_latency/latency.h"
#include "formats/words/quality_words.h"

namespace jawari::host {

namespace {

constexpr double most_block_frames = 8192;
constexpr double most_blocks = 100'000'000;
constexpr double most_passes = 1000;
constexpr double largest_seed = 4294967295;

CLI::Validator whole(double lowest, double highest) {
    const auto check = [=](const std::string& text) {
        const auto value = parse_number(text);
        if (value && *value == std::floor(*value) && *value >= lowest && *value <= highest)
            return std::string();
        return refusal(text, "a whole number, " + shortest(lowest) + " to " + shortest(highest));
    };
    return {check, ""};
}

/// An option that takes a whole number.
template <class T>
void add_whole(CLI::App& app, const std::string& name, T& target, double lowest, double highest,
               const std::string& help) {
    app.add_option_function<std::string>(
           name, [&target](const std::string& text) { target = static_cast<T>(*parse_number(text)); }, help)
        ->type_name("N")
        ->check(whole(lowest, highest));
}

}  // namespace

void add_bench_latency_command(CLI::App& app, Command& command) {
    static const std::map<std::string, Quality> qualities = quality_words();
    CLI::App* bench = app.add_subcommand(
        "bench-latency", "Measures live playing: frames from event to sound, CPU time of blocks");
    const auto options = std::make_shared<LatencyOptions>();
    const auto quality = std::make_shared<std::optional<Quality>>();
    bench
        ->add_option(
            "--preset", options->presets,
            "Preset file or name, may be repeated; default: the most expensive built-in one, and the "
            "steel-string guitar")
        ->type_name("PRESET")
        ->allow_extra_args(false);
    bench
        ->add_option_function<std::vector<std::string>>(
            "--frames",
            [options](const std::vector<std::string>& sizes) {
                options->frames.clear();
                for (const std::string& size : sizes)
                    options->frames.push_back(static_cast<std::size_t>(*parse_number(size)));
            },
            "Frames per block, may be repeated; default 16, 32, 64 and 128")
        ->type_name("N")
        ->allow_extra_args(false)
        ->check(whole(1, most_block_frames));
    add_whole(*bench, "--blocks", options->blocks, 1, most_blocks,
              "Blocks timed for each preset and size, over all passes, default 1000000");
    add_whole(*bench, "--passes", options->passes, 1, most_passes, "Identical passes, default 7");
    add_whole(*bench, "--rate", options->rate_hz, lowest_render_rate_hz, highest_render_rate_hz,
              "Sampling rate, default 48000");
    add_whole(*bench, "--seed", options->seed, 0, largest_seed, "Seed of the performance, default 1");
    add_choice(*bench, "--quality", *quality, qualities, "Quality, default live");
    bench->add_flag(
        "--governor", options->governor,
        "Lower the quality under overload, as in jawari play; passes then differ from one another");
    bench->add_flag("--two-hands", options->two_hands,
                    "Ten keys at once under the pedal, in place of chords on all courses");
    bench->add_flag("--plugin", options->plugin, "Time blocks of the plugin instead of those of jawari play");
    bench->add_option("--json", options->json, "All results as JSON; - for standard output")
        ->type_name("FILE");
    bench->add_option("--csv", options->csv, "The table as CSV")->type_name("FILE");
    bench->add_option("--plot", options->plot, "Histograms: FILE.svg or FILE.png")->type_name("FILE");
    bench->add_flag("--overwrite", options->overwrite,
                    "Outputs may replace files of other kinds; never what is read");
    bench->footer(
        "Plays as hard as MIDI allows: struck chords, runs, bends, palm mutes, legato "
        "(docs/player/player.md).\n"
        "The minimum of a block over identical passes excludes the influence of the scheduler.\n\n"
        "Example: jawari bench-latency --preset guitar-steel --frames 64 --blocks 70000 --plot latency.png");
    bench->callback([options, quality, &command] {
        if (*quality) options->quality = **quality;
        command = [options] { return bench_latency(*options); };
    });
}

}  // namespace jawari::host
