#include "midi/read_midi_map.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/input_file.h"
#include "base/suggestion.h"
#include "base/text.h"
#include "formats/json/object_reader.h"
#include "formats/json/parse.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

constexpr std::string_view schema = "jawari.midi-map/1";
constexpr std::size_t longest_map_bytes = std::size_t{1} << 18U;
constexpr std::string_view no_parameter = "none";

bool is_controller(MidiSource source) {
    return source == MidiSource::Controller || source == MidiSource::Controller14;
}

bool same_control(const MidiBinding& a, const MidiBinding& b) {
    return (a.source == b.source || (is_controller(a.source) && is_controller(b.source))) &&
           a.number == b.number;
}

/// 7 or 14.
double read_bits(ObjectReader& reader) {
    const double bits = reader.number("bits", {7, 14});
    if (bits != 7 && bits != 14) reader.problems().add(reader.path_of("bits"), shortest(bits), "7 or 14");
    return bits;
}

/// `controller` (with `bits` 14: a pair), `nrpn` or `pressure`: exactly one.
void read_control(ObjectReader& reader, MidiBinding& binding) {
    const bool controller = reader.has("controller");
    const bool nrpn = reader.has("nrpn");
    const bool pressure = reader.has("pressure");
    const int given = static_cast<int>(controller) + static_cast<int>(nrpn) + static_cast<int>(pressure);
    if (given != 1) {
        reader.problems().add(json::whole(reader.path()), std::to_string(given) + " controls",
                              "one of controller, nrpn, pressure");
        return;
    }
    const bool pair = controller && reader.has("bits") && read_bits(reader) == 14;
    if (pressure) {
        binding.source = reader.choice<MidiSource>("pressure", {{"channel", MidiSource::ChannelPressure}});
    } else if (nrpn) {
        binding.source = MidiSource::Nrpn;
        binding.number = static_cast<int>(reader.whole_number("nrpn", 0, 16382));
    } else {
        binding.source = pair ? MidiSource::Controller14 : MidiSource::Controller;
        binding.number = static_cast<int>(reader.whole_number("controller", 0, pair ? 31 : 119));
        if (is_reserved_controller(binding.number))
            reader.problems().add(reader.path_of("controller"), std::to_string(binding.number),
                                  "0 to 119 without 0, 6, 32, 38, 64, 67, 74, 88, 96 to 101");
    }
}

/// Null, and a problem, unless the text is a parameter's key; null without a problem for "none".
const ParameterDeclaration* read_parameter(ObjectReader& reader) {
    const std::string key = reader.text("parameter");
    if (reader.problems().any() || key == no_parameter) return nullptr;
    std::vector<std::string> keys;
    for (const ParameterDeclaration& each : parameter_table()) {
        if (each.key == key) return &each;
        keys.emplace_back(each.key);
    }
    keys.emplace_back(no_parameter);
    reader.problems().add(reader.path_of("parameter"), in_quotes(key) + did_you_mean(key, keys), join(keys));
    return nullptr;
}

void read_range(ObjectReader& reader, const ParameterDeclaration& parameter, MidiBinding& binding) {
    const json::Range range{parameter.low, parameter.high};
    binding.parameter = parameter.id;
    binding.low = reader.number_or("from", parameter.low, range);
    binding.high = reader.number_or("to", parameter.high, range);
    binding.curve = reader.choice_or("curve", parameter.curve,
                                     {{"linear", Curve::Linear},
                                      {"exponential", Curve::Exponential},
                                      {"squared", Curve::Squared},
                                      {"stepped", Curve::Stepped}});
    if (binding.curve == Curve::Exponential && !(binding.low > 0 && binding.high > 0))
        reader.problems().add(reader.path_of("curve"), "\"exponential\"", "with from and to above 0");
}

struct ReadBinding {
    MidiBinding binding;
    bool assigns = false;  ///< false: the control moves nothing
};

ReadBinding read_binding(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(
        value, path,
        {"controller", "bits", "nrpn", "pressure", "channel", "parameter", "from", "to", "curve"}, problems);
    ReadBinding read;
    if (problems.any()) return read;
    read_control(reader, read.binding);
    if (reader.has("bits") && !reader.has("controller"))
        problems.add(reader.path_of("bits"), "given", "only with controller");
    if (reader.has("channel"))
        read.binding.channel = static_cast<int>(reader.whole_number("channel", 1, 16)) - 1;
    const ParameterDeclaration* parameter = problems.any() ? nullptr : read_parameter(reader);
    if (parameter == nullptr) return read;
    read_range(reader, *parameter, read.binding);
    read.assigns = true;
    return read;
}

/// Takes away what the default map does with the control.
void remove_control(MidiMap& map, const MidiBinding& control) {
    const auto end = map.bindings.begin() + static_cast<std::ptrdiff_t>(map.count);
    const auto kept = std::remove_if(map.bindings.begin(), end, [&](const MidiBinding& binding) {
        return same_control(binding, control);
    });
    map.count = static_cast<std::size_t>(kept - map.bindings.begin());
}

void add_bindings(MidiMap& map, const std::vector<ReadBinding>& bindings, const std::string& path,
                  Problems& problems) {
    for (const ReadBinding& each : bindings) remove_control(map, each.binding);
    for (std::size_t i = 0; i < bindings.size() && !problems.any(); ++i) {
        if (!bindings[i].assigns) continue;
        const MidiBinding& binding = bindings[i].binding;
        const auto end = map.bindings.begin() + static_cast<std::ptrdiff_t>(map.count);
        const auto same = std::count_if(map.bindings.begin(), end, [&](const MidiBinding& other) {
            return same_control(other, binding);
        });
        if (static_cast<std::size_t>(same) >= most_bindings_per_source) {
            problems.add(json::indexed(path, i), "one more binding of the same control",
                         "at most " + std::to_string(most_bindings_per_source));
        } else if (map.count == most_bindings) {
            problems.add(json::indexed(path, i), "one more binding",
                         "at most " + std::to_string(most_bindings) + " with those of the default map");
        } else {
            map.bindings[map.count++] = binding;
        }
    }
}

MidiMap read_document(const Value& document, Problems& problems) {
    ObjectReader reader(document, "", {"schema", "bindings"}, problems);
    MidiMap map = default_midi_map();
    const std::string expected = '"' + std::string(schema) + '"';
    const Value* named = reader.require("schema", expected);
    const auto* text = named == nullptr ? nullptr : std::get_if<std::string>(&named->content);
    if (named != nullptr && (text == nullptr || *text != schema))
        problems.add("schema", json::describe(*named), expected);
    const json::Array* array = reader.array("bindings", most_bindings);
    if (array == nullptr || problems.any()) return map;
    std::vector<ReadBinding> bindings;
    for (std::size_t i = 0; i < array->size() && !problems.any(); ++i)
        bindings.push_back(read_binding((*array)[i], json::indexed("bindings", i), problems));
    if (!problems.any()) add_bindings(map, bindings, "bindings", problems);
    return map;
}

}  // namespace

Outcome<MidiMap> read_midi_map(const std::string& text, const std::string& file) {
    const auto document = json::parse(text, file);
    if (!document) return document.error();
    Problems problems;
    const MidiMap map = read_document(document.value(), problems);
    if (problems.any()) return invalid_input(file, *problems.first());
    return map;
}

Outcome<MidiMap> load_midi_map(const std::string& path) {
    const auto text = read_file(path, longest_map_bytes);
    if (!text) return text.error();
    return read_midi_map(text.value(), path);
}

}  // namespace jawari::host
