#include "string/compile/validate.h"

#include <charconv>
#include <cmath>

#include "string/compile/checks.h"
#include "string/compile/validate_parts.h"

namespace jawari {
namespace {

using checks::any_finite;
using checks::check;
using checks::check_count;
using checks::check_list;
using checks::first;
using checks::not_negative;
using checks::positive;
using detail::Check;
using detail::indexed_place;

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

Check check_modes(const std::string& place, const PhysicalModes& modes, bool) {
    if (auto failure = first(check_count(place + ".count", modes.count, 1, limits::modes),
                             check(place + ".tension_N", modes.tension_N, positive),
                             check(place + ".inharmonicity", modes.inharmonicity, not_negative))) {
        return failure;
    }
    return std::visit([&](const auto& damping) { return check_damping(place + ".damping", damping); },
                      modes.damping);
}

Check check_modes(const std::string& place, const ModeTable& table, bool may_be_free) {
    if (table.decay_per_s.size() != table.frequency_hz.size()) {
        return Failure{place + ".decay_per_s", std::to_string(table.decay_per_s.size()) + " values",
                       std::to_string(table.frequency_hz.size()) + " values, as many as frequency_hz"};
    }
    return first(
        check_count(place + ".frequency_hz", table.frequency_hz.size(), 1, limits::modes),
        check_list(place + ".frequency_hz", table.frequency_hz, may_be_free ? not_negative : positive),
        check_list(place + ".decay_per_s", table.decay_per_s, not_negative));
}

Check check_system(const std::string& place, const StringDescription& string) {
    if (!string.shapes) {
        if (auto failure =
                first(check(place + ".length_m", string.length_m, {0.001, 1000}),
                      check(place + ".linear_density_kg_per_m", string.linear_density_kg_per_m, positive))) {
            return failure;
        }
    }
    if (auto failure = std::visit(
            [&](const auto& modes) {
                return check_modes(place + ".modes", modes, string.shapes.has_value());
            },
            string.modes)) {
        return failure;
    }
    return checks::check_shapes(place + ".modes", string);
}

Check check_string(const std::string& place, const StringDescription& string) {
    if (auto failure = check_system(place, string)) return failure;
    return first(checks::check_initial(place + ".initial", string), checks::check_obstacles(place, string),
                 checks::check_drives(place, string), checks::check_probes(place + ".probes", string));
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
    for (std::size_t i = 0; i < scene.strings.size(); ++i) {
        if (auto failure = checks::check_for_theta(indexed_place("strings", i), scene.strings[i]))
            return failure;
    }
    if (auto failure = check("theta", scene.theta, {0.5, 1, true, true})) return failure;
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
