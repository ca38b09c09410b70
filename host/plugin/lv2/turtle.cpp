#include "plugin/lv2/turtle.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/builtin.h"
#include "base/text.h"
#include "jawari/version.h"
#include "plugin/core/parameter_text.h"
#include "plugin/core/plugin_state.h"
#include "plugin/core/preset_facts.h"
#include "plugin/lv2/ports.h"

namespace jawari::host::lv2 {

namespace {

constexpr std::string_view prefixes = R"(@prefix atom: <http://lv2plug.in/ns/ext/atom#> .
@prefix doap: <http://usefulinc.com/ns/doap#> .
@prefix lv2: <http://lv2plug.in/ns/lv2core#> .
@prefix log: <http://lv2plug.in/ns/ext/log#> .
@prefix midi: <http://lv2plug.in/ns/ext/midi#> .
@prefix opts: <http://lv2plug.in/ns/ext/options#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix pg: <http://lv2plug.in/ns/ext/port-groups#> .
@prefix pprops: <http://lv2plug.in/ns/ext/port-props#> .
@prefix pset: <http://lv2plug.in/ns/ext/presets#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix rsz: <http://lv2plug.in/ns/ext/resize-port#> .
@prefix state: <http://lv2plug.in/ns/ext/state#> .
@prefix ui: <http://lv2plug.in/ns/extensions/ui#> .
@prefix units: <http://lv2plug.in/ns/extensions/units#> .
@prefix urid: <http://lv2plug.in/ns/ext/urid#> .
@prefix work: <http://lv2plug.in/ns/ext/worker#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .

)";

/// Room for the events of a block [bytes].
constexpr int event_bytes = 65536;
/// Of what is told to the host.
constexpr int notice_bytes = 1024;

std::string literal(std::string_view text) {
    std::string written = "\"";
    for (const char letter : text) {
        switch (letter) {
            case '\n':
                written += "\\n";
                break;
            case '\r':
                written += "\\r";
                break;
            case '\t':
                written += "\\t";
                break;
            case '"':
            case '\\':
                written += '\\';
                written += letter;
                break;
            default:
                written += letter;
                break;
        }
    }
    return written + '"';
}

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t n = 0; n < 3; ++n)
            group = group << 8U | (i + n < bytes.size() ? static_cast<unsigned char>(bytes[i + n]) : 0U);
        for (std::size_t n = 0; n < 4; ++n)
            text += i + n <= bytes.size() ? digits[group >> (18 - 6 * n) & 0x3FU] : '=';
    }
    return text;
}

