#include "commands/info/scene_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/cpu_clock.h"
#include "base/text.h"
#include "formats/scene/probe_names.h"
#include "formats/scene/words.h"
#include "formats/scene_sound/load_sounds.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/modes.h"

namespace jawari::host {

namespace {

double t60_of(double sigma) {
    return sigma > 0 ? std::log(1000.0) / sigma : std::numeric_limits<double>::infinity();
}

VibratingSurvey survey_of(const StringDescription& string, const StringModel& model) {
    VibratingSurvey survey;
    survey.name = string.name;
    survey.system = string.shapes ? "no string: modes by tables" : "string";
    const Modes modes = modes_of(string);
    survey.modes = modes.omega.size();
    const auto [low, high] = std::minmax_element(modes.omega.begin(), modes.omega.end());
    survey.lowest_hz = *low / (2 * std::numbers::pi);
    survey.highest_hz = *high / (2 * std::numbers::pi);
    const auto [least, most] = std::minmax_element(modes.sigma.begin(), modes.sigma.end());
    survey.longest_t60_s = t60_of(*least);
    survey.shortest_t60_s = t60_of(*most);
    for (const ContactDescription& contact : string.contacts)
        (contact.compliance ? survey.compliant_contacts : survey.rigid_contacts) += 1;
    survey.hammers = string.hammers.size();
    survey.springs = string.springs.size();
    survey.forces = string.forces.size();
    survey.motions = string.motions.size();
    survey.cost = frame_cost(model);
    return survey;
}

std::string counted(std::size_t count, const std::string& what) {
    return count == 0 ? "" : ", " + std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string seconds(double value) {
    return std::isinf(value) ? "endless" : formatted("%.3g s", value);
}

nlohmann::ordered_json finite(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

Outcome<SceneSurvey> survey_scene(Scene scene) {
    if (auto error = load_sounds(scene)) return *error;
    const double started = thread_cpu_s();
    const auto model = compile(scene.description);
    if (!model) return invalid_input(scene.file, in_file_terms(scene, model.failure()));
    SceneSurvey survey;
    survey.cpu_compile_s = thread_cpu_s() - started;
    survey.steps_per_row = model.value().steps_per_frame;
    for (std::size_t s = 0; s < model.value().strings.size(); ++s)
        survey.strings.push_back(survey_of(scene.description.strings[s], model.value().strings[s]));
    for (const ProbeLabel& probe : probe_labels(scene.description))
        survey.strings[probe.string].probes.push_back(probe.name);
    survey.scene = std::move(scene);
    return survey;
}

std::string survey_text(const SceneSurvey& survey) {
    const SceneDescription& scene = survey.scene.description;
    std::string text =
        "scene     " + printable(survey.scene.file) + "\n" + "settings  " + word(scene.scheme) +
        " scheme, law " + word(scene.law) + ", " + shortest(survey.scene.duration_s) + " s, output rate " +
        shortest(scene.output_rate_hz) + " Hz, contact rate " + shortest(scene.contact_rate_hz) + " Hz, " +
        std::to_string(survey.steps_per_row) + (survey.steps_per_row == 1 ? " step" : " steps") + " a row\n";
    for (const VibratingSurvey& string : survey.strings) {
        text += "\n" + printable(string.name) + "  (" + string.system + ")\n";
        text += "  modes     " + std::to_string(string.modes) + ", " +
                formatted("%.6g to %.6g Hz", string.lowest_hz, string.highest_hz) + ", T60 " +
                seconds(string.shortest_t60_s) + " to " + seconds(string.longest_t60_s) + "\n";
        const std::string parts = counted(string.rigid_contacts, "rigid contact") +
                                  counted(string.compliant_contacts, "compliant contact") +
                                  counted(string.hammers, "hammer") + counted(string.springs, "spring") +
                                  counted(string.forces, "driven force") +
                                  counted(string.motions, "moving obstacle");
        text += "  touched   " + (parts.empty() ? "by nothing" : "by " + parts.substr(2)) + "\n";
        text += "  probes    " + (string.probes.empty() ? "none" : printable(join(string.probes))) + "\n";
        text += formatted(
            "  cost      %.3g multiply-adds a row in free flight, %.3g if everything presses, %.3g at most\n",
            string.cost.flight, string.cost.permanent_contact, string.cost.bound);
    }
    return text + formatted("\ncompiled in %.3g s of processor time\n", survey.cpu_compile_s);
}

std::string survey_json(const SceneSurvey& survey) {
    const SceneDescription& scene = survey.scene.description;
    nlohmann::ordered_json json{{"schema", "jawari.scene-info/1"},
                                {"scene", survey.scene.file},
                                {"scheme", word(scene.scheme)},
                                {"law", word(scene.law)},
                                {"duration_s", survey.scene.duration_s},
                                {"output_rate_hz", scene.output_rate_hz},
                                {"contact_rate_hz", scene.contact_rate_hz},
                                {"steps_per_row", survey.steps_per_row},
                                {"cpu_compile_s", survey.cpu_compile_s},
                                {"strings", nlohmann::ordered_json::array()}};
    for (const VibratingSurvey& string : survey.strings) {
        json["strings"].push_back({{"name", string.name},
                                   {"system", string.system},
                                   {"modes", string.modes},
                                   {"lowest_hz", string.lowest_hz},
                                   {"highest_hz", string.highest_hz},
                                   {"longest_t60_s", finite(string.longest_t60_s)},
                                   {"shortest_t60_s", finite(string.shortest_t60_s)},
                                   {"rigid_contacts", string.rigid_contacts},
                                   {"compliant_contacts", string.compliant_contacts},
                                   {"hammers", string.hammers},
                                   {"springs", string.springs},
                                   {"forces", string.forces},
                                   {"motions", string.motions},
                                   {"probes", string.probes},
                                   {"multiply_adds_in_flight", string.cost.flight},
                                   {"multiply_adds_pressed", string.cost.permanent_contact},
                                   {"multiply_adds_at_most", string.cost.bound}});
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace jawari::host
