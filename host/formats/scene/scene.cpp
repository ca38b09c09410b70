#include "formats/scene/scene.h"

#include <cmath>
#include <cstdio>

#include "formats/json/path.h"

namespace jawari::host {

namespace {

/// `.height_m` of contact `index` of a string whose path is `string`.
std::string contact_place(const ContactSources& sources, const std::string& string, std::size_t index,
                          const std::string& key) {
    if (index < sources.contacts) return json::indexed(json::member(string, "contacts"), index) + key;
    const std::size_t fret = index - sources.contacts;
    if (fret < sources.frets) {
        const std::string frets = json::member(string, "frets");
        if (key == ".position_m") return frets + ".count";
        if (key == ".height_m" && sources.fret_heights_listed) return json::indexed(frets + key, fret);
        return frets + key;
    }
    const std::string neck = json::member(string, "neck");
    if (key == ".position_m") return neck + ".grid_points";
    if (key == ".height_m") return neck + ".profile_m";
    return neck + key;
}

}  // namespace

void resolve_defaults(Scene& scene) {
    SceneDescription& description = scene.description;
    const double multiple = std::ceil(default_contact_rate_hz / description.output_rate_hz);
    description.contact_rate_hz = scene.contact_rate_hz.value_or(multiple * description.output_rate_hz);
    const ImpactLaw fallback = description.scheme == Scheme::Theta ? ImpactLaw::Newton : ImpactLaw::Signorini;
    description.law = scene.law.value_or(fallback);
}

Failure in_file_terms(const Scene& scene, const Failure& failure) {
    std::size_t string = 0;
    std::size_t contact = 0;
    int length = 0;
    const char* place = failure.place.c_str();
    if (std::sscanf(place, "strings[%zu].contacts[%zu]%n", &string, &contact, &length) < 2 || length == 0)
        return failure;
    if (string >= scene.contact_sources.size()) return failure;
    const std::string path = json::indexed("strings", string);
    return {contact_place(scene.contact_sources[string], path, contact, place + length), failure.value,
            failure.allowed};
}

}  // namespace jawari::host
