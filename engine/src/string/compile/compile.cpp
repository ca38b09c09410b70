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
#include "string/compile/drives.h"
#include "string/compile/initial_state.h"
#include "string/compile/places.h"
#include "string/compile/probes.h"
#include "string/compile/string_draft.h"
#include "string/compile/validate.h"
#include "string/kernels/mode_sums.h"
#include "string/model/compliant_law.h"

namespace jawari {
namespace {

/// Below this share of the largest Delassus diagonal a contact cannot move the string (it sits on an end).
constexpr double negligible_mobility = 1e-12;

/// With a ShapeTable the engine's coordinates are q_k sqrt(M_k) and its mass is 1 kg/m on a length of 1 m.
void set_modes(StringDraft& draft, const StringDescription& string) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const Modes modes = modes_of(string);
    shape.name = string.name;
    shape.length_m = string.shapes ? 1 : string.length_m;
    shape.linear_density_kg_per_m = string.shapes ? 1 : string.linear_density_kg_per_m;
    shape.hammer_count = string.hammers.size();
    shape.mode_count = modes.omega.size() + shape.hammer_count;
    shape.stride = padded(shape.mode_count);
    tuning.omega.assign(shape.stride, 0.0);
    shape.sigma.assign(shape.stride, 0.0);
    shape.coordinate_unit.assign(shape.stride, 1.0);
    std::copy(modes.omega.begin(), modes.omega.end(), tuning.omega.begin());
    std::copy(modes.sigma.begin(), modes.sigma.end(), shape.sigma.begin());
    if (!string.shapes) return;
    for (std::size_t k = 0; k < modes.omega.size(); ++k)
        shape.coordinate_unit[k] = 1 / std::sqrt(string.shapes->modal_mass_kg[k]);
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

void append_contact(StringShape& shape, const ContactDescription& contact, const AlignedVector<double>& row) {
    const double sign = contact.side == Side::Below ? 1.0 : -1.0;
    shape.contact_rows.insert(shape.contact_rows.end(), row.begin(), row.end());
    shape.contact_height.push_back(sign * contact.height_m);
    shape.contact_restitution.push_back(contact.restitution);
    shape.contact_position.push_back(contact.position_m);
    shape.contact_side.push_back(contact.side);
    shape.contact_compliance.push_back(contact.compliance.value_or(Compliance{}));
    shape.has_dashpots = shape.has_dashpots || shape.contact_compliance.back().resistance_kg_per_s > 0;
    shape.contact_count += 1;
}

/// The gap of a hammer is that between the string and the hammer.
AlignedVector<double> row_of(const StringShape& shape, const StringDescription& string,
                             const ContactPlace& place) {
    AlignedVector<double> row(shape.stride, 0.0);
    const double sign = place.contact.side == Side::Below ? 1.0 : -1.0;
    write_shape(shape, string, place.contact.position_m, place.contact.point, sign, row.data());
    if (place.hammer)
        row[hammer_mode(shape, *place.hammer)] = -sign * hammer_unit(shape, string.hammers[*place.hammer]);
    return row;
}

/// What the contact has become in the model: its index there, or -1.
void note_contact(StringShape& shape, const ContactPlace& place, std::size_t index, std::size_t described,
                  std::ptrdiff_t kept) {
    if (index < described) shape.contact_of_description.push_back(kept);
    if (place.hammer) shape.contact_of_hammer.push_back(kept);
}

/// Rows of the contacts that can move the string; the others are dropped, or refused if they press on it at
/// rest.
std::optional<Failure> set_contacts(StringShape& shape, const StringDescription& string,
                                    const std::string& place) {
    const std::vector<ContactPlace> places = contact_places(string);
    std::vector<AlignedVector<double>> rows;
    std::vector<double> diagonal;
    double largest = 0;
    for (const ContactPlace& each : places) {
        rows.push_back(row_of(shape, string, each));
        diagonal.push_back(kernels::weighted_square(shape.stride, shape.mobility.data(), 1,
                                                    rows.back().data(), 0, rows.back().data()));
        largest = std::max(largest, diagonal.back());
    }
    const std::size_t described = string.contacts.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ContactDescription& contact = places[i].contact;
        const bool immobile = !(diagonal[i] > negligible_mobility * largest);
        if (!immobile) {
            note_contact(shape, places[i], i, described, static_cast<std::ptrdiff_t>(shape.contact_count));
            append_contact(shape, contact, rows[i]);
            continue;
        }
        note_contact(shape, places[i], i, described, -1);
        const bool presses = contact.side == Side::Below ? contact.height_m > 0 : contact.height_m < 0;
        if (i < described && presses) {
            return Failure{place + ".contacts[" + std::to_string(i) + "].height_m", printed(contact.height_m),
                           "a height that leaves the string's end at rest, or a position inside the string"};
        }
    }
    if (std::all_of(shape.contact_compliance.begin(), shape.contact_compliance.end(), is_rigid))
        shape.contact_compliance.clear();
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
    if (auto failure = set_initial_state(draft, string, place)) return *failure;
    set_gap_rounding(*draft.shape);
    set_drives(*draft.shape, string);
    set_probes(draft, string);
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
