#include "jawari/scene/compile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/square.h"
#include "jawari/detail/step_coefficients.h"
#include "jawari/scene/modes.h"
#include "string/compile/compile_frames.h"
#include "string/compile/contact_tables.h"
#include "string/compile/static_equilibrium.h"
#include "string/compile/string_draft.h"
#include "string/compile/validate.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Below this share of the largest Delassus diagonal a contact cannot move the string (it sits on an end).
constexpr double negligible_mobility = 1e-12;

void set_modes(StringDraft& draft, const StringDescription& string) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const Modes modes = modes_of(string);
    shape.name = string.name;
    shape.length_m = string.length_m;
    shape.linear_density_kg_per_m = string.linear_density_kg_per_m;
    shape.mode_count = modes.omega.size();
    shape.stride = padded(shape.mode_count);
    tuning.omega.assign(shape.stride, 0.0);
    shape.sigma.assign(shape.stride, 0.0);
    std::copy(modes.omega.begin(), modes.omega.end(), tuning.omega.begin());
    std::copy(modes.sigma.begin(), modes.sigma.end(), shape.sigma.begin());
}

void set_energy_weights(StringDraft& draft, std::size_t k, const StepCoefficients& step) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const double mu = shape.linear_density_kg_per_m;
    const double h = shape.step_s;
    tuning.potential[k] = mu * square(tuning.omega[k]) / 2;
    if (shape.scheme == Scheme::Theta) {
        tuning.kinetic[k] = mu / 2;
        shape.dissipation[k] = 2 * mu * shape.sigma[k] * h;
    } else if (step.mobility > 0) {
        tuning.kinetic[k] = mu * exact_factors(tuning.omega[k], shape.sigma[k], h).s / (8 * step.mobility);
        shape.dissipation[k] = -mu * std::expm1(-2 * shape.sigma[k] * h) / (4 * step.mobility);
    }
}

void set_step(StringDraft& draft, const SceneDescription& scene) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    shape.scheme = scene.scheme;
    shape.theta = scene.scheme == Scheme::Theta ? scene.theta : 1.0;
    shape.law = scene.law;
    shape.step_s = 1 / scene.contact_rate_hz;
    shape.steps_per_frame =
        static_cast<std::size_t>(std::lround(scene.contact_rate_hz / scene.output_rate_hz));
    for (auto* array : {&shape.carry, &shape.change, &tuning.restoring, &shape.mobility, &tuning.kinetic,
                        &tuning.potential, &shape.dissipation}) {
        array->assign(shape.stride, 0.0);
    }
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        const StepCoefficients step =
            scene.scheme == Scheme::Theta
                ? theta_step(tuning.omega[k], shape.sigma[k], shape.step_s, shape.theta)
                : exact_step(tuning.omega[k], shape.sigma[k], shape.step_s);
        shape.carry[k] = step.carry;
        shape.change[k] = step.change;
        tuning.restoring[k] = step.restoring;
        shape.mobility[k] = step.mobility / shape.linear_density_kg_per_m;
        set_energy_weights(draft, k, step);
    }
}

void write_mode_shapes(const StringShape& shape, double x, double sign, double* row) {
    for (std::size_t k = 0; k < shape.mode_count; ++k) row[k] = sign * mode_shape(k + 1, x, shape.length_m);
}

void append_contact(StringShape& shape, const ContactDescription& contact, const AlignedVector<double>& row) {
    const double sign = contact.side == Side::Below ? 1.0 : -1.0;
    shape.contact_rows.insert(shape.contact_rows.end(), row.begin(), row.end());
    shape.contact_height.push_back(sign * contact.height_m);
    shape.contact_restitution.push_back(contact.restitution);
    shape.contact_position.push_back(contact.position_m);
    shape.contact_side.push_back(contact.side);
    shape.contact_count += 1;
}

/// Rows of the contacts that can move the string; the others are dropped, or refused if they press on it at
/// rest.
std::optional<Failure> set_contacts(StringShape& shape, const StringDescription& string,
                                    const std::string& place) {
    std::vector<AlignedVector<double>> rows(string.contacts.size(), AlignedVector<double>(shape.stride, 0.0));
    std::vector<double> diagonal(string.contacts.size());
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        write_mode_shapes(shape, contact.position_m, contact.side == Side::Below ? 1.0 : -1.0,
                          rows[i].data());
        diagonal[i] = kernels::weighted_square(shape.stride, shape.mobility.data(), 1, rows[i].data(), 0,
                                               rows[i].data());
    }
    const double largest = diagonal.empty() ? 0.0 : *std::max_element(diagonal.begin(), diagonal.end());
    for (std::size_t i = 0; i < string.contacts.size(); ++i) {
        const ContactDescription& contact = string.contacts[i];
        const bool immobile = !(diagonal[i] > negligible_mobility * largest);
        if (!immobile) {
            shape.contact_of_description.push_back(static_cast<std::ptrdiff_t>(shape.contact_count));
            append_contact(shape, contact, rows[i]);
            continue;
        }
        shape.contact_of_description.push_back(-1);
        const bool presses = contact.side == Side::Below ? contact.height_m > 0 : contact.height_m < 0;
        if (presses) {
            return Failure{place + ".contacts[" + std::to_string(i) + "].height_m", printed(contact.height_m),
                           "a height that leaves the string's end at rest, or a position inside the string"};
        }
    }
    return {};
}

