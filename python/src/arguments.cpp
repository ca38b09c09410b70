#include "arguments.h"

#include <map>
#include <optional>
#include <vector>

#include "base/suggestion.h"
#include "base/text.h"
#include "errors.h"
#include "formats/scene/read_scene.h"
#include "formats/words/quality_words.h"

namespace jawari::python {

namespace py = pybind11;

namespace {

const std::map<std::string, Scheme> schemes{{"exact", Scheme::Exact}, {"theta", Scheme::Theta}};
const std::map<std::string, Start> starts{{"exact", Start::Exact}, {"backward", Start::Backward}};
const std::map<std::string, ImpactLaw> laws{{"newton", ImpactLaw::Newton},
                                            {"passive", ImpactLaw::Passive},
                                            {"signorini", ImpactLaw::Signorini},
                                            {"paoli-schatzman", ImpactLaw::PaoliSchatzman}};

template <class T>
std::optional<T> given(const py::dict& settings, const char* key) {
    if (!settings.contains(key) || settings[key].is_none()) return std::nullopt;
    return settings[key].cast<T>();
}

template <class T>
std::optional<T> choice(const py::dict& settings, const char* key, const std::map<std::string, T>& words) {
    const auto text = given<std::string>(settings, key);
    if (!text) return std::nullopt;
    const auto found = words.find(*text);
    if (found != words.end()) return found->second;
    std::vector<std::string> allowed;
    for (const auto& [word, value] : words) allowed.push_back(word);
    raise(host::usage_error(key, host::in_quotes(*text) + host::did_you_mean(*text, allowed),
                            host::join(allowed)));
}

}  // namespace

host::Scene scene_from(const py::object& text, const std::string& name) {
    const std::optional<std::string> json =
        text.is_none() ? std::nullopt : std::optional(text.cast<std::string>());
    auto scene = [&] {
        const py::gil_scoped_release released;
        return json ? host::read_scene(*json, name) : host::load_scene(name);
    }();
    return value_or_raise(std::move(scene));
}

RecordOptions record_options(const py::dict& settings) {
    RecordOptions options;
    host::Overrides& overrides = options.overrides;
    overrides.output_rate_hz = given<double>(settings, "output_rate_hz");
    overrides.contact_rate_hz = given<double>(settings, "contact_rate_hz");
    overrides.duration_s = given<double>(settings, "duration_s");
    overrides.theta = given<double>(settings, "theta");
    overrides.restitution = given<double>(settings, "restitution");
    overrides.scheme = choice(settings, "scheme", schemes);
    overrides.law = choice(settings, "law", laws);
    overrides.start = choice(settings, "start", starts);
    overrides.quality = choice(settings, "quality", host::quality_words());
    options.meter_steps = given<bool>(settings, "meter_steps").value_or(false);
    options.with_contacts = given<bool>(settings, "contacts").value_or(true);
    if (!given<bool>(settings, "skipping").value_or(true)) options.skipping = skip_nothing;
    return options;
}

}  // namespace jawari::python
