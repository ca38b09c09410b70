#include "preset/read_preset.h"

#include <utility>

#include "common/builtin.h"
#include "common/input_file.h"
#include "common/text.h"
#include "json/object_reader.h"
#include "json/parse.h"
#include "scene/read_modes.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

constexpr std::string_view schema = "jawari.preset/1";
constexpr std::size_t longest_preset_bytes = std::size_t{4} << 20U;

/// First of all, so that a file of another kind is called that and not blamed for its keys.
void check_schema(const Value& document, Problems& problems) {
    const auto* object = std::get_if<json::Object>(&document.content);
    if (object == nullptr) return;
    const Value* value = json::find(*object, "schema");
    const std::string expected = '"' + std::string(schema) + '"';
    if (value == nullptr) {
        problems.add("schema", "missing", expected);
        return;
    }
    const auto* text = std::get_if<std::string>(&value->content);
    if (text == nullptr || *text != schema) problems.add("schema", json::describe(*value), expected);
}

PluckDescription read_pluck(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path,
                        {"position_from_bridge_m", "rise_s", "release_s", "full_height_m", "height_exponent"},
                        problems);
    PluckDescription pluck;
    pluck.position_from_bridge_m = reader.number("position_from_bridge_m");
    pluck.rise_s = reader.number_or("rise_s", pluck.rise_s);
    pluck.release_s = reader.number_or("release_s", pluck.release_s);
    pluck.full_height_m = reader.number("full_height_m");
    pluck.height_exponent = reader.number_or("height_exponent", pluck.height_exponent);
    return pluck;
}

FretsDescription read_frets(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"height_m", "restitution"}, problems);
    FretsDescription frets;
    frets.height_m = reader.numbers("height_m", limits::frets);
    frets.restitution = reader.number_or("restitution", frets.restitution);
    return frets;
}

PickupDescription read_pickup(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"position_from_bridge_m", "width_m", "level"}, problems);
    PickupDescription pickup;
    pickup.position_from_bridge_m = reader.number("position_from_bridge_m");
    pickup.width_m = reader.number_or("width_m", pickup.width_m);
    pickup.level = reader.number_or("level", pickup.level);
    return pickup;
}

InstrumentStringDescription read_string(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path,
                        {"name", "open_note", "open_frequency_hz", "length_m", "linear_density_kg_per_m",
                         "inharmonicity", "damping", "level"},
                        problems);
    InstrumentStringDescription string;
    string.name = reader.text("name");
    string.open_note = static_cast<int>(reader.whole_number("open_note", 0, 127));
    string.open_frequency_hz = reader.number("open_frequency_hz");
    string.length_m = reader.number("length_m");
    string.linear_density_kg_per_m = reader.number("linear_density_kg_per_m");
    string.inharmonicity = reader.number_or("inharmonicity", string.inharmonicity);
    if (const Value* damping = reader.require("damping", "an object")) {
        string.damping = read_damping(*damping, reader.path_of("damping"), problems);
    }
    string.level = reader.number_or("level", string.level);
    return string;
}

/// An array of objects, each read by `read`.
template <class T>
std::vector<T> read_list(ObjectReader& reader, std::string_view key, std::size_t longest,
                         T (*read)(const Value&, const std::string&, Problems&)) {
    std::vector<T> list;
    const json::Array* array = reader.array(key, longest);
    if (array == nullptr) return list;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i) {
        list.push_back(read((*array)[i], json::indexed(reader.path_of(key), i), reader.problems()));
    }
    return list;
}

InstrumentDescription read_document(const Value& document, Problems& problems) {
    check_schema(document, problems);
    ObjectReader reader(document, "",
                        {"schema", "name", "gain", "contact_rate_min_hz", "mode_limit_hz", "law",
                         "release_t60_s", "pluck", "frets", "pickups", "strings"},
                        problems);
    InstrumentDescription instrument;
    instrument.name = reader.text("name");
    instrument.gain = reader.number("gain");
    instrument.contact_rate_min_hz = reader.number("contact_rate_min_hz");
    instrument.mode_limit_hz = reader.number("mode_limit_hz");
    instrument.law = reader.choice_or("law", instrument.law,
                                      {{"newton", ImpactLaw::Newton},
                                       {"passive", ImpactLaw::Passive},
                                       {"signorini", ImpactLaw::Signorini},
                                       {"paoli-schatzman", ImpactLaw::PaoliSchatzman}});
    instrument.release_t60_s = reader.number("release_t60_s");
    if (const Value* pluck = reader.require("pluck", "an object")) {
        instrument.pluck = read_pluck(*pluck, reader.path_of("pluck"), problems);
    }
    if (const Value* frets = reader.find("frets")) {
        instrument.frets = read_frets(*frets, reader.path_of("frets"), problems);
    }
    instrument.pickups = read_list(reader, "pickups", limits::pickups, read_pickup);
    instrument.strings = read_list(reader, "strings", limits::instrument_strings, read_string);
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

Outcome<Preset> load_preset(const std::string& argument) {
    if (!path_exists(argument)) {
        const BuiltinFile* builtin = find_builtin("instruments", argument);
        if (builtin != nullptr) return read_preset(std::string(builtin->text), argument);
        return Error{ExitCode::File, printable(argument) +
                                         ": no such file, and no built-in preset of that name (built-in: " +
                                         join(builtin_preset_names()) + ")"};
    }
    auto text = read_file(argument, longest_preset_bytes);
    if (!text) return text.error();
    return read_preset(text.value(), argument);
}

std::vector<std::string> builtin_preset_names() {
    std::vector<std::string> names;
    for (const BuiltinFile& file : builtin_files("instruments")) names.emplace_back(file.name);
    return names;
}

}  // namespace jawari::host