/// A gap is the difference of S q and b, neither known to better than half a rounding unit.
void set_gap_rounding(StringShape& shape) {
    double largest = 0;
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        const double* row = shape.contact_rows.data() + c * shape.stride;
        double size = std::abs(shape.contact_height[c]);
        for (std::size_t k = 0; k < shape.mode_count; ++k)
            size += std::abs(row[k] * shape.initial_displacement[k]);
        largest = std::max(largest, size);
    }
    shape.gap_rounding_m = std::numeric_limits<double>::epsilon() / 2 * largest;
}

struct TrueState {
    AlignedVector<double> displacement;
    AlignedVector<double> velocity;
};

TrueState described_state(const StringShape& shape, const InitialCondition& initial) {
    TrueState state{AlignedVector<double>(shape.stride, 0.0), AlignedVector<double>(shape.stride, 0.0)};
    if (const auto* pluck = std::get_if<Pluck>(&initial.shape)) {
        for (std::size_t k = 0; k < shape.mode_count; ++k) {
            state.displacement[k] = pluck_coordinate(k + 1, *pluck, shape.length_m);
        }
    } else if (const auto* modal = std::get_if<ModalState>(&initial.shape)) {
        std::copy(modal->displacement.begin(), modal->displacement.end(), state.displacement.begin());
        std::copy(modal->velocity.begin(), modal->velocity.end(), state.velocity.begin());
    }
    return state;
}

/// A free string has a past in free motion; one that obstacles hold was at rest against them before t = 0.
bool set_initial_state(StringDraft& draft, const InitialCondition& initial) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const TrueState state = described_state(shape, initial);
    const auto held = held_displacement(draft.model, state.displacement);
    const AlignedVector<double> flat(shape.stride, 0.0);
    const auto rest = state.displacement == flat ? held : held_displacement(draft.model, flat);
    if (!held || !rest) return false;
    const bool is_held = std::any_of(held->begin(), held->end(), [](double q) { return q != 0; });
    shape.initial_displacement = state.displacement;
    shape.initial_velocity = state.velocity;
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        if (initial.start == Start::Exact && shape.scheme == Scheme::Exact && !is_held) {
            shape.initial_velocity[k] = exact_backward_velocity(tuning.omega[k], shape.sigma[k], shape.step_s,
                                                                state.displacement[k], state.velocity[k]);
        }
        shape.initial_displacement[k] += (*held)[k];
    }
    shape.rest_displacement = *rest;
    return true;
}

void set_probes(StringShape& shape, const StringDescription& string) {
    shape.probes = string.probes;
    shape.probe_rows.assign(string.probes.size() * shape.stride, 0.0);
    for (std::size_t p = 0; p < string.probes.size(); ++p) {
        const ProbeDescription& probe = string.probes[p];
        if (probe.quantity != Quantity::Displacement && probe.quantity != Quantity::Velocity) continue;
        write_mode_shapes(shape, probe.position_m, 1.0, shape.probe_rows.data() + p * shape.stride);
    }
}

bool coefficients_are_finite(const StringModel& model) {
    const StringShape& shape = *model.shape;
    const StringTuning& tuning = model.tuning;
    for (const auto* array : {&shape.change, &tuning.restoring, &shape.mobility, &tuning.kinetic,
                              &tuning.potential, &shape.initial_displacement, &shape.initial_velocity}) {
        if (!kernels::all_finite(shape.stride, array->data())) return false;
    }
    return std::all_of(shape.sigma.begin(), shape.sigma.end(), [](double sigma) { return sigma >= 0; });
}

Result<StringModel> compile_string(const StringDescription& string, const SceneDescription& scene,
                                   const std::string& place) {
    StringDraft draft;
    set_modes(draft, string);
    set_step(draft, scene);
    if (auto failure = set_contacts(*draft.shape, string, place)) return *failure;
    set_compliance(*draft.shape);
    if (scene.scheme == Scheme::Exact) set_skipping(draft);
    if (!set_initial_state(draft, string.initial)) {
        return Failure{place + ".contacts", "obstacles from both sides",
                       "obstacles between which the string fits"};
    }
    set_gap_rounding(*draft.shape);
    set_probes(*draft.shape, string);
    if (!coefficients_are_finite(draft.model)) {
        return Failure{place + ".modes", "frequencies or losses",
                       "values whose coefficients are finite and whose losses are not negative"};
    }
    return std::move(draft.model);
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
        model.probe_count += string.value().shape->probes.size();
        model.strings.push_back(std::move(string.value()));
    }
    model.steps_per_frame = model.strings.front().shape->steps_per_frame;
    return model;
}

}  // namespace jawari
