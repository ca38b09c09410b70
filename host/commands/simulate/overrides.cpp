#include "commands/simulate/overrides.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "formats/scene/words.h"

namespace jawari::host {

namespace {

/// The contact rate nearest to the one asked for that is a multiple of the output rate.
double nearest_contact_rate(const SceneDescription& scene) {
    return std::max(1.0, std::round(scene.contact_rate_hz / scene.output_rate_hz)) * scene.output_rate_hz;
}

Error explain_contact_rate(const Failure& failure, const Overrides& overrides, const Scene& scene) {
    const std::string nearest = shortest(nearest_contact_rate(scene.description));
    if (overrides.contact_rate_hz)
        return usage_error("--contact-rate", shortest(*overrides.contact_rate_hz),
                           failure.allowed.starts_with("at most")
                               ? failure.allowed
                               : "an integer multiple of the output rate " +
                                     shortest(scene.description.output_rate_hz) + ", the nearest being " +
                                     nearest);
    return usage_error("--output-rate", shortest(scene.description.output_rate_hz),
                       "a rate that divides contact_rate_hz " + shortest(scene.description.contact_rate_hz) +
                           " of " + scene.file + ", or together with --contact-rate " + nearest);
}

}  // namespace

MaybeError apply_overrides(const Overrides& overrides, Scene& scene) {
    SceneDescription& description = scene.description;
    if (overrides.output_rate_hz) description.output_rate_hz = *overrides.output_rate_hz;
    if (overrides.quality) {
        description = at_quality(std::move(description), *overrides.quality);
        scene.contact_rate_hz = description.contact_rate_hz;
    }
    if (overrides.contact_rate_hz) scene.contact_rate_hz = overrides.contact_rate_hz;
    if (overrides.duration_s) scene.duration_s = *overrides.duration_s;
    if (overrides.scheme) description.scheme = *overrides.scheme;
    if (overrides.theta) description.theta = *overrides.theta;
    if (overrides.law) scene.law = overrides.law;
    for (StringDescription& string : description.strings) {
        if (overrides.start) string.initial.start = *overrides.start;
        if (!overrides.restitution) continue;
        for (ContactDescription& contact : string.contacts) contact.restitution = *overrides.restitution;
    }
    if (overrides.theta && description.scheme != Scheme::Theta)
        return usage_error("--theta", shortest(*overrides.theta), "only together with --scheme theta");
    resolve_defaults(scene);
    return std::nullopt;
}

Error explain(const Failure& failure, const Overrides& overrides, const Scene& scene) {
    const bool rate_asked = overrides.contact_rate_hz || overrides.output_rate_hz;
    if (failure.place == "contact_rate_hz" && rate_asked)
        return explain_contact_rate(failure, overrides, scene);
    if (failure.place == "output_rate_hz" && overrides.output_rate_hz)
        return usage_error("--output-rate", failure.value, failure.allowed);
    if (failure.place == "theta" && overrides.theta)
        return usage_error("--theta", failure.value, failure.allowed);
    if (failure.place == "law" && overrides.law)
        return usage_error("--law", word(scene.description.law), failure.allowed);
    if (failure.place == "law" && overrides.scheme)
        return usage_error("--scheme", "theta",
                           "for scenes with the law newton, or together with --law newton");
    return invalid_input(scene.file, in_file_terms(scene, failure));
}

}  // namespace jawari::host
