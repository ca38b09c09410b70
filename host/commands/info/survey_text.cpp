#include "commands/info/survey_text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "jawari/parameters.h"
#include "jawari/version.h"

namespace jawari::host {

namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
    // Names may hold any bytes; those that are no UTF-8 become replacement characters.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

const char* curve_text(Curve curve) {
    switch (curve) {
        case Curve::Linear:
            return "linear";
        case Curve::Exponential:
            return "exponential";
        case Curve::Squared:
            return "squared";
        case Curve::Stepped:
            break;
    }
    return "stepped";
}

const char* reach_text(Reach reach) {
    switch (reach) {
        case Reach::Sounding:
            return "sounding";
        case Reach::NextNote:
            return "next note";
        case Reach::Host:
            break;
    }
    return "host";
}

const char* kind_text(const ExciterDescription& exciter) {
    if (std::holds_alternative<FingerDescription>(exciter.body)) return "finger";
    return std::holds_alternative<HammerDescription>(exciter.body) ? "hammer" : "tangent";
}

const char* quantity_text(PickupQuantity quantity) {
    switch (quantity) {
        case PickupQuantity::Velocity:
            return "velocity";
        case PickupQuantity::Displacement:
            return "displacement";
        case PickupQuantity::BridgeForce:
            break;
    }
    return "bridge_force";
}

std::string place_text(const StringPlace& place) {
    if (place.share > 0) return formatted("share %g", place.share);
    return formatted("%g m", place.from_bridge_m);
}

Json place_json(const StringPlace& place) {
    if (place.share > 0) return {{"position_share", place.share}};
    return {{"position_from_bridge_m", place.from_bridge_m}};
}

Json strings_json(const PresetSurvey& survey) {
    Json strings = Json::array();
    for (const StringSurvey& string : survey.strings) {
        strings.push_back({{"name", string.name},
                           {"course", string.course ? Json(*string.course) : Json(nullptr)},
                           {"open_note", string.open_note},
                           {"open_note_name", note_name(string.open_note)},
                           {"highest_note", string.highest_note},
                           {"open_frequency_hz", string.open_frequency_hz},
                           {"length_m", string.length_m},
                           {"linear_density_kg_per_m", string.linear_density_kg_per_m},
                           {"tension_N", string.tension_N},
                           {"inharmonicity", string.inharmonicity},
                           {"frets", string.frets},
                           {"modes", string.modes},
                           {"contacts", string.contacts}});
    }
    return strings;
}

Json exciters_json(const InstrumentDescription& instrument) {
    Json exciters = Json::array();
    for (const ExciterDescription& exciter : instrument.exciters) {
        Json json{{"name", exciter.name}, {"kind", kind_text(exciter)}};
        if (!std::holds_alternative<TangentDescription>(exciter.body)) json.update(place_json(exciter.place));
        exciters.push_back(json);
    }
    return exciters;
}

Json pickups_json(const InstrumentDescription& instrument) {
    Json pickups = Json::array();
    for (const PickupDescription& pickup : instrument.pickups) {
        Json json{{"quantity", quantity_text(pickup.quantity)}, {"level", pickup.level}};
        if (pickup.quantity != PickupQuantity::BridgeForce) json.update(place_json(pickup.place));
        pickups.push_back(json);
    }
    return pickups;
}

Json parameters_json() {
    Json parameters = Json::array();
    for (const ParameterDeclaration& parameter : parameter_table()) {
        parameters.push_back({{"parameter", parameter.key},
                              {"unit", parameter.unit},
                              {"low", parameter.low},
                              {"high", parameter.high},
                              {"neutral", parameter.neutral},
                              {"curve", curve_text(parameter.curve)},
                              {"reach", reach_text(parameter.reach)},
                              {"text", parameter.text}});
    }
    return parameters;
}

std::string strings_table(const PresetSurvey& survey) {
    std::string text =
        "string        note     open Hz  length m  tension N      B       frets  to    modes  contacts\n";
    for (const StringSurvey& string : survey.strings) {
        const std::string course = string.course ? " (" + std::to_string(*string.course) + ")" : "";
        text +=
            formatted("  %-10s  %-4s %11.3f %9.4g %10.4g %9.3g %7zu  %-4s %6zu %9zu\n",
                      (printable(string.name) + course).c_str(), note_name(string.open_note).c_str(),
                      string.open_frequency_hz, string.length_m, string.tension_N, string.inharmonicity,
                      string.frets, note_name(string.highest_note).c_str(), string.modes, string.contacts);
    }
    return text;
}

std::size_t moving_modes(const InstrumentDescription& instrument) {
    if (!instrument.bridge) return 0;
    return static_cast<std::size_t>(std::count_if(instrument.body.begin(), instrument.body.end(),
                                                  [](const auto& mode) { return mode.mass_kg > 0; }));
}

/// What a moving bridge couples.
std::string bridge_text(const InstrumentDescription& instrument) {
    std::string text = formatted(", %zu of them move the bridge under all strings", moving_modes(instrument));
    if (instrument.bridge->open_strings > 0) text += "; open strings ring along";
    const auto sympathetic = std::count_if(instrument.strings.begin(), instrument.strings.end(),
                                           [](const auto& string) { return string.sympathetic; });
    if (sympathetic > 0) text += formatted("; %td sympathetic strings", sympathetic);
    return text;
}

std::string players_text(const InstrumentDescription& instrument) {
    std::string text = "articulations";
    for (std::size_t i = 0; i < instrument.exciters.size(); ++i) {
        const ExciterDescription& exciter = instrument.exciters[i];
        text += formatted("\n  %zu  ", i + 1) + printable(exciter.name) + ", " + kind_text(exciter);
        if (!std::holds_alternative<TangentDescription>(exciter.body))
            text += ", " + place_text(exciter.place);
    }
    text += "\npickups";
    for (const PickupDescription& pickup : instrument.pickups) {
        text += "\n  " + std::string(quantity_text(pickup.quantity));
        if (pickup.quantity != PickupQuantity::BridgeForce) text += ", " + place_text(pickup.place);
    }
    if (!instrument.body.empty()) text += formatted("\nbody\n  %zu resonances", instrument.body.size());
    if (instrument.bridge) text += bridge_text(instrument);
    return text + "\n";
}

std::string parameters_table() {
    std::string text = "parameters (--set, MIDI map)\n";
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const std::string unit = parameter.unit == "1" ? "" : " " + std::string(parameter.unit);
        text += formatted("  %-16s %-24s ", std::string(parameter.key).c_str(),
                          (shortest(parameter.low) + " to " + shortest(parameter.high) + unit).c_str()) +
                std::string(parameter.text) + "\n";
    }
    return text;
}

}  // namespace

