#include "formats/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "formats/json/path.h"
#include "jawari/scene/modes.h"

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

/// Static displacement of the place for each newton: sum phi_k^2/(mu omega_k^2), or psi_k^2/(M_k omega_k^2).
double static_compliance(const StringDescription& string, const DrivenForce& force) {
    const Modes modes = modes_of(string);
    double compliance = 0;
    for (std::size_t k = 0; k < modes.omega.size(); ++k) {
        const double shape = string.shapes ? string.shapes->points[force.point][k]
                                           : mode_shape(k + 1, force.position_m, string.length_m);
        const double mass = string.shapes ? string.shapes->modal_mass_kg[k] : string.linear_density_kg_per_m;
        compliance += shape * shape / (mass * modes.omega[k] * modes.omega[k]);
    }
    return compliance;
}

std::size_t frames_of(const Scene& scene) {
    const double frames = std::ceil(scene.duration_s * scene.description.output_rate_hz) + 2;
    return static_cast<std::size_t>(std::clamp(frames, 2.0, static_cast<double>(most_driven_frames)));
}

void sample_forces(const Scene& scene, const std::vector<ForceTable>& tables, StringDescription& string) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
        DrivenForce& force = string.forces[i];
        force.force_N =
            sample(tables[i].table, scene.description.output_rate_hz, frames_of(scene), Outside::Zero);
        if (!tables[i].height_m) continue;
        const double strength = *tables[i].height_m / static_compliance(string, force);
        for (double& value : force.force_N) value *= strength;
    }
}

void sample_motions(const Scene& scene, const std::vector<MotionTable>& tables, StringDescription& string) {
    string.motions.clear();
    for (const MotionTable& motion : tables) {
        if (motion.table.value.empty()) continue;  // a sound that is not loaded yet
        string.motions.push_back({motion.contact, sample(motion.table, scene.description.output_rate_hz,
                                                         frames_of(scene), Outside::Same)});
        string.contacts[motion.contact].height_m = string.motions.back().height_m.front();
    }
}

/// Forces come from "forces" and "plucks", motions from contacts.
std::optional<std::string> place_of_table(const Scene& scene, const std::string& place) {
    std::size_t string = 0;
    std::size_t index = 0;
    int length = 0;
    if (std::sscanf(place.c_str(), "strings[%zu].forces[%zu]%n", &string, &index, &length) == 2 && length > 0)
        return scene.tables.at(string).forces.at(index).table.place +
               place.substr(static_cast<std::size_t>(length));
    if (std::sscanf(place.c_str(), "strings[%zu].motions[%zu]%n", &string, &index, &length) == 2 &&
        length > 0)
        return scene.tables.at(string).motions.at(index).table.place +
               place.substr(static_cast<std::size_t>(length));
    return std::nullopt;
}

}  // namespace

void resolve_defaults(Scene& scene) {
    SceneDescription& description = scene.description;
    const double multiple = std::ceil(default_contact_rate_hz / description.output_rate_hz);
    description.contact_rate_hz = scene.contact_rate_hz.value_or(multiple * description.output_rate_hz);
    const ImpactLaw fallback = description.scheme == Scheme::Theta ? ImpactLaw::Newton : ImpactLaw::Signorini;
    description.law = scene.law.value_or(fallback);
    for (std::size_t s = 0; s < scene.tables.size(); ++s) {
        sample_forces(scene, scene.tables[s].forces, description.strings[s]);
        sample_motions(scene, scene.tables[s].motions, description.strings[s]);
    }
}

Failure in_file_terms(const Scene& scene, const Failure& failure) {
    std::size_t string = 0;
    std::size_t contact = 0;
    int length = 0;
    const char* place = failure.place.c_str();
    if (const auto table = place_of_table(scene, failure.place))
        return {*table, failure.value, failure.allowed};
    if (std::sscanf(place, "strings[%zu].contacts[%zu]%n", &string, &contact, &length) < 2 || length == 0)
        return failure;
    if (string >= scene.contact_sources.size()) return failure;
    const std::string path = json::indexed("strings", string);
    return {contact_place(scene.contact_sources[string], path, contact, place + length), failure.value,
            failure.allowed};
}

}  // namespace jawari::host
