#include "string/compile/validate_parts.h"

#include <algorithm>

#include "string/compile/checks.h"
#include "string/compile/places.h"

namespace jawari::checks {
namespace {

Check check_index(const std::string& place, std::size_t index, std::size_t count, const std::string& what) {
    if (index < count) return {};
    return Failure{place, std::to_string(index),
                   count == 0 ? "a string with " + what : "0 to " + std::to_string(count - 1)};
}

Check check_compliance(const std::string& place, const Compliance& compliance) {
    if (auto failure =
            first(check(place + ".stiffness", compliance.stiffness, not_negative),
                  check(place + ".exponent", compliance.exponent, {1, 10}),
                  check(place + ".loss_s_per_m", compliance.loss_s_per_m, not_negative),
                  check(place + ".resistance_kg_per_s", compliance.resistance_kg_per_s, not_negative))) {
        return failure;
    }
    if (compliance.stiffness > 0 || compliance.resistance_kg_per_s > 0) return {};
    return Failure{place + ".stiffness", printed(compliance.stiffness),
                   "more than 0, or a resistance_kg_per_s"};
}

Check check_contacts(const std::string& place, const StringDescription& string) {
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        const std::string at = indexed_place(place, i);
        if (auto failure = first(check_place(at, string, contact.position_m, contact.point),
                                 check(at + ".height_m", contact.height_m, any_finite),
                                 check(at + ".restitution", contact.restitution, {0, 1}))) {
            return failure;
        }
        if (!contact.compliance) continue;
        if (auto failure = check_compliance(at + ".compliance", *contact.compliance)) return failure;
    }
    return {};
}

Check check_springs(const std::string& place, const StringDescription& string) {
    for (std::size_t i = 0; i < string.springs.size(); ++i) {
        const SpringDescription& spring = string.springs[i];
        const std::string at = indexed_place(place, i);
        if (auto failure =
                first(check_place(at, string, spring.position_m, spring.point),
                      check(at + ".height_m", spring.height_m, any_finite),
                      check(at + ".stiffness_N_per_m", spring.stiffness_N_per_m, not_negative),
                      check(at + ".resistance_kg_per_s", spring.resistance_kg_per_s, not_negative))) {
            return failure;
        }
    }
    return {};
}

Check check_hammers(const std::string& place, const StringDescription& string) {
    if (auto failure = check_count(place, string.hammers.size(), 0, limits::hammers)) return failure;
    for (std::size_t i = 0; i < string.hammers.size(); ++i) {
        const FlyingHammer& hammer = string.hammers[i];
        const std::string at = indexed_place(place, i);
        if (auto failure = first(check_place(at, string, hammer.position_m, hammer.point),
                                 check(at + ".time_s", hammer.time_s, {0, 86400}),
                                 check(at + ".mass_kg", hammer.mass_kg, positive),
                                 check(at + ".velocity_m_per_s", hammer.velocity_m_per_s, not_negative),
                                 check_compliance(at, hammer.compliance))) {
            return failure;
        }
    }
    const std::size_t modes = own_modes(string) + string.hammers.size();
    if (modes <= limits::modes) return {};
    return Failure{place, std::to_string(string.hammers.size()) + " hammers",
                   "at most " + std::to_string(limits::modes) + " modes and hammers"};
}

Check check_profile(const std::string& place, const StringDescription& string, const Profile& profile) {
    if (string.shapes)
        return Failure{place, "a profile", "modal_displacement and modal_velocity for what is no string"};
    const std::size_t count = profile.position_m.size();
    if (auto failure = check_count(place + ".position_m", count, 2, limits::profile_points)) return failure;
    for (std::size_t i = 0; i < count; ++i) {
        const double least = i == 0 ? 0 : profile.position_m[i - 1];
        if (auto failure = check(indexed_place(place + ".position_m", i), profile.position_m[i],
                                 {least, string.length_m})) {
            return failure;
        }
    }
    for (const auto& [key, list] : {std::pair{".displacement_m", &profile.displacement_m},
                                    std::pair{".velocity_m_per_s", &profile.velocity_m_per_s}}) {
        if (!list->empty() && list->size() != count) {
            return Failure{place + key, std::to_string(list->size()) + " values",
                           std::to_string(count) + " values, as many as position_m"};
        }
        if (auto failure = check_list(place + key, *list, any_finite)) return failure;
    }
    return {};
}

}  // namespace

std::size_t own_modes(const StringDescription& string) {
    if (const auto* physical = std::get_if<PhysicalModes>(&string.modes)) return physical->count;
    return std::get<ModeTable>(string.modes).frequency_hz.size();
}

Check check_place(const std::string& place, const StringDescription& string, double position_m,
                  std::size_t point) {
    if (string.shapes) return check_index(place + ".point", point, string.shapes->points.size(), "points");
    return check(place + ".position_m", position_m, {0, string.length_m});
}

Check check_shapes(const std::string& place, const StringDescription& string) {
    if (!string.shapes) return {};
    const ShapeTable& table = *string.shapes;
    const std::size_t n = own_modes(string);
    if (std::holds_alternative<PhysicalModes>(string.modes))
        return Failure{place, "physical modes",
                       "tables of frequency_hz and decay_per_s where shapes are given"};
    if (table.modal_mass_kg.size() != n) {
        return Failure{place + ".modal_mass_kg", std::to_string(table.modal_mass_kg.size()) + " values",
                       std::to_string(n) + " values, one per mode"};
    }
    if (auto failure = first(check_list(place + ".modal_mass_kg", table.modal_mass_kg, positive),
                             check_count(place + ".points", table.points.size(), 1, limits::shape_points))) {
        return failure;
    }
    for (std::size_t p = 0; p < table.points.size(); ++p) {
        const std::string at = indexed_place(place + ".points", p);
        if (table.points[p].size() != n) {
            return Failure{at, std::to_string(table.points[p].size()) + " values",
                           std::to_string(n) + " values, one per mode"};
        }
        if (auto failure = check_list(at, table.points[p], any_finite)) return failure;
    }
    return {};
}

