#include "commands/simulate/resolution_warning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "base/text.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/modes.h"
#include "jawari/scene/resolution.h"

namespace jawari::host {

namespace {

/// Penetration of this share of the motion goes with errors of tens of percent, a tenth of it with about 1 %
/// (docs/commands/simulate.md, section "Warnings").
constexpr double bad_penetration = 0.02;
constexpr double good_penetration = 0.1 * bad_penetration;
/// Estimated errors that a law without penetration is warned of, and is advised.
constexpr double bad_error = 0.25;
constexpr double good_error = 0.01;
/// Impulses at the contact rate excite modes above half of it as much as those below: strings with few of
/// them stay far below the estimate, which was measured on a string with modes up to 75 times that limit and
/// more.
constexpr double many_modes_above = 64;
/// A start whose discrete energy is this many times the true one says nothing; a step that lets no mode decay
/// by more than exp(-1/2) keeps it below twice the true one.
constexpr double bad_start_energy = 10;
constexpr double good_decay = 0.5;

struct Finding {
    double rate_hz = 0;  ///< that would do
    std::string text;
};

bool forbids_penetration(const SceneDescription& settings) {
    return settings.law == ImpactLaw::Signorini || settings.law == ImpactLaw::PaoliSchatzman;
}

std::string percent(double share) {
    return formatted(share < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * share);
}

/// Laws of velocities let a string enter an obstacle by what it moves in a step.
std::optional<Finding> judge_penetration(const SceneDescription& settings, const StringResolution& string) {
    const double share = string.penetration_m / string.motion_m;
    if (string.impulses == 0 || !(share > bad_penetration)) return std::nullopt;
    return Finding{settings.contact_rate_hz * share / good_penetration,
                   "entered an obstacle by " + formatted("%.2g m, ", string.penetration_m) + percent(share) +
                       " of its motion"};
}

/// Laws of positions let it enter nothing, so that the error has to be estimated.
std::optional<Finding> judge_estimate(const SceneDescription& settings, const StringResolution& string) {
    if (string.impulses == 0 || !forbids_penetration(settings) || string.fundamental_hz == 0)
        return std::nullopt;
    const double error = contact_error(string.fundamental_hz, settings.contact_rate_hz);
    const bool many = string.highest_hz > many_modes_above * settings.contact_rate_hz / 2;
    if (!(error > bad_error) || !many) return std::nullopt;
    return Finding{settings.contact_rate_hz * error / good_error,
                   "has an estimated error of " + percent(std::min(error, 1.0))};
}

/// What a mode that decays within a step was one step before the start is huge, and H counts it.
std::optional<Finding> judge_start(const SceneDescription& settings, const StringResolution& string) {
    if (settings.scheme != Scheme::Exact || !(string.energy_J > bad_start_energy * string.true_energy_J))
        return std::nullopt;
    return Finding{
        string.fastest_decay_per_s / good_decay,
        "starts with " + formatted("%.2g J", string.energy_J) + " of discrete energy, " +
            formatted("%.2g J", string.true_energy_J) + " is right, as its fastest mode decays by " +
            formatted("exp(-%.3g)", string.fastest_decay_per_s / settings.contact_rate_hz) + " in a step"};
}

/// A whole multiple of the output rate, as high as compile() allows at most.
double allowed_rate_hz(const SceneDescription& settings, double rate_hz) {
    const double most =
        std::min<double>(limits::steps_per_frame, std::floor(limits::max_rate_hz / settings.output_rate_hz));
    return settings.output_rate_hz * std::clamp(std::ceil(rate_hz / settings.output_rate_hz), 1.0, most);
}

}  // namespace

namespace {

/// The largest square of a mode's shape anywhere it can be seen.
double largest_square(const StringDescription& string, std::size_t k) {
    if (!string.shapes) return 2 / string.length_m;
    double largest = 0;
    for (const std::vector<double>& point : string.shapes->points)
        largest = std::max(largest, std::abs(point[k]));
    return largest * largest;
}

/// Whether the discrete energy counts more than the modes of the description.
bool stores_elsewhere(const StringDescription& string) {
    return !string.hammers.empty() || !string.springs.empty() ||
           std::any_of(string.contacts.begin(), string.contacts.end(),
                       [](const ContactDescription& contact) { return contact.compliance.has_value(); });
}

}  // namespace

StringResolution describe_resolution(const StringDescription& string, const StringModel& model,
                                     const StringState& start) {
    const Modes modes = modes_of(string);
    const auto* given = std::get_if<ModalState>(&string.initial.shape);
    double square = 0;
    double energy_J = 0;
    double fastest_decay_per_s = 0;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < modes.omega.size(); ++k) {
        const double omega = modes.omega[k];
        const double q = model.shape->coordinate_unit[k] * start.displacement[k];
        const double v = given != nullptr && !given->velocity.empty() ? given->velocity[k] : 0.0;
        const double mass = string.shapes ? string.shapes->modal_mass_kg[k] : string.linear_density_kg_per_m;
        const double swing = omega > 0 ? v / omega : 0;
        square += largest_square(string, k) * (q * q + swing * swing);
        energy_J += mass * (v * v + omega * q * (omega * q)) / 2;
        if (q != 0 || v != 0) fastest_decay_per_s = std::max(fastest_decay_per_s, modes.sigma[k]);
        if (omega > 0) lowest = std::min(lowest, omega);
    }
    StringResolution resolution;
    resolution.energy_J = energy(model, start);
    resolution.true_energy_J = stores_elsewhere(string) ? resolution.energy_J : energy_J;
    resolution.fastest_decay_per_s = fastest_decay_per_s;
    resolution.name = model.shape->name;
    resolution.motion_m = std::sqrt(square);
    resolution.fundamental_hz = std::isinf(lowest) ? 0 : lowest / (2 * std::numbers::pi);
    resolution.highest_hz =
        *std::max_element(modes.omega.begin(), modes.omega.end()) / (2 * std::numbers::pi);
    return resolution;
}

std::optional<std::string> resolution_warning(const std::string& subject, const SceneDescription& settings,
                                              const std::vector<StringResolution>& strings) {
    Finding worst;
    for (const StringResolution& string : strings) {
        if (!(string.motion_m > 0)) continue;
        for (const auto& judge : {judge_start, judge_penetration, judge_estimate}) {
            const auto finding = judge(settings, string);
            if (!finding || finding->rate_hz <= worst.rate_hz) continue;
            worst = {finding->rate_hz, "string " + in_quotes(string.name) + " " + finding->text};
        }
    }
    if (worst.rate_hz == 0) return std::nullopt;
    const double rate_hz = allowed_rate_hz(settings, worst.rate_hz);
    return "warning: " + printable(subject) + ": the contact rate of " + shortest(settings.contact_rate_hz) +
           " Hz is far too low: " + worst.text + "; " + shortest(rate_hz) + " Hz would do";
}

}  // namespace jawari::host
