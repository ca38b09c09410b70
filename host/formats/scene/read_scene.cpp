#include "formats/scene/read_scene.h"

#include <filesystem>
#include <utility>

#include "base/builtin.h"
#include "base/input_file.h"
#include "base/suggestion.h"
#include "base/text.h"
#include "formats/json/object_reader.h"
#include "formats/json/parse.h"
#include "formats/scene/read_string.h"
#include "formats/scene/words.h"

namespace jawari::host {

namespace {

constexpr std::string_view schema = "jawari.scene/1";
constexpr json::Range rates{limits::min_rate_hz, limits::max_rate_hz};

/// First of all, so that a file of another kind is called that and not blamed for its keys.
void check_schema(const json::Value& document, json::Problems& problems) {
    const auto* object = std::get_if<json::Object>(&document.content);
    if (object == nullptr) return;
    const json::Value* value = json::find(*object, "schema");
    const std::string expected = '"' + std::string(schema) + '"';
    if (value == nullptr) {
        problems.add("schema", "missing", expected);
        return;
    }
    const auto* text = std::get_if<std::string>(&value->content);
    if (text == nullptr || *text != schema) problems.add("schema", json::describe(*value), expected);
}

void read_strings(json::ObjectReader& reader, Scene& scene) {
    const json::Array* strings = reader.array("strings", limits::strings);
    if (strings == nullptr) return;
    for (std::size_t i = 0; i < strings->size() && !reader.problems().any(); ++i) {
        ContactSources sources;
        DrivenTables tables;
        const std::string path = json::indexed(reader.path_of("strings"), i);
        scene.description.strings.push_back(
            read_string((*strings)[i], path, sources, tables, reader.problems()));
        if (scene.description.strings.back().name.empty())
            scene.description.strings.back().name = "string" + std::to_string(i);
        scene.contact_sources.push_back(sources);
        scene.tables.push_back(std::move(tables));
    }
}

void read_document(const json::Value& document, Scene& scene, json::Problems& problems) {
    check_schema(document, problems);
    json::ObjectReader reader(
        document, "",
        {"schema", "duration_s", "output_rate_hz", "contact_rate_hz", "scheme", "theta", "law", "strings"},
        problems);
    SceneDescription& description = scene.description;
    scene.duration_s = reader.number("duration_s", {0, longest_duration_s});
    description.output_rate_hz = reader.number_or("output_rate_hz", description.output_rate_hz, rates);
    if (reader.has("contact_rate_hz")) scene.contact_rate_hz = reader.number("contact_rate_hz", rates);
    description.scheme =
        reader.choice_or("scheme", Scheme::Exact, {{"exact", Scheme::Exact}, {"theta", Scheme::Theta}});
    description.theta = reader.number_or("theta", description.theta, {0.5, 1});
    if (reader.has("law"))
        scene.law = reader.choice<ImpactLaw>("law", {{"newton", ImpactLaw::Newton},
                                                     {"passive", ImpactLaw::Passive},
                                                     {"signorini", ImpactLaw::Signorini},
                                                     {"paoli-schatzman", ImpactLaw::PaoliSchatzman}});
    read_strings(reader, scene);
}

Error unknown_scene(const std::string& argument) {
    const std::vector<std::string> names = builtin_scene_names();
    return {ErrorKind::File, argument + ": no such file, and no built-in scene of that name" +
                                 did_you_mean(argument, names) + " (built-in: " + join(names) + ")"};
}

}  // namespace

Outcome<Scene> read_scene(const std::string& text, const std::string& file) {
    auto document = json::parse(text, file);
    if (!document) return document.error();
    Scene scene;
    scene.file = file;
    scene.name = std::filesystem::path(file).stem().string();
    scene.text = text;
    json::Problems problems;
    read_document(document.value(), scene, problems);
    if (problems.any()) return invalid_input(file, *problems.first());
    resolve_defaults(scene);
    return scene;
}

Outcome<Scene> load_scene(const std::string& argument) {
    const bool from_input = argument == "-";
    if (!from_input && !path_exists(argument)) {
        const BuiltinFile* builtin = find_builtin("scenes", argument);
        if (builtin == nullptr) return unknown_scene(argument);
        auto scene = read_scene(std::string(builtin->text), argument);
        if (scene) scene.value().name = argument;
        return scene;
    }
    auto text = read_file(argument, json::limits::file_bytes);
    if (!text) return text.error();
    return read_scene(text.value(), from_input ? "standard input" : argument);
}

std::vector<std::string> builtin_scene_names() {
    std::vector<std::string> names;
    for (const BuiltinFile& file : builtin_files("scenes")) names.emplace_back(file.name);
    return names;
}

}  // namespace jawari::host
