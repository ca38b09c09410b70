#include "string/compile/initial_state.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/square.h"
#include "jawari/detail/step_coefficients.h"
#include "jawari/scene/modes.h"
#include "string/compile/places.h"
#include "string/compile/static_equilibrium.h"

namespace jawari {
namespace {

struct TrueState {
    AlignedVector<double> displacement;
    AlignedVector<double> velocity;
};

/// A corner of a function that is linear in pieces: where it jumps, or changes its slope.
struct Corner {
    double position_m = 0;
    double jump = 0;
    double slope_change = 0;
};

std::vector<Corner> corners_of(const std::vector<double>& position, const std::vector<double>& value) {
    std::vector<Corner> corners;
    const auto add = [&](double x, double jump, double slope_change) {
        if (corners.empty() || corners.back().position_m != x) corners.push_back({x, 0, 0});
        corners.back().jump += jump;
        corners.back().slope_change += slope_change;
    };
    add(position.front(), value.front(), 0);
    for (std::size_t i = 0; i + 1 < position.size(); ++i) {
        const double length = position[i + 1] - position[i];
        const double rise = value[i + 1] - value[i];
        if (length == 0) {
            add(position[i], rise, 0);
            continue;
        }
        add(position[i], 0, rise / length);
        add(position[i + 1], 0, -rise / length);
    }
    add(position.back(), -value.back(), 0);
    return corners;
}

/// The integral of the function times phi_k, in parts: sum jump cos(x k pi/L) L/(k pi) - change of slope
/// sin(x k pi/L) (L/(k pi))^2, times sqrt(2/L).
double projection(const std::vector<Corner>& corners, std::size_t k, double length_m) {
    const double wavenumber = static_cast<double>(k) * std::numbers::pi / length_m;
    double sum = 0;
    for (const Corner& corner : corners) {
        sum += (corner.jump * mode_slope(k, corner.position_m, length_m) -
                corner.slope_change * mode_shape(k, corner.position_m, length_m)) /
               square(wavenumber);
    }
    return sum;
}

void project(const std::vector<double>& position, const std::vector<double>& value, double length_m,
             std::size_t modes, AlignedVector<double>& out) {
    if (value.empty()) return;
    const std::vector<Corner> corners = corners_of(position, value);
    for (std::size_t k = 0; k < modes; ++k) out[k] = projection(corners, k + 1, length_m);
}

TrueState state_of_string(const StringShape& shape, const StringDescription& string) {
    TrueState state{AlignedVector<double>(shape.stride, 0.0), AlignedVector<double>(shape.stride, 0.0)};
    const std::size_t own = own_mode_count(shape);
    if (const auto* pluck = std::get_if<Pluck>(&string.initial.shape)) {
        for (std::size_t k = 0; k < own; ++k)
            state.displacement[k] = pluck_coordinate(k + 1, *pluck, shape.length_m);
    } else if (const auto* profile = std::get_if<Profile>(&string.initial.shape)) {
        project(profile->position_m, profile->displacement_m, shape.length_m, own, state.displacement);
        project(profile->position_m, profile->velocity_m_per_s, shape.length_m, own, state.velocity);
    } else if (const auto* modal = std::get_if<ModalState>(&string.initial.shape)) {
        for (const auto& [from, to] : {std::pair{&modal->displacement, &state.displacement},
                                       std::pair{&modal->velocity, &state.velocity}}) {
            for (std::size_t k = 0; k < from->size(); ++k) (*to)[k] = (*from)[k] / shape.coordinate_unit[k];
        }
    }
    return state;
}

/// Hammers are on their way to the rest line.
void add_hammers(const StringShape& shape, const StringDescription& string, TrueState& state) {
    for (std::size_t i = 0; i < string.hammers.size(); ++i) {
        const FlyingHammer& hammer = string.hammers[i];
        const std::size_t mode = hammer_mode(shape, i);
        const double upwards = hammer.side == Side::Below ? 1.0 : -1.0;
        const double velocity = upwards * hammer.velocity_m_per_s / hammer_unit(shape, hammer);
        state.velocity[mode] = velocity;
        state.displacement[mode] = -velocity * hammer.time_s;
    }
}

bool has_free_modes(const StringShape& shape, const StringTuning& tuning) {
    return std::any_of(tuning.omega.begin(),
                       tuning.omega.begin() + static_cast<std::ptrdiff_t>(own_mode_count(shape)),
                       [](double omega) { return omega == 0; });
}

}  // namespace

std::optional<Failure> set_initial_state(StringDraft& draft, const StringDescription& string,
                                         const std::string& place) {
    StringShape& shape = *draft.shape;
    const StringTuning& tuning = draft.model.tuning;
    TrueState state = state_of_string(shape, string);
    add_hammers(shape, string, state);
    const AlignedVector<double> flat(shape.stride, 0.0);
    const auto held = held_displacement(draft.model, state.displacement);
    auto rest = state.displacement == flat ? held : held_displacement(draft.model, flat);
    if (!rest && held && has_free_modes(shape, tuning)) rest = state.displacement;
    if (!held || !rest) {
        return has_free_modes(shape, tuning)
                   ? Failure{place + ".initial", "a start inside an obstacle",
                             "a start clear of all obstacles where modes have frequency 0"}
                   : Failure{place + ".contacts", "obstacles from both sides",
                             "obstacles between which the string fits"};
    }
    const bool is_held = std::any_of(held->begin(), held->end(), [](double q) { return q != 0; });
    shape.initial_displacement = state.displacement;
    shape.initial_velocity = state.velocity;
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        if (string.initial.start == Start::Exact && shape.scheme == Scheme::Exact && !is_held) {
            shape.initial_velocity[k] = exact_backward_velocity(tuning.omega[k], shape.sigma[k], shape.step_s,
                                                                state.displacement[k], state.velocity[k]);
        }
        shape.initial_displacement[k] += (*held)[k];
    }
    shape.rest_displacement = *rest;
    return {};
}

}  // namespace jawari
