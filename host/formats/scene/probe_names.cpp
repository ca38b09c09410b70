#include "formats/scene/probe_names.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "base/text.h"
#include "formats/scene/words.h"

namespace jawari::host {

namespace {

std::string quantity_with_unit(Quantity quantity, bool tabled_shapes) {
    std::string text = unit(quantity, tabled_shapes);
    if (text == "1") return word(quantity);
    if (const auto slash = text.find('/'); slash != std::string::npos) text.replace(slash, 1, "_per_");
    std::erase(text, '^');
    return word(quantity) + "_" + text;
}

std::string place_name(const StringDescription& string, const ProbeDescription& probe) {
    if (!string.shapes) return shortest(probe.position_m);
    if (probe.point < string.shapes->names.size()) return string.shapes->names[probe.point];
    return "point" + std::to_string(probe.point);
}

std::string probe_name(const StringDescription& string, const ProbeDescription& probe) {
    std::string name = quantity_with_unit(probe.quantity, string.shapes.has_value());
    switch (probe.quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity:
        case Quantity::Acceleration:
        case Quantity::Slope:
            return name + "@" + place_name(string, probe);
        case Quantity::ModeDisplacement:
        case Quantity::ModeVelocity:
        case Quantity::ModeEnergy:
            return name + "@mode" + std::to_string(probe.mode);
        case Quantity::ContactForce:
            return name + "@contact" + std::to_string(probe.contact);
        case Quantity::HammerForce:
        case Quantity::HammerDisplacement:
            return name + "@hammer" + std::to_string(probe.hammer);
        case Quantity::NutForce:
        case Quantity::BridgeForce:
        case Quantity::Energy:
            break;
    }
    return name;
}

}  // namespace

std::vector<ProbeLabel> probe_labels(const SceneDescription& scene) {
    std::vector<ProbeLabel> labels;
    std::map<std::string, std::size_t> seen;
    for (std::size_t s = 0; s < scene.strings.size(); ++s) {
        const StringDescription& string = scene.strings[s];
        const std::string prefix = scene.strings.size() > 1 ? string.name + ":" : "";
        for (const ProbeDescription& probe : string.probes) {
            std::string name = prefix + probe_name(string, probe);
            if (const std::size_t count = ++seen[name]; count > 1)
                name.append("#").append(std::to_string(count));
            labels.push_back({name, unit(probe.quantity, string.shapes.has_value()), probe.quantity, s});
        }
    }
    return labels;
}

}  // namespace jawari::host
