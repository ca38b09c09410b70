#include "commands/info/info_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "base/builtin.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "base/sound_file.h"
#include "cli/command_line.h"
#include "commands/info/scene_survey.h"
#include "commands/info/survey_text.h"
#include "formats/json/parse.h"
#include "formats/scene/read_scene.h"
#include "formats/words/quality_words.h"
#include "instrument/program_presets.h"

namespace jawari::host {

namespace {

const std::map<std::string, Quality> qualities = quality_words();

MaybeError print(const std::string& text) {
    auto output = OutputFile::create("-");
    if (!output) return output.error();
    if (auto error = output.value().write(text)) return error;
    return output.value().commit();
}

int program_of(const std::string& name) {
    const auto all = numbered_presets();
    const auto found = std::find(all.begin(), all.end(), name);
    return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

MaybeError list_presets(bool json) {
    std::vector<ListedPreset> presets;
    for (const NamedPreset& named : named_presets()) {
        ListedPreset listed{named, "", "", 0, program_of(named.name)};
        const auto preset = load_preset(named.path.empty() ? named.name : named.path);
        if (preset) {
            listed.title = preset.value().instrument.name;
            listed.strings = preset.value().instrument.strings.size();
        } else {
            listed.problem = preset.error().message;
        }
        presets.push_back(listed);
    }
    return print(json ? list_json(presets) : list_text(presets));
}

struct InfoOptions {
    std::string preset;  ///< or a scene
    std::string schema;
    std::optional<Quality> quality;
    double rate_hz = 48000;
    bool json = false;
};

/// A file says itself what it is; names of built-in scenes have a slash, those of presets none.
bool is_scene(const std::string& argument) {
    if (argument == "-") return true;
    if (!path_exists(argument)) return find_builtin("scenes", argument) != nullptr;
    const auto text = read_file(argument, json::limits::file_bytes);
    return text && text.value().find("\"jawari.scene/") != std::string::npos;
}

MaybeError show_scene(const InfoOptions& options) {
    auto scene = load_scene(options.preset);
    if (!scene) return scene.error();
    const auto survey = survey_scene(std::move(scene.value()));
    if (!survey) return survey.error();
    return print(options.json ? survey_json(survey.value()) : survey_text(survey.value()));
}

MaybeError show_info(const InfoOptions& options) {
    if (!options.schema.empty()) return print(std::string(find_builtin("schemas", options.schema)->text));
    if (options.preset.empty())
        return usage_error("PRESET or SCENE", "missing", "a file, a name, or --schema");
    if (is_scene(options.preset)) return show_scene(options);
    InstrumentSettings settings;
    settings.output_rate_hz = options.rate_hz;
    settings.quality = options.quality.value_or(Quality::Live);
    const auto survey = survey_preset(options.preset, settings);
    if (!survey) return survey.error();
    return print(options.json ? survey_json(survey.value()) : survey_text(survey.value()));
}

std::string folders_text() {
    std::string text =
        "The program looks for a preset as a file, then in these folders as NAME.json, then among the "
        "built-in ones:\n";
    for (const PresetFolder& folder : preset_folders()) text += "  " + printable(folder.path) + "\n";
    return text + "\nThe number is the preset's program in bank 74/87 (docs/formats/midi.md).";
}

}  // namespace

void add_presets_command(CLI::App& app, Command& command) {
    CLI::App* presets_app = app.add_subcommand("presets", "Lists the instruments");
    const auto json = std::make_shared<bool>(false);
    presets_app->add_flag("--json", *json, "As JSON");
    presets_app->footer(folders_text());
    presets_app->callback([json, &command] { command = [json] { return list_presets(*json); }; });
}

void add_info_command(CLI::App& app, Command& command) {
    CLI::App* info_app = app.add_subcommand(
        "info",
        "Describes an instrument (strings, frets, modes, articulations, cost, parameters) or a scene");
    const auto options = std::make_shared<InfoOptions>();
    info_app
        ->add_option("preset", options->preset,
                     "Preset or scene: file or name; - for a scene on standard input")
        ->type_name("PRESET|SCENE");
    info_app
        ->add_option("--schema", options->schema, "Prints the JSON schema of a kind of file: scene, preset")
        ->type_name("KIND")
        ->check(CLI::Validator(
            [](const std::string& kind) {
                return find_builtin("schemas", kind) != nullptr ? std::string()
                                                                : refusal(kind, "scene, preset");
            },
            ""));
    info_app->add_flag("--json", options->json, "As JSON");
    add_choice(*info_app, "--quality", options->quality, qualities, "Quality, default live");
    info_app->add_option("--rate", options->rate_hz, "Output rate that it is compiled for, default 48000")
        ->type_name("HZ")
        ->check(number_between(lowest_render_rate_hz, highest_render_rate_hz));
    info_app->footer("Compiles the instrument and plays all its strings for a second to measure their cost.");
    info_app->callback([options, &command] { command = [options] { return show_info(*options); }; });
}

}  // namespace jawari::host
