#include "string/compile/validate.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace jawari {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using detail::Check;
using detail::indexed_place;

struct Range {
    double low = 0;
    double high = 0;
    bool low_included = true;
    bool high_included = true;
};

constexpr Range positive{0, infinity, false, false};
constexpr Range not_negative{0, infinity, true, false};
constexpr Range any_finite{-infinity, infinity, false, false};

std::string described(const Range& range) {
    if (range.low == -infinity && range.high == infinity) return "a finite number";
    if (range.high == infinity) {
        return std::string("a finite number ") + (range.low_included ? ">= " : "> ") + printed(range.low);
    }
    const std::string span = printed(range.low) + " to " + printed(range.high);
    return range.low_included && range.high_included ? span : span + ", ends excluded";
}

Check check(const std::string& place, double value, const Range& range) {
    const bool above = range.low_included ? value >= range.low : value > range.low;
    const bool below = range.high_included ? value <= range.high : value < range.high;
    if (std::isfinite(value) && above && below) return {};
    return Failure{place, printed(value), described(range)};
}

Check check_count(const std::string& place, std::size_t value, std::size_t low, std::size_t high) {
    if (value >= low && value <= high) return {};
    return Failure{place, std::to_string(value), std::to_string(low) + " to " + std::to_string(high)};
}

/// The first failure of several checks.
template <class... Rest>
Check first(Check check, Rest... rest) {
    if constexpr (sizeof...(rest) == 0) {
        return check;
    } else {
        return check ? check : first(std::move(rest)...);
    }
}

Check check_list(const std::string& place, const std::vector<double>& values, const Range& range) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (auto failure = check(indexed_place(place, i), values[i], range)) return failure;
    }
    return {};
}

Check check_damping(const std::string& place, const ValetteLoss& loss) {
    return first(
        check(place + ".diameter_m", loss.diameter_m, positive),
        check(place + ".air_viscosity_Pa_s", loss.air_viscosity_Pa_s, not_negative),
        check(place + ".air_density_kg_per_m3", loss.air_density_kg_per_m3, not_negative),
        check(place + ".viscoelastic_loss_angle_rad", loss.viscoelastic_loss_angle_rad, not_negative),
        check(place + ".inverse_quality", loss.inverse_quality, not_negative));
}

Check check_damping(const std::string& place, const DecayTimePoints& decay) {
    for (std::size_t i = 0; i < decay.points.size(); ++i) {
        const std::string point = indexed_place(place + ".points", i);
        if (auto failure = first(check(point + ".frequency_hz", decay.points[i].frequency_hz, positive),
                                 check(point + ".t60_s", decay.points[i].t60_s, positive))) {
            return failure;
        }
    }
    const DecayTime& low =
        decay.points[0].frequency_hz <= decay.points[1].frequency_hz ? decay.points[0] : decay.points[1];
    const DecayTime& high = &low == &decay.points[0] ? decay.points[1] : decay.points[0];
    if (high.t60_s > low.t60_s) {
        return Failure{place + ".points", printed(high.t60_s),
                       "a t60_s at the higher frequency that is not longer"};
    }
    if (high.frequency_hz == low.frequency_hz && high.t60_s != low.t60_s) {
        return Failure{place + ".points", printed(high.frequency_hz), "two different frequencies"};
    }
    return {};
}

Check check_damping(const std::string&, const NoLoss&) {
    return {};
}

Check check_modes(const std::string& place, const PhysicalModes& modes) {
    if (auto failure = first(check_count(place + ".count", modes.count, 1, limits::modes),
                             check(place + ".tension_N", modes.tension_N, positive),
                             check(place + ".inharmonicity", modes.inharmonicity, not_negative))) {
        return failure;
    }
    return std::visit([&](const auto& damping) { return check_damping(place + ".damping", damping); },
                      modes.damping);
}

Check check_modes(const std::string& place, const ModeTable& table) {
    if (table.decay_per_s.size() != table.frequency_hz.size()) {
        return Failure{place + ".decay_per_s", std::to_string(table.decay_per_s.size()) + " values",
                       std::to_string(table.frequency_hz.size()) + " values, as many as frequency_hz"};
    }
    return first(check_count(place + ".frequency_hz", table.frequency_hz.size(), 1, limits::modes),
                 check_list(place + ".frequency_hz", table.frequency_hz, positive),
                 check_list(place + ".decay_per_s", table.decay_per_s, not_negative));
}

std::size_t mode_count(const StringDescription& string) {
    if (const auto* physical = std::get_if<PhysicalModes>(&string.modes)) return physical->count;
    return std::get<ModeTable>(string.modes).frequency_hz.size();
}

