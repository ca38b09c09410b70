#include "jawari/scene/compile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/square.h"
#include "jawari/detail/step_coefficients.h"
#include "jawari/scene/modes.h"
#include "string/compile/compile_frames.h"
#include "string/compile/contact_tables.h"
#include "string/compile/static_equilibrium.h"
#include "string/compile/validate.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Below this share of the largest Delassus diagonal a contact cannot move the string (it sits on an end).
constexpr double negligible_mobility = 1e-12;

void set_modes(StringModel& model, const StringDescription& string) {
    const Modes modes = modes_of(string);
    model.name = string.name;
    model.length_m = string.length_m;
    model.linear_density_kg_per_m = string.linear_density_kg_per_m;
    model.mode_count = modes.omega.size();
    model.stride = padded(model.mode_count);
    model.omega.assign(model.stride, 0.0);
    model.sigma.assign(model.stride, 0.0);
    std::copy(modes.omega.begin(), modes.omega.end(), model.omega.begin());
    std::copy(modes.sigma.begin(), modes.sigma.end(), model.sigma.begin());
}

void set_energy_weights(StringModel& model, std::size_t k, const StepCoefficients& step) {
    const double mu = model.linear_density_kg_per_m;
    const double h = model.step_s;
    model.potential[k] = mu * square(model.omega[k]) / 2;
    if (model.scheme == Scheme::Theta) {
        model.kinetic[k] = mu / 2;
        model.dissipation[k] = 2 * mu * model.sigma[k] * h;
    } else if (step.mobility > 0) {
        model.kinetic[k] = mu * exact_factors(model.omega[k], model.sigma[k], h).s / (8 * step.mobility);
        model.dissipation[k] = -mu * std::expm1(-2 * model.sigma[k] * h) / (4 * step.mobility);
    }
}

void set_step(StringModel& model, const SceneDescription& scene) {
    model.scheme = scene.scheme;
    model.theta = scene.scheme == Scheme::Theta ? scene.theta : 1.0;
    model.law = scene.law;
    model.step_s = 1 / scene.contact_rate_hz;
    model.steps_per_frame =
        static_cast<std::size_t>(std::lround(scene.contact_rate_hz / scene.output_rate_hz));
    for (auto* array : {&model.carry, &model.change, &model.restoring, &model.mobility, &model.kinetic,
                        &model.potential, &model.dissipation}) {
        array->assign(model.stride, 0.0);
    }
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        const StepCoefficients step =
            scene.scheme == Scheme::Theta
                ? theta_step(model.omega[k], model.sigma[k], model.step_s, model.theta)
                : exact_step(model.omega[k], model.sigma[k], model.step_s);
        model.carry[k] = step.carry;
        model.change[k] = step.change;
        model.restoring[k] = step.restoring;
        model.mobility[k] = step.mobility / model.linear_density_kg_per_m;
        set_energy_weights(model, k, step);
    }
}

void write_mode_shapes(const StringModel& model, double x, double sign, double* row) {
    for (std::size_t k = 0; k < model.mode_count; ++k) row[k] = sign * mode_shape(k + 1, x, model.length_m);
}

void append_contact(StringModel& model, const ContactDescription& contact, const AlignedVector<double>& row) {
    const double sign = contact.side == Side::Below ? 1.0 : -1.0;
    model.contact_rows.append(row);
    model.contact_height.push_back(sign * contact.height_m);
    model.contact_restitution.push_back(contact.restitution);
    model.contact_position.push_back(contact.position_m);
    model.contact_side.push_back(contact.side);
    model.contact_count += 1;
}

/// Rows of the contacts that can move the string; the others are dropped, or refused if they press on it at
/// rest.
std::optional<Failure> set_contacts(StringModel& model, const StringDescription& string,
                                    const std::string& place) {
    std::vector<AlignedVector<double>> rows(string.contacts.size(), AlignedVector<double>(model.stride, 0.0));
    std::vector<double> diagonal(string.contacts.size());
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        write_mode_shapes(model, contact.position_m, contact.side == Side::Below ? 1.0 : -1.0,
                          rows[i].data());
        diagonal[i] = kernels::weighted_square(model.stride, model.mobility.data(), 1, rows[i].data(), 0,
                                               rows[i].data());
    }
    const double largest = diagonal.empty() ? 0.0 : *std::max_element(diagonal.begin(), diagonal.end());
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        const bool immobile = !(diagonal[i] > negligible_mobility * largest);
        if (!immobile) {
            model.contact_of_description.push_back(static_cast<std::ptrdiff_t>(model.contact_count));
            append_contact(model, contact, rows[i]);
            continue;
        }
        model.contact_of_description.push_back(-1);
        const bool presses = contact.side == Side::Below ? contact.height_m > 0 : contact.height_m < 0;
        if (presses) {
            return Failure{place + ".contacts[" + std::to_string(i) + "].height_m", printed(contact.height_m),
                           "a height that leaves the string's end at rest, or a position inside the string"};
        }
    }
    return {};
}