Check check_initial(const std::string& place, const StringDescription& string) {
    if (const auto* pluck = std::get_if<Pluck>(&string.initial.shape)) {
        if (string.shapes) {
            return Failure{place + ".pluck", "a pluck",
                           "modal_displacement and modal_velocity for what is no string"};
        }
        return first(
            check(place + ".pluck.position_m", pluck->position_m, {0, string.length_m, false, false}),
            check(place + ".pluck.height_m", pluck->height_m, any_finite));
    }
    if (const auto* profile = std::get_if<Profile>(&string.initial.shape))
        return check_profile(place + ".profile", string, *profile);
    if (const auto* modal = std::get_if<ModalState>(&string.initial.shape)) {
        const std::size_t n = own_modes(string);
        for (const auto& [key, list] : {std::pair{".modal_displacement", &modal->displacement},
                                        std::pair{".modal_velocity", &modal->velocity}}) {
            if (!list->empty() && list->size() != n) {
                return Failure{place + key, std::to_string(list->size()) + " values",
                               std::to_string(n) + " values, one per mode"};
            }
            if (auto failure = check_list(place + key, *list, any_finite)) return failure;
        }
    }
    return {};
}

Check check_obstacles(const std::string& place, const StringDescription& string) {
    if (auto failure =
            first(check_count(place + ".contacts", string.contacts.size(), 0, limits::contacts),
                  check_contacts(place + ".contacts", string),
                  check_count(place + ".springs", string.springs.size(), 0, limits::contacts),
                  check_springs(place + ".springs", string), check_hammers(place + ".hammers", string))) {
        return failure;
    }
    const std::size_t all = contact_places(string).size();
    if (all <= limits::contacts) return {};
    return Failure{place + ".contacts", std::to_string(all) + " with hammers and springs",
                   "at most " + std::to_string(limits::contacts)};
}

Check check_drives(const std::string& place, const StringDescription& string) {
    if (auto failure = check_count(place + ".forces", string.forces.size(), 0, limits::forces))
        return failure;
    for (std::size_t i = 0; i < string.forces.size(); ++i) {
        const DrivenForce& force = string.forces[i];
        const std::string at = indexed_place(place + ".forces", i);
        if (auto failure = first(check_place(at, string, force.position_m, force.point),
                                 check_list(at + ".force_N", force.force_N, any_finite))) {
            return failure;
        }
    }
    std::vector<std::uint8_t> moves(string.contacts.size(), 0);
    for (std::size_t i = 0; i < string.motions.size(); ++i) {
        const DrivenHeight& motion = string.motions[i];
        const std::string at = indexed_place(place + ".motions", i);
        if (auto failure =
                first(check_index(at + ".contact", motion.contact, string.contacts.size(), "contacts"),
                      check_list(at + ".height_m", motion.height_m, any_finite))) {
            return failure;
        }
        if (moves[motion.contact]++ != 0)
            return Failure{at + ".contact", std::to_string(motion.contact), "each contact once"};
    }
    return {};
}

Check check_probes(const std::string& place, const StringDescription& string) {
    if (auto failure = check_count(place, string.probes.size(), 0, limits::probes)) return failure;
    for (std::size_t i = 0; i < string.probes.size(); ++i) {
        const ProbeDescription& probe = string.probes[i];
        const std::string at = indexed_place(place, i);
        Check failure;
        switch (probe.quantity) {
            case Quantity::Displacement:
            case Quantity::Velocity:
            case Quantity::Acceleration:
            case Quantity::Slope:
                failure = check_place(at, string, probe.position_m, probe.point);
                break;
            case Quantity::ModeDisplacement:
            case Quantity::ModeVelocity:
            case Quantity::ModeEnergy:
                failure = check_count(at + ".mode", probe.mode, 1, own_modes(string));
                break;
            case Quantity::ContactForce:
                failure = check_index(at + ".contact", probe.contact, string.contacts.size(), "contacts");
                break;
            case Quantity::HammerForce:
            case Quantity::HammerDisplacement:
                failure = check_index(at + ".hammer", probe.hammer, string.hammers.size(), "hammers");
                break;
            case Quantity::NutForce:
            case Quantity::BridgeForce:
            case Quantity::Energy:
                break;
        }
        if (failure) return failure;
        const bool needs_string = probe.quantity == Quantity::Slope || probe.quantity == Quantity::NutForce ||
                                  probe.quantity == Quantity::BridgeForce;
        if (needs_string && string.shapes)
            return Failure{at + ".quantity", "slope, nut_force or bridge_force",
                           "another for what is no string"};
    }
    return {};
}

Check check_for_theta(const std::string& place, const StringDescription& string) {
    const auto exact_alone = [&](const std::string& key, const char* what) {
        return Failure{place + key, what, "the exact scheme"};
    };
    if (!string.springs.empty()) return exact_alone(".springs", "springs");
    if (!string.hammers.empty()) return exact_alone(".hammers", "hammers");
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        if (string.contacts[i].compliance)
            return exact_alone(indexed_place(".contacts", i) + ".compliance", "a compliant contact");
    }
    return {};
}

}  // namespace jawari::checks
