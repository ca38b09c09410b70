#include "commands/simulate/probe_names.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "base/text.h"
#include "formats/scene/words.h"

namespace jawari::host {

namespace {

std::string quantity_with_unit(Quantity quantity) {
    std::string text = unit(quantity);
    if (const auto slash = text.find('/'); slash != std::string::npos) text.replace(slash, 1, "_per_");
    return word(quantity) + "_" + text;
}

std::string probe_name(const ProbeDescription& probe) {
    std::string name = quantity_with_unit(probe.quantity);
    if (probe.quantity == Quantity::Energy) return name;
    if (probe.quantity == Quantity::ContactForce) return name + "@contact" + std::to_string(probe.contact);
    return name + "@" + shortest(probe.position_m);
}

}  // namespace

std::vector<ProbeLabel> probe_labels(const SceneDescription& scene) {
    std::vector<ProbeLabel> labels;
    std::map<std::string, std::size_t> seen;
    for (std::size_t s = 0; s < scene.strings.size(); ++s) {
        const StringDescription& string = scene.strings[s];
        const std::string prefix = scene.strings.size() > 1 ? string.name + ":" : "";
        for (const ProbeDescription& probe : string.probes) {
            std::string name = prefix + probe_name(probe);
            if (const std::size_t count = ++seen[name]; count > 1)
                name.append("#").append(std::to_string(count));
            labels.push_back({name, probe.quantity, s});
        }
    }
    return labels;
}

}  // namespace jawari::host