std::string survey_text(const PresetSurvey& survey) {
    const InstrumentDescription& instrument = survey.preset.instrument;
    std::string text = printable(instrument.name) + " (" + printable(survey.preset.file) + "), played as a " +
                       (instrument.play == PlayMode::Guitar ? "guitar: one course a channel" : "keyboard") +
                       "\n" + strings_table(survey) + players_text(instrument);
    text += formatted("quality %s\n  modes up to %g Hz, %g contact steps a second\n", survey.quality.c_str(),
                      instrument.quality.mode_limit_hz, survey.contact_rate_hz);
    text += formatted("cost\n  %zu stopped strings, compiled in %.3g CPU s\n", survey.stopped_strings,
                      survey.cpu_compile_s);
    text += formatted("  all strings at full velocity: %.3g CPU s for their first second\n",
                      survey.cpu_all_strings);
    return text + parameters_table();
}

std::string survey_json(const PresetSurvey& survey) {
    const InstrumentDescription& instrument = survey.preset.instrument;
    return dump({{"schema", "jawari.preset-info/1"},
                 {"jawari_version", JAWARI_VERSION},
                 {"preset", survey.preset.file},
                 {"name", instrument.name},
                 {"play", instrument.play == PlayMode::Guitar ? "guitar" : "keyboard"},
                 {"strings", strings_json(survey)},
                 {"exciters", exciters_json(instrument)},
                 {"pickups", pickups_json(instrument)},
                 {"body_modes", instrument.body.size()},
                 {"modes_that_move_the_bridge", moving_modes(instrument)},
                 {"quality",
                  {{"quality", survey.quality},
                   {"mode_limit_hz", instrument.quality.mode_limit_hz},
                   {"contact_rate_hz", survey.contact_rate_hz}}},
                 {"cost",
                  {{"stopped_strings", survey.stopped_strings},
                   {"cpu_compile_s", survey.cpu_compile_s},
                   {"cpu_all_strings", survey.cpu_all_strings}}},
                 {"parameters", parameters_json()}});
}

std::string list_text(const std::vector<ListedPreset>& presets) {
    std::string text;
    for (const ListedPreset& preset : presets) {
        const std::string number = preset.program >= 0 ? std::to_string(preset.program) : "";
        text += formatted("%-16s %3s  ", printable(preset.named.name).c_str(), number.c_str());
        text += preset.problem.empty() ? printable(preset.title) + formatted(", %zu strings", preset.strings)
                                       : "cannot be read: " + printable(preset.problem);
        text += ", " + origin_text(preset.named.origin) +
                (preset.named.path.empty() ? "" : " " + printable(preset.named.path)) + "\n";
    }
    return text;
}

std::string list_json(const std::vector<ListedPreset>& presets) {
    Json list = Json::array();
    for (const ListedPreset& preset : presets) {
        list.push_back({{"preset", preset.named.name},
                        {"name", preset.title},
                        {"strings", preset.strings},
                        {"program", preset.program >= 0 ? Json(preset.program) : Json(nullptr)},
                        {"origin", origin_text(preset.named.origin)},
                        {"path", preset.named.path.empty() ? Json(nullptr) : Json(preset.named.path)},
                        {"problem", preset.problem.empty() ? Json(nullptr) : Json(preset.problem)}});
    }
    return dump({{"schema", "jawari.presets/1"}, {"jawari_version", JAWARI_VERSION}, {"presets", list}});
}

}  // namespace jawari::host