/// A gap is the difference of S q and b, neither known to better than half a rounding unit.
void set_gap_rounding(StringModel& model) {
    double largest = 0;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        const double* row = model.contact_rows.data() + c * model.stride;
        double size = std::abs(model.contact_height[c]);
        for (std::size_t k = 0; k < model.mode_count; ++k)
            size += std::abs(row[k] * model.initial_displacement[k]);
        largest = std::max(largest, size);
    }
    model.gap_rounding_m = std::numeric_limits<double>::epsilon() / 2 * largest;
}

struct TrueState {
    AlignedVector<double> displacement;
    AlignedVector<double> velocity;
};

TrueState described_state(const StringModel& model, const InitialCondition& initial) {
    TrueState state{AlignedVector<double>(model.stride, 0.0), AlignedVector<double>(model.stride, 0.0)};
    if (const auto* pluck = std::get_if<Pluck>(&initial.shape)) {
        for (std::size_t k = 0; k < model.mode_count; ++k) {
            state.displacement[k] = pluck_coordinate(k + 1, *pluck, model.length_m);
        }
    } else if (const auto* modal = std::get_if<ModalState>(&initial.shape)) {
        std::copy(modal->displacement.begin(), modal->displacement.end(), state.displacement.begin());
        std::copy(modal->velocity.begin(), modal->velocity.end(), state.velocity.begin());
    }
    return state;
}

/// A free string has a past in free motion; one that obstacles hold was at rest against them before t = 0.
bool set_initial_state(StringModel& model, const InitialCondition& initial) {
    const TrueState state = described_state(model, initial);
    const auto held = held_displacement(model, state.displacement);
    const AlignedVector<double> flat(model.stride, 0.0);
    const auto rest = held_displacement(model, flat);
    if (!held || !rest) return false;
    const bool is_held = std::any_of(held->begin(), held->end(), [](double q) { return q != 0; });
    model.initial_displacement = state.displacement;
    model.initial_velocity = state.velocity;
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        if (initial.start == Start::Exact && model.scheme == Scheme::Exact && !is_held) {
            model.initial_velocity[k] = exact_backward_velocity(model.omega[k], model.sigma[k], model.step_s,
                                                                state.displacement[k], state.velocity[k]);
        }
        model.initial_displacement[k] += (*held)[k];
    }
    model.rest_displacement = *rest;
    return true;
}

void set_probes(StringModel& model, const StringDescription& string) {
    model.probes = string.probes;
    model.probe_rows.assign(string.probes.size() * model.stride, 0.0);
    for (std::size_t p = 0; p < string.probes.size(); ++p) {
        const ProbeDescription& probe = string.probes[p];
        if (probe.quantity != Quantity::Displacement && probe.quantity != Quantity::Velocity) continue;
        write_mode_shapes(model, probe.position_m, 1.0, model.probe_rows.data() + p * model.stride);
    }
}

bool coefficients_are_finite(const StringModel& model) {
    const std::size_t n = model.stride;
    for (const auto* array : {&model.change, &model.restoring, &model.mobility, &model.kinetic,
                              &model.potential, &model.initial_displacement, &model.initial_velocity}) {
        if (!kernels::all_finite(n, array->data())) return false;
    }
    return std::all_of(model.sigma.begin(), model.sigma.end(), [](double sigma) { return sigma >= 0; });
}

Result<StringModel> compile_string(const StringDescription& string, const SceneDescription& scene,
                                   const std::string& place) {
    StringModel model;
    set_modes(model, string);
    set_step(model, scene);
    if (auto failure = set_contacts(model, string, place)) return *failure;
    set_compliance(model);
    if (scene.scheme == Scheme::Exact) set_skipping(model);
    if (!set_initial_state(model, string.initial)) {
        return Failure{place + ".contacts", "obstacles from both sides",
                       "obstacles between which the string fits"};
    }
    set_gap_rounding(model);
    set_probes(model, string);
    if (!coefficients_are_finite(model)) {
        return Failure{place + ".modes", "frequencies or losses",
                       "values whose coefficients are finite and whose losses are not negative"};
    }
    return model;
}

}  // namespace

Result<SceneModel> compile(const SceneDescription& scene) {
    if (auto failure = validate(scene)) return *failure;
    SceneModel model;
    model.output_rate_hz = scene.output_rate_hz;
    model.contact_rate_hz = scene.contact_rate_hz;
    for (std::size_t i = 0; i < scene.strings.size(); ++i) {
        auto string = compile_string(scene.strings[i], scene, "strings[" + std::to_string(i) + "]");
        if (!string) return string.failure();
        model.probe_count += string.value().probes.size();
        model.strings.push_back(std::move(string.value()));
    }
    model.steps_per_frame = model.strings.front().steps_per_frame;
    return model;
}

}  // namespace jawari