/// As a port holds it, so that the default is the neutral value and nothing beside it.
std::string decimal(double value) {
    std::string text = formatted("%.9g", static_cast<double>(static_cast<float>(value)));
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string resource(std::string_view fragment) {
    return "<" + std::string(plugin_uri) + "#" + std::string(fragment) + ">";
}

std::string preset_resource(const BuiltinFile& preset) {
    return resource("preset-" + std::string(preset.name));
}

std::string symbol_of(std::string_view words) {
    std::string symbol;
    for (const char letter : words)
        symbol += std::isalnum(static_cast<unsigned char>(letter)) != 0
                      ? static_cast<char>(std::tolower(static_cast<unsigned char>(letter)))
                      : '_';
    return symbol;
}

std::string group_resource(std::string_view group) {
    return resource("group-" + symbol_of(group));
}

/// A port is a node without a name; `lines` end each with ";".
std::string port(std::uint32_t index, std::string_view kinds, std::string_view symbol, std::string_view name,
                 const std::string& lines) {
    return "    [\n        a " + std::string(kinds) + " ;\n        lv2:index " + std::to_string(index) +
           " ;\n        lv2:symbol " + literal(symbol) + " ;\n        lv2:name " + literal(name) + " ;\n" +
           lines + "    ]";
}

std::string line(const std::string& text) {
    return "        " + text + " ;\n";
}

void add_audio_ports(std::vector<std::string>& ports) {
    constexpr std::string_view kinds = "lv2:OutputPort, lv2:AudioPort";
    const std::string main_group = line("pg:group " + resource("main"));
    ports.push_back(
        port(first_main_port, kinds, "left", "Left", main_group + line("lv2:designation pg:left")));
    ports.push_back(
        port(first_main_port + 1, kinds, "right", "Right", main_group + line("lv2:designation pg:right")));
    for (std::uint32_t s = 0; s < plugin_string_channels; ++s) {
        const std::string number = std::to_string(s + 1);
        ports.push_back(port(first_string_port + s, kinds, "string_" + number, "String " + number,
                             line("lv2:portProperty lv2:connectionOptional")));
    }
}

std::string range(double low, double high, double neutral) {
    return line("lv2:default " + decimal(neutral)) + line("lv2:minimum " + decimal(low)) +
           line("lv2:maximum " + decimal(high));
}

std::string unit_line(const ParameterDeclaration& parameter) {
    constexpr std::array<std::array<std::string_view, 2>, 4> units{
        {{"Hz", "hz"}, {"s", "s"}, {"m", "m"}, {"semitones", "semitone12TET"}}};
    for (const auto& [unit, name] : units)
        if (parameter.unit == unit) return line("units:unit units:" + std::string(name));
    return {};
}

std::string steps(const ParameterDeclaration& parameter) {
    const bool is_switch = parameter.low == 0 && parameter.high == 1;
    if (is_switch) return line("lv2:portProperty lv2:integer, lv2:toggled");
    std::string lines = line("lv2:portProperty lv2:integer, lv2:enumeration");
    for (double step = parameter.low; step <= parameter.high; ++step)
        lines += line("lv2:scalePoint [ rdfs:label " + literal(parameter_text(parameter.id, step)) +
                      " ; rdf:value " + decimal(step) + " ]");
    return lines;
}

std::string parameter_port(const ParameterDeclaration& parameter) {
    std::string lines = range(parameter.low, parameter.high, parameter.neutral) + unit_line(parameter);
    lines += line("lv2:shortName " + literal(parameter.short_name));
    lines += line("rdfs:comment " + literal(parameter.text));
    lines += line("pg:group " + group_resource(parameter.group));
    if (parameter.curve == Curve::Stepped) lines += steps(parameter);
    if (parameter.curve == Curve::Exponential) lines += line("lv2:portProperty pprops:logarithmic");
    return port(first_parameter_port + static_cast<std::uint32_t>(parameter.id),
                "lv2:InputPort, lv2:ControlPort", parameter.key, parameter.name, lines);
}

std::vector<std::string> all_ports() {
    std::vector<std::string> ports;
    add_audio_ports(ports);
    ports.push_back(port(events_port, "lv2:InputPort, atom:AtomPort", "events", "Events",
                         line("atom:bufferType atom:Sequence") + line("atom:supports midi:MidiEvent") +
                             line("lv2:designation lv2:control") +
                             line("rsz:minimumSize " + std::to_string(event_bytes))));
    ports.push_back(port(freewheel_port, "lv2:InputPort, lv2:ControlPort", "freewheel", "Freewheel",
                         range(0, 1, 0) + line("lv2:designation lv2:freeWheeling") +
                             line("lv2:portProperty lv2:toggled, pprops:notOnGUI")));
    for (const ParameterDeclaration& parameter : parameter_table())
        ports.push_back(parameter_port(parameter));
    ports.push_back(port(notify_port, "lv2:OutputPort, atom:AtomPort", "notify", "Notify",
                         line("atom:bufferType atom:Sequence") +
                             line("lv2:portProperty lv2:connectionOptional") +
                             line("rsz:minimumSize " + std::to_string(notice_bytes))));
    return ports;
}

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
    std::string all;
    for (const std::string& part : parts) all += (all.empty() ? std::string() : std::string(between)) + part;
    return all;
}

/// LV2 wants an even minor version for releases: major and minor as one number, doubled.
std::string version_lines() {
    return formatted("    lv2:minorVersion %d ;\n    lv2:microVersion %d ;\n",
                     2 * (100 * JAWARI_VERSION_MAJOR + JAWARI_VERSION_MINOR), 2 * JAWARI_VERSION_PATCH);
}

std::string group_descriptions() {
    std::string text = resource("main") +
                       "\n    a pg:StereoGroup, pg:OutputGroup ;\n    lv2:symbol \"main\" ;\n"
                       "    lv2:name \"Main\" .\n\n";
    for (const std::string_view group : parameter_groups())
        text += group_resource(group) + "\n    a pg:InputGroup ;\n    lv2:symbol " +
                literal(symbol_of(group)) + " ;\n    lv2:name " + literal(group) + " .\n\n";
    return text;
}

