#include "formats/scene/read_string.h"

#include <utility>

#include "formats/scene/read_contacts.h"
#include "formats/scene/read_modes.h"

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

InitialCondition read_initial(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"pluck", "modal_displacement", "modal_velocity", "start"}, problems);
    InitialCondition initial;
    initial.start =
        reader.choice_or("start", Start::Exact, {{"exact", Start::Exact}, {"backward", Start::Backward}});
    const bool modal = reader.has("modal_displacement") || reader.has("modal_velocity");
    const Value* pluck = reader.find("pluck");
    if (pluck != nullptr && modal)
        problems.add(reader.path_of("pluck"), "beside a modal state", "either a pluck or a modal state");
    if (pluck != nullptr) {
        ObjectReader corner(*pluck, reader.path_of("pluck"), {"position_m", "height_m"}, problems);
        initial.shape = Pluck{corner.number("position_m"), corner.number("height_m")};
    } else if (modal) {
        initial.shape = read_modal_state(reader);
    }
    return initial;
}

Quantity read_quantity(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"quantity", "position_m", "contact"}, problems);
    return reader.choice<Quantity>("quantity", {{"displacement", Quantity::Displacement},
                                                {"velocity", Quantity::Velocity},
                                                {"contact_force", Quantity::ContactForce},
                                                {"energy", Quantity::Energy}});
}

/// Each quantity has its own keys, so that a position given for an energy is not silently ignored.
ProbeDescription read_probe(const Value& value, const std::string& path, Problems& problems) {
    ProbeDescription probe;
    probe.quantity = read_quantity(value, path, problems);
    switch (probe.quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity: {
            ObjectReader reader(value, path, {"quantity", "position_m"}, problems);
            probe.position_m = reader.number("position_m");
            break;
        }
        case Quantity::ContactForce: {
            ObjectReader reader(value, path, {"quantity", "contact"}, problems);
            probe.contact = reader.whole_number("contact", 0, limits::contacts - 1);
            break;
        }
        case Quantity::Energy:
            ObjectReader(value, path, {"quantity"}, problems);
            break;
    }
    return probe;
}

std::vector<ProbeDescription> read_probes(ObjectReader& reader) {
    std::vector<ProbeDescription> probes;
    if (!reader.has("probes")) return probes;
    const json::Array* array = reader.array("probes", limits::probes);
    if (array == nullptr) return probes;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i)
        probes.push_back(
            read_probe((*array)[i], json::indexed(reader.path_of("probes"), i), reader.problems()));
    return probes;
}

}  // namespace

StringDescription read_string(const Value& value, const std::string& path, ContactSources& sources,
                              Problems& problems) {
    ObjectReader reader(value, path,
                        {"name", "length_m", "linear_density_kg_per_m", "modes", "initial", "contacts",
                         "frets", "neck", "probes"},
                        problems);
    StringDescription string;
    string.name = reader.text_or("name", "");
    string.length_m = reader.number("length_m");
    string.linear_density_kg_per_m = reader.number("linear_density_kg_per_m");
    if (const Value* modes = reader.require("modes", "an object"))
        string.modes = read_modes(*modes, reader.path_of("modes"), problems);
    if (const Value* initial = reader.find("initial"))
        string.initial = read_initial(*initial, reader.path_of("initial"), problems);
    string.contacts = read_all_contacts(reader, string.length_m, sources);
    string.probes = read_probes(reader);
    return string;
}

}  // namespace jawari::host