Check check_initial(const std::string& place, const StringDescription& string) {
    if (const auto* pluck = std::get_if<Pluck>(&string.initial.shape)) {
        return first(
            check(place + ".pluck.position_m", pluck->position_m, {0, string.length_m, false, false}),
            check(place + ".pluck.height_m", pluck->height_m, any_finite));
    }
    if (const auto* modal = std::get_if<ModalState>(&string.initial.shape)) {
        const std::size_t n = mode_count(string);
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

Check check_contacts(const std::string& place, const StringDescription& string) {
    if (auto failure = check_count(place, string.contacts.size(), 0, limits::contacts)) return failure;
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        const std::string at = indexed_place(place, i);
        if (auto failure = first(check(at + ".position_m", contact.position_m, {0, string.length_m}),
                                 check(at + ".height_m", contact.height_m, any_finite),
                                 check(at + ".restitution", contact.restitution, {0, 1}))) {
            return failure;
        }
    }
    return {};
}

Check check_probes(const std::string& place, const StringDescription& string) {
    if (auto failure = check_count(place, string.probes.size(), 0, limits::probes)) return failure;
    for (std::size_t i = 0; i < string.probes.size(); ++i) {
        const ProbeDescription& probe = string.probes[i];
        const std::string at = indexed_place(place, i);
        if (probe.quantity == Quantity::ContactForce) {
            if (probe.contact < string.contacts.size()) continue;
            return Failure{at + ".contact", std::to_string(probe.contact),
                           string.contacts.empty() ? "a string with contacts"
                                                   : "0 to " + std::to_string(string.contacts.size() - 1)};
        }
        if (probe.quantity == Quantity::Energy) continue;
        if (auto failure = check(at + ".position_m", probe.position_m, {0, string.length_m})) return failure;
    }
    return {};
}

Check check_string(const std::string& place, const StringDescription& string) {
    if (auto failure =
            first(check(place + ".length_m", string.length_m, {0.001, 1000}),
                  check(place + ".linear_density_kg_per_m", string.linear_density_kg_per_m, positive))) {
        return failure;
    }
    if (auto failure = std::visit([&](const auto& modes) { return check_modes(place + ".modes", modes); },
                                  string.modes)) {
        return failure;
    }
    return first(check_initial(place + ".initial", string), check_contacts(place + ".contacts", string),
                 check_probes(place + ".probes", string));
}

Check check_rates(const SceneDescription& scene) {
    if (auto failure = first(
            check("output_rate_hz", scene.output_rate_hz, {limits::min_rate_hz, limits::max_rate_hz}),
            check("contact_rate_hz", scene.contact_rate_hz, {limits::min_rate_hz, limits::max_rate_hz}))) {
        return failure;
    }
    const double ratio = scene.contact_rate_hz / scene.output_rate_hz;
    const double nearest = std::max(1.0, std::round(ratio));
    if (std::abs(ratio - nearest) > 1e-9 * nearest) {
        return Failure{"contact_rate_hz", printed(scene.contact_rate_hz),
                       "an integer multiple of output_rate_hz " + printed(scene.output_rate_hz) +
                           ", the nearest being " + printed(nearest * scene.output_rate_hz)};
    }
    if (nearest > static_cast<double>(limits::steps_per_frame)) {
        return Failure{"contact_rate_hz", printed(scene.contact_rate_hz),
                       "at most " + std::to_string(limits::steps_per_frame) + " times output_rate_hz"};
    }
    return {};
}

Check check_scheme(const SceneDescription& scene) {
    if (scene.scheme == Scheme::Exact) return {};
    if (auto failure = check("theta", scene.theta, {0.5, 1})) return failure;
    if (scene.law != ImpactLaw::Newton)
        return Failure{"law", name_of(scene.law), "newton, the only law of the theta scheme"};
    return {};
}

}  // namespace

std::string detail::indexed_place(const std::string& list, std::size_t i) {
    return list + "[" + std::to_string(i) + "]";
}

const char* name_of(ImpactLaw law) {
    switch (law) {
        case ImpactLaw::Newton:
            return "newton";
        case ImpactLaw::Passive:
            return "passive";
        case ImpactLaw::Signorini:
            return "signorini";
        case ImpactLaw::PaoliSchatzman:
            return "paoli-schatzman";
    }
    return "an unknown law";
}

std::string printed(double value) {
    char text[64];
    // Rates read better as 2000000 than as 2e+06.
    const bool plain = value == 0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e15);
    const auto end = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr
                           : std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

std::optional<Failure> validate(const SceneDescription& scene) {
    if (auto failure = first(check_rates(scene), check_scheme(scene),
                             check_count("strings", scene.strings.size(), 1, limits::strings))) {
        return failure;
    }
    for (std::size_t i = 0; i < scene.strings.size(); ++i) {
        if (auto failure = check_string(indexed_place("strings", i), scene.strings[i])) return failure;
    }
    return {};
}

}  // namespace jawari