std::string preset_state(const BuiltinFile& preset) {
    PluginState state;
    state.preset_name = preset.name;
    state.preset_text = preset.text;
    return write_plugin_state(state);
}

std::string label_of(const BuiltinFile& preset) {
    const auto facts = preset_facts(preset.text, std::string(preset.name));
    return facts && !facts->name.empty() ? facts->name : std::string(preset.name);
}

}  // namespace

std::string manifest_turtle(bool with_window) {
    std::string text(prefixes);
    text += "<" + std::string(plugin_uri) + ">\n    a lv2:Plugin ;\n    lv2:binary <jawari.so> ;\n" +
            (with_window ? "    ui:ui <" + std::string(window_uri) + "> ;\n" : "") +
            "    rdfs:seeAlso <jawari.ttl> .\n\n";
    if (with_window)
        text += "<" + std::string(window_uri) +
                ">\n    a ui:X11UI ;\n    lv2:binary <jawari.so> ;\n    rdfs:seeAlso <window.ttl> .\n\n";
    for (const BuiltinFile& preset : builtin_files("instruments"))
        text += preset_resource(preset) + "\n    a pset:Preset ;\n    lv2:appliesTo <" + plugin_uri +
                "> ;\n    rdfs:label " + literal(label_of(preset)) +
                " ;\n    rdfs:seeAlso <presets.ttl> .\n\n";
    return text;
}

std::string plugin_turtle() {
    std::string text(prefixes);
    text += group_descriptions();
    text += "<" + std::string(state_uri) +
            ">\n    a rdf:Property, owl:DatatypeProperty ;\n    rdfs:label \"state\" ;\n"
            "    rdfs:comment \"All that an instance keeps between sessions: a text in UTF-8.\" ;\n"
            "    rdfs:range xsd:base64Binary .\n\n";
    text +=
        "<" + std::string(plugin_uri) + ">\n    a lv2:Plugin, lv2:InstrumentPlugin ;\n" +
        "    doap:name \"Jawari\" ;\n    doap:license <https://spdx.org/licenses/MIT> ;\n" +
        "    rdfs:comment \"Strings that strike frets, necks, bridges and threads\" ;\n" + version_lines() +
        "    lv2:requiredFeature urid:map ;\n"
        "    lv2:optionalFeature lv2:hardRTCapable, state:threadSafeRestore, work:schedule, log:log ;\n"
        "    lv2:extensionData state:interface, work:interface ;\n" +
        "    pg:mainOutput " + resource("main") + " ;\n    lv2:port\n" + joined(all_ports(), ",\n") + " .\n";
    return text;
}

std::string window_turtle() {
    std::string text(prefixes);
    text += "<" + std::string(window_uri) + ">\n    a ui:X11UI ;\n    lv2:binary <jawari.so> ;\n";
    text +=
        "    lv2:requiredFeature <http://lv2plug.in/ns/ext/instance-access> ;\n"
        "    lv2:optionalFeature ui:idleInterface, ui:parent, ui:resize, ui:touch, opts:options, urid:map,\n"
        "        log:log ;\n"
        "    lv2:extensionData ui:idleInterface, ui:resize, ui:showInterface .\n";
    return text;
}

std::string presets_turtle() {
    std::string text(prefixes);
    std::vector<std::string> values;
    for (const ParameterDeclaration& parameter : parameter_table())
        values.push_back("[ lv2:symbol " + literal(parameter.key) + " ; pset:value " +
                         decimal(parameter.neutral) + " ]");
    for (const BuiltinFile& preset : builtin_files("instruments")) {
        text += preset_resource(preset) + "\n    a pset:Preset ;\n    lv2:appliesTo <" + plugin_uri +
                "> ;\n    rdfs:label " + literal(label_of(preset)) + " ;\n";
        const auto facts = preset_facts(preset.text, std::string(preset.name));
        if (facts && !facts->comment.empty()) text += "    rdfs:comment " + literal(facts->comment) + " ;\n";
        text += "    state:state [ <" + std::string(state_uri) + "> \"" + base64(preset_state(preset)) +
                "\"^^xsd:base64Binary ] ;\n    lv2:port\n        " + joined(values, ",\n        ") + " .\n\n";
    }
    return text;
}

}  // namespace jawari::host::lv2
