#include "formats/scene/read_string.h"

#include <utility>

#include "formats/scene/read_attachments.h"
#include "formats/scene/read_contacts.h"
#include "formats/scene/read_drives.h"
#include "formats/scene/read_probes.h"
#include "formats/scene/system.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

ModalState read_modal_state(ObjectReader& reader) {
    ModalState state;
    if (reader.has("modal_displacement"))
        state.displacement = reader.numbers("modal_displacement", limits::modes);
    if (reader.has("modal_velocity")) state.velocity = reader.numbers("modal_velocity", limits::modes);
    return state;
}

Profile read_profile(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"position_m", "displacement_m", "velocity_m_per_s"}, problems);
    Profile profile;
    profile.position_m = reader.numbers("position_m", limits::profile_points);
    if (reader.has("displacement_m"))
        profile.displacement_m = reader.numbers("displacement_m", limits::profile_points);
    if (reader.has("velocity_m_per_s"))
        profile.velocity_m_per_s = reader.numbers("velocity_m_per_s", limits::profile_points);
    if (!reader.has("displacement_m") && !reader.has("velocity_m_per_s"))
        problems.add(path, "neither", "displacement_m, velocity_m_per_s or both");
    return profile;
}

InitialCondition read_initial(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"pluck", "profile", "modal_displacement", "modal_velocity", "start"},
                        problems);
    InitialCondition initial;
    initial.start =
        reader.choice_or("start", Start::Exact, {{"exact", Start::Exact}, {"backward", Start::Backward}});
    const bool modal = reader.has("modal_displacement") || reader.has("modal_velocity");
    const Value* pluck = reader.find("pluck");
    const Value* profile = reader.find("profile");
    if (pluck != nullptr && modal)
        problems.add(reader.path_of("pluck"), "beside a modal state", "either a pluck or a modal state");
    if (profile != nullptr && (pluck != nullptr || modal))
        problems.add(reader.path_of("profile"), "beside another start",
                     "one of profile, pluck and modal state");
    if (pluck != nullptr) {
        ObjectReader corner(*pluck, reader.path_of("pluck"), {"position_m", "height_m"}, problems);
        initial.shape = Pluck{corner.number("position_m"), corner.number("height_m")};
    } else if (profile != nullptr) {
        initial.shape = read_profile(*profile, reader.path_of("profile"), problems);
    } else if (modal) {
        initial.shape = read_modal_state(reader);
    }
    return initial;
}

}  // namespace

StringDescription read_string(const Value& value, const std::string& path, ContactSources& sources,
                              DrivenTables& tables, Problems& problems) {
    const auto* object = std::get_if<json::Object>(&value.content);
    const Value* modes = object == nullptr ? nullptr : json::find(*object, "modes");
    System system = modes == nullptr ? System() : System::read(*modes, json::member(path, "modes"), problems);
    std::vector<std::string_view> keys{"name",    "modes",  "initial", "contacts", "springs",
                                       "hammers", "forces", "plucks",  "probes"};
    if (system.is_string())
        keys = {"name",    "length_m", "linear_density_kg_per_m",
                "modes",   "initial",  "contacts",
                "frets",   "neck",     "springs",
                "hammers", "forces",   "plucks",
                "probes"};
    ObjectReader reader(value, path, keys, problems);
    StringDescription string;
    string.name = reader.text_or("name", "");
    if (system.is_string()) {
        string.length_m = reader.number("length_m");
        string.linear_density_kg_per_m = reader.number("linear_density_kg_per_m");
    }
    reader.require("modes", "an object");
    if (const Value* initial = reader.find("initial"))
        string.initial = read_initial(*initial, reader.path_of("initial"), problems);
    string.contacts = read_all_contacts(reader, system, string.length_m, sources, tables);
    string.springs = read_springs(reader, system);
    string.hammers = read_hammers(reader, system);
    read_forces(reader, system, string, tables);
    read_plucks(reader, system, string, tables);
    string.probes = read_probes(reader, system);
    if (!problems.any()) system.finish(string);
    return string;
}

}  // namespace jawari::host
