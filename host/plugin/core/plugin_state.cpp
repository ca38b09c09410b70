#include "plugin/core/plugin_state.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/builtin.h"
#include "formats/json/object_reader.h"
#include "formats/json/parse.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

constexpr const char* what = "plugin state";
constexpr std::string_view schema = "jawari.plugin/1";

Quality read_quality(ObjectReader& reader, std::string_view key, Quality fallback) {
    return reader.choice_or<Quality>(key, fallback,
                                     {{name_of(Quality::Live), Quality::Live},
                                      {name_of(Quality::Studio), Quality::Studio},
                                      {name_of(Quality::Reference), Quality::Reference}});
}

void read_parameters(const Value& value, const std::string& path, PluginState& state, Problems& problems) {
    std::vector<std::string_view> keys;
    for (const ParameterDeclaration& parameter : parameter_table()) keys.push_back(parameter.key);
    ObjectReader reader(value, path, keys, problems);
    for (const ParameterDeclaration& parameter : parameter_table()) {
        double& kept = state.parameters[static_cast<std::size_t>(parameter.id)];
        kept = reader.number_or(parameter.key, kept, json::Range{parameter.low, parameter.high});
    }
}

void read_preset_part(const Value& value, const std::string& path, PluginState& state, Problems& problems) {
    ObjectReader reader(value, path, {"name", "text"}, problems);
    state.preset_name = reader.text_or("name", "");
    state.preset_text = reader.text("text");
}

void read_tuning(const Value& value, const std::string& path, PluginState& state, Problems& problems) {
    ObjectReader reader(value, path, {"scale", "tun", "keyboard_map", "move_frets"}, problems);
    state.scale_text = reader.text_or("scale", "");
    state.tun_text = reader.text_or("tun", "");
    state.keyboard_text = reader.text_or("keyboard_map", "");
    if (reader.has("move_frets")) state.move_frets = reader.flag("move_frets");
}

PluginState read_document(const Value& value, Problems& problems) {
    ObjectReader reader(value, "",
                        {"schema", "preset", "parameters", "tuning", "midi_map", "guitar_channel", "quality",
                         "offline_quality"},
                        problems);
    PluginState state;
    const std::string found = reader.text("schema");
    if (!problems.any() && found != schema)
        problems.add("schema", in_quotes(found), '"' + std::string(schema) + '"');
    if (const Value* preset = reader.require("preset", "an object"))
        read_preset_part(*preset, "preset", state, problems);
    if (const Value* parameters = reader.find("parameters"))
        read_parameters(*parameters, "parameters", state, problems);
    if (const Value* tuning = reader.find("tuning")) read_tuning(*tuning, "tuning", state, problems);
    state.midi_map_text = reader.text_or("midi_map", "");
    if (reader.has("guitar_channel"))
        state.guitar_channel = static_cast<int>(reader.whole_number("guitar_channel", 0, midi_channel_count));
    state.quality = read_quality(reader, "quality", state.quality);
    state.offline_quality = read_quality(reader, "offline_quality", state.offline_quality);
    return state;
}

}  // namespace

PluginState new_plugin_state() {
    PluginState state;
    state.preset_name = default_preset;
    state.preset_text = find_builtin("instruments", default_preset)->text;
    return state;
}

std::string write_plugin_state(const PluginState& state) {
    nlohmann::ordered_json parameters;
    for (const ParameterDeclaration& parameter : parameter_table())
        parameters[std::string(parameter.key)] = state.parameters[static_cast<std::size_t>(parameter.id)];
    const nlohmann::ordered_json document{
        {"schema", schema},
        {"quality", name_of(state.quality)},
        {"offline_quality", name_of(state.offline_quality)},
        {"guitar_channel", state.guitar_channel},
        {"parameters", parameters},
        {"tuning",
         {{"scale", state.scale_text},
          {"tun", state.tun_text},
          {"keyboard_map", state.keyboard_text},
          {"move_frets", state.move_frets}}},
        {"midi_map", state.midi_map_text},
        {"preset", {{"name", state.preset_name}, {"text", state.preset_text}}}};
    // Texts of files that are no UTF-8 have been made so before they got here.
    return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Outcome<PluginState> read_plugin_state(std::string_view text) {
    if (text.size() > longest_state_bytes)
        return invalid_input(what, {"size", std::to_string(text.size()) + " bytes",
                                    "at most " + std::to_string(longest_state_bytes)});
    auto document = json::parse(text, what);
    if (!document) return document.error();
    Problems problems;
    PluginState state = read_document(document.value(), problems);
    if (problems.any()) return invalid_input(what, *problems.first());
    return state;
}

}  // namespace jawari::host
