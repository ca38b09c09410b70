#include "describe.h"

#include <iterator>
#include <sstream>
#include <variant>

#include "formats/scene/words.h"

namespace jawari::stress {
namespace {

void describe_modes(const PhysicalModes& modes, std::ostream& out) {
    static constexpr const char* losses[] = {"no loss", "valette", "decay times"};
    static_assert(std::size(losses) == std::variant_size_v<decltype(modes.damping)>);
    out << modes.count << " modes, " << modes.tension_N << " N, B " << modes.inharmonicity << ", "
        << losses[modes.damping.index()];
}

void describe_modes(const ModeTable& table, std::ostream& out) {
    out << table.frequency_hz.size() << " modes from a table, first " << table.frequency_hz.front() << " Hz";
}

void describe_start(const InitialCondition& initial, std::ostream& out) {
    out << (initial.start == Start::Exact ? ", exact start " : ", backward start ");
    static constexpr const char* shapes[] = {"rest", "a pluck", "modal displacements and velocities",
                                             "a profile"};
    static_assert(std::size(shapes) == std::variant_size_v<decltype(initial.shape)>);
    out << "from " << shapes[initial.shape.index()];
    if (const auto* pluck = std::get_if<Pluck>(&initial.shape))
        out << " of " << pluck->height_m << " m at " << pluck->position_m << " m";
}

void describe_string(const StringDescription& string, std::ostream& out) {
    out << "; string of " << string.length_m << " m, " << string.linear_density_kg_per_m << " kg/m, ";
    std::visit([&](const auto& modes) { describe_modes(modes, out); }, string.modes);
    describe_start(string.initial, out);
    out << ", " << string.contacts.size() << " contacts";
    if (!string.contacts.empty())
        out << ", the first at " << string.contacts[0].position_m << " m, height "
            << string.contacts[0].height_m << " m, e " << string.contacts[0].restitution;
    out << ", " << string.springs.size() << " springs, " << string.hammers.size() << " hammers, "
        << string.forces.size() << " forces, probes:";
    for (const ProbeDescription& probe : string.probes) out << " " << host::word(probe.quantity);
}

}  // namespace

std::string describe(const HostileScene& hostile) {
    static constexpr const char* meters[] = {"unmetered", "metered by frame", "metered by step"};
    std::ostringstream out;
    const SceneDescription& scene = hostile.description;
    out << hostile.kind << ": " << scene.output_rate_hz << " Hz, " << scene.contact_rate_hz << " Hz, "
        << meters[static_cast<std::size_t>(hostile.metering)] << (hostile.forces ? ", forces" : "")
        << (hostile.moves ? ", moving obstacles" : "") << (hostile.denormals ? ", denormals" : "");
    if (scene.scheme == Scheme::Theta) out << ", theta " << scene.theta;
    for (const StringDescription& string : scene.strings) describe_string(string, out);
    return out.str();
}

std::string describe(const HostileInstrument& hostile) {
    std::ostringstream out;
    const InstrumentDescription& instrument = hostile.description;
    out << hostile.kind << ": " << name_of(instrument.law) << ", " << hostile.output_rate_hz << " Hz, "
        << instrument.quality.contact_rate_min_hz << " Hz, modes to " << instrument.quality.mode_limit_hz
        << " Hz, " << instrument.strings.size() << " strings, " << hostile.lower.size() << " quality levels";
    for (const InstrumentStringDescription& string : instrument.strings)
        out << "; string of " << string.open_frequency_hz << " Hz, " << string.length_m << " m, "
            << string.linear_density_kg_per_m << " kg/m, B " << string.inharmonicity;
    return out.str();
}

}  // namespace jawari::stress
