#include "formats/preset/read_preset.h"

#include <utility>

#include "base/builtin.h"
#include "formats/json/parse.h"
#include "formats/preset/read_obstacles.h"
#include "formats/preset/read_output.h"
#include "formats/preset/read_players.h"
#include "formats/preset/read_section.h"
#include "formats/preset/read_strings.h"

namespace jawari::host {

namespace {

using json::Problems;
using json::Value;

constexpr std::string_view schema = "jawari.preset/3";
/// The one before: without bridges that move.
constexpr std::string_view earlier_schema = "jawari.preset/2";

/// First of all, so that a file of another kind is called that and not blamed for its keys.
void check_schema(const Value& document, Problems& problems) {
    const auto* object = std::get_if<json::Object>(&document.content);
    if (object == nullptr) return;
    const Value* value = json::find(*object, "schema");
    const std::string expected = '"' + std::string(schema) + "\" or \"" + std::string(earlier_schema) + '"';
    if (value == nullptr) {
        problems.add("schema", "missing", expected);
        return;
    }
    const auto* text = std::get_if<std::string>(&value->content);
    if (text == nullptr || (*text != schema && *text != earlier_schema))
        problems.add("schema", json::describe(*value), expected);
}

/// Whether the document is of the schema before.
bool is_earlier(const Value& document) {
    const auto* object = std::get_if<json::Object>(&document.content);
    const Value* value = object == nullptr ? nullptr : json::find(*object, "schema");
    const auto* text = value == nullptr ? nullptr : std::get_if<std::string>(&value->content);
    return text != nullptr && *text == earlier_schema;
}

QualityDescription read_quality(const Value& value, const std::string& path, Problems& problems) {
    preset::Section reader(value, path, {"contact_rate_min_hz", "mode_limit_hz"}, problems);
    return {reader.number("contact_rate_min_hz"), reader.number("mode_limit_hz")};
}

void read_general(preset::Section& reader, InstrumentDescription& instrument) {
    instrument.name = reader.text("name");
    instrument.gain = reader.number("gain");
    instrument.quality.contact_rate_min_hz = reader.number("contact_rate_min_hz");
    instrument.quality.mode_limit_hz = reader.number("mode_limit_hz");
    if (const Value* studio = reader.find("studio"))
        instrument.studio = read_quality(*studio, reader.path_of("studio"), reader.problems());
    instrument.law = reader.choice_or("law", instrument.law,
                                      {{"newton", ImpactLaw::Newton},
                                       {"passive", ImpactLaw::Passive},
                                       {"signorini", ImpactLaw::Signorini},
                                       {"paoli-schatzman", ImpactLaw::PaoliSchatzman}});
    instrument.play = reader.choice_or<PlayMode>(
        "play", instrument.play, {{"keyboard", PlayMode::Keyboard}, {"guitar", PlayMode::Guitar}});
    instrument.contacts = reader.flag_or("contacts", instrument.contacts);
}

InstrumentDescription read_document(const Value& document, Problems& problems) {
    check_schema(document, problems);
    preset::Section reader(document, "",
                           {"schema", "name", "gain", "contact_rate_min_hz", "mode_limit_hz", "studio", "law",
                            "play", "contacts", "frets", "obstacles", "soft_touches", "exciters", "hand",
                            "pickups", "body", "bridge", "strings"},
                           problems);
    InstrumentDescription instrument;
    read_general(reader, instrument);
    if (const Value* frets = reader.find("frets"))
        instrument.frets = preset::read_frets(*frets, reader.path_of("frets"), problems);
    instrument.obstacles =
        preset::read_list_or_empty(reader, "obstacles", limits::obstacles, preset::read_obstacle);
    instrument.soft_touches =
        preset::read_list_or_empty(reader, "soft_touches", limits::obstacles, preset::read_soft_touch);
    instrument.exciters = preset::read_list(reader, "exciters", limits::exciters, preset::read_exciter);
    if (const Value* hand = reader.find("hand"))
        instrument.hand = preset::read_hand(*hand, reader.path_of("hand"), problems);
    instrument.pickups = preset::read_list_or_empty(reader, "pickups", limits::pickups, preset::read_pickup);
    instrument.body = preset::read_list_or_empty(reader, "body", limits::body_modes, preset::read_body_mode);
    if (const Value* bridge = reader.find("bridge")) {
        if (is_earlier(document)) {
            problems.add("bridge", "in a preset of " + std::string(earlier_schema),
                         "in one of " + std::string(schema));
        }
        instrument.bridge = preset::read_bridge(*bridge, reader.path_of("bridge"), problems);
    }
    instrument.strings =
        preset::read_list(reader, "strings", limits::instrument_strings, preset::read_string);
    return instrument;
}

}  // namespace

Outcome<Preset> read_preset(const std::string& text, const std::string& file) {
    auto document = json::parse(text, file);
    if (!document) return document.error();
    Problems problems;
    Preset preset{file, read_document(document.value(), problems)};
    if (problems.any()) return invalid_input(file, *problems.first());
    return preset;
}

std::vector<std::string> builtin_preset_names() {
    std::vector<std::string> names;
    for (const BuiltinFile& file : builtin_files("instruments")) names.emplace_back(file.name);
    return names;
}

}  // namespace jawari::host
