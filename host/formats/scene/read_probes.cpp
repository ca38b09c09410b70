#include "formats/scene/read_probes.h"

#include <string>

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

Quantity read_quantity(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"quantity", "position_m", "point", "mode", "contact", "hammer"},
                        problems);
    return reader.choice<Quantity>("quantity", {{"displacement", Quantity::Displacement},
                                                {"velocity", Quantity::Velocity},
                                                {"acceleration", Quantity::Acceleration},
                                                {"slope", Quantity::Slope},
                                                {"nut_force", Quantity::NutForce},
                                                {"bridge_force", Quantity::BridgeForce},
                                                {"mode_displacement", Quantity::ModeDisplacement},
                                                {"mode_velocity", Quantity::ModeVelocity},
                                                {"mode_energy", Quantity::ModeEnergy},
                                                {"contact_force", Quantity::ContactForce},
                                                {"hammer_force", Quantity::HammerForce},
                                                {"hammer_displacement", Quantity::HammerDisplacement},
                                                {"energy", Quantity::Energy}});
}

/// Each quantity has its own keys, so that a position given for an energy is not silently ignored.
ProbeDescription read_probe(const Value& value, const std::string& path, System& system, Problems& problems) {
    ProbeDescription probe;
    probe.quantity = read_quantity(value, path, problems);
    if (problems.any()) return probe;
    switch (probe.quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity:
        case Quantity::Acceleration:
        case Quantity::Slope: {
            ObjectReader reader(value, path, {"quantity", system.place_key()}, problems);
            const Place place = system.place(reader);
            probe.position_m = place.position_m;
            probe.point = place.point;
            break;
        }
        case Quantity::ModeDisplacement:
        case Quantity::ModeVelocity:
        case Quantity::ModeEnergy: {
            ObjectReader reader(value, path, {"quantity", "mode"}, problems);
            probe.mode = reader.whole_number("mode", 1, limits::modes);
            break;
        }
        case Quantity::ContactForce: {
            ObjectReader reader(value, path, {"quantity", "contact"}, problems);
            probe.contact = reader.whole_number("contact", 0, limits::contacts - 1);
            break;
        }
        case Quantity::HammerForce:
        case Quantity::HammerDisplacement: {
            ObjectReader reader(value, path, {"quantity", "hammer"}, problems);
            probe.hammer = reader.whole_number("hammer", 0, limits::hammers - 1);
            break;
        }
        case Quantity::NutForce:
        case Quantity::BridgeForce:
        case Quantity::Energy:
            ObjectReader(value, path, {"quantity"}, problems);
            break;
    }
    return probe;
}

}  // namespace

std::vector<ProbeDescription> read_probes(ObjectReader& reader, System& system) {
    std::vector<ProbeDescription> probes;
    if (!reader.has("probes")) return probes;
    const json::Array* array = reader.array("probes", limits::probes);
    if (array == nullptr) return probes;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i)
        probes.push_back(
            read_probe((*array)[i], json::indexed(reader.path_of("probes"), i), system, reader.problems()));
    return probes;
}

}  // namespace jawari::host
