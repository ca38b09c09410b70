#include "instrument/touch/bridge_end.h"

#include <algorithm>
#include <cmath>

#include "instrument/touch/exciters.h"
#include "instrument/touch/touch_forces.h"
#include "instrument/touch/touch_frame.h"
#include "instrument/touch/touches.h"
#include "string/frame/frame.h"
#include "string/kernels/mode_sums.h"
#include "string/kernels/touched_flight.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// G_ij between the a-th force and the force of this index.
double compliance_of(const TouchState& touches, const ActiveForces& active, std::size_t a,
                     std::size_t index) {
    return touches.compliance[active.index[a] * most_forces + index];
}

/// How the place of index `to` moves with the bridge's displacement, what touches answer to that included.
double given_by_bridge(const TouchState& touches, const BridgeEndFrame& frame, std::size_t to) {
    double sum = touches.compliance[to * most_forces + bridge_index];
    for (std::size_t a = 0; a < frame.active.touches; ++a)
        sum += compliance_of(touches, frame.active, a, to) * frame.answer.by_bridge[a];
    return sum;
}

/// The same per newton of the exciter.
double given_by_exciter(const TouchState& touches, const BridgeEndFrame& frame, std::size_t to) {
    double sum = touches.compliance[to * most_forces + exciter_index];
    for (std::size_t a = 0; a < frame.active.touches; ++a)
        sum += compliance_of(touches, frame.active, a, to) * frame.answer.by_exciter[a];
    return sum;
}

/// The same in free flight with what touches do by themselves.
double rise_alone(const TouchState& touches, const BridgeEndFrame& frame, std::size_t place) {
    double sum = frame.paths.rise[place];
    const std::size_t to = frame.active.index[place];
    for (std::size_t a = 0; a < frame.active.touches; ++a)
        sum += compliance_of(touches, frame.active, a, to) * frame.answer.alone[a];
    return sum;
}

std::size_t place_of_bridge(const BridgeEndFrame& frame) {
    return frame.active.count - 1;
}

HeldForces forces_of(const BridgeEndFrame& frame, double zeta_m) {
    HeldForces held;  // NOLINT(cppcoreguidelines-pro-type-member-init): one force per force that acts
    for (std::size_t a = 0; a < frame.active.touches; ++a) {
        held.force_N[a] = frame.answer.alone[a] + frame.answer.by_bridge[a] * zeta_m;
        if (frame.active.excited) held.force_N[a] += frame.answer.by_exciter[a] * frame.exciter_N;
    }
    if (frame.active.excited) held.force_N[frame.active.touches] = frame.exciter_N;
    held.force_N[place_of_bridge(frame)] = zeta_m;
    return held;
}

/// What the forces may do to a string over obstacles; of exciters and springs nothing is known.
FrameBounds bounds_of(const BridgeEndModel& end, const BridgeEndFrame& frame, const HeldForces& held) {
    FrameBounds bounds;
    if (frame.active.excited || frame.active.sprung || frame.active.noisy || end.root < 0) return bounds;
    const double zeta_m = std::abs(held.force_N[place_of_bridge(frame)]);
    bounds.root = end.root * zeta_m;
    bounds.strength_N = end.strength * zeta_m;
    for (std::size_t a = 0; a < frame.active.touches; ++a) bounds.strength_N += std::abs(held.force_N[a]);
    return bounds;
}

/// The frame in one sweep, where nothing can be struck; what the rows do next is known from then on, unless
/// something is about to move them. Returns whether it was flown.
bool fly_on_bridge(const StringModel& model, StringState& string, TouchState& touches,
                   const BridgeEndModel& end, const BridgeEndFrame& frame, const HeldForces& held) {
    const ActiveForces& active = frame.active;
    if (active.count > kernels::most_flight_forces) return false;
    clear_excitation(string);
    FrameBounds bounds;
    if (!flies_always(model, string)) {
        bounds = bounds_of(end, frame, held);
        if (bounds.root < 0 || !flies_clear(model, string, bounds.strength_N, bounds.root)) return false;
    }
    kernels::TouchedFlight flight;  // NOLINT(cppcoreguidelines-pro-type-member-init): `count` are set
    flight.count = active.count;
    std::copy_n(frame.paths.row.begin(), active.count, flight.row.begin());
    std::copy_n(held.force_N.begin(), active.count, flight.force_N.begin());
    flight.read_row = end.row;
    flight.looks_ahead = !will_sweep(touches, active);
    const std::uint64_t resets = string.counters.nonfinite_resets;
    cross_touched_frame(model, string, flight, reach_of(model, active), false, bounds);
    if (!flight.looks_ahead || string.counters.nonfinite_resets != resets) return true;
    touches.known.count = active.count;
    touches.known_frame = string.frame;
    std::copy_n(flight.middle.begin(), active.count, touches.known.middle.begin());
    std::copy_n(flight.rise.begin(), active.count, touches.known.rise.begin());
    return true;
}

/// TouchState::known with the rows as they lie in this state: of a copy they lie elsewhere.
kernels::TouchedRows known_paths(const TouchState& touches, const ActiveForces& active) {
    kernels::TouchedRows paths = touches.known;
    for (std::size_t a = 0; a < active.count; ++a) paths.row[a] = row_of(touches, active, a);
    return paths;
}

}  // namespace

void begin_end_frame(const StringModel& model, const StringState& string, TouchState& touches,
                     const BridgeEndModel& end, BridgeEndFrame& frame) JAWARI_REALTIME {
    frame.active = move_touches(touches);
    ActiveForces& active = frame.active;
    active.bridge = end.row;
    active.index[active.count++] = bridge_index;
    sweep_touches(model, touches, active);
    if (active.noisy) make_noises(model, touches, active);
    const bool known =
        !touches.outdated && touches.known.count == active.count && touches.known_frame == string.frame;
    if (touches.outdated) set_compliance_of_touches(model, touches, active);
    frame.paths = known ? known_paths(touches, active) : paths_of_all(model, string, touches, active);
    touches.known.count = 0;
    frame.answer = answer_to_bridge(model, touches, active, frame.paths);
    const std::size_t bridge = place_of_bridge(frame);
    frame.start_N = frame.paths.middle[bridge] - end.rest_N;
    frame.force_N = frame.start_N + rise_alone(touches, frame, bridge) / 2;
    frame.stiffness_N_per_m = end.stiffness_N_per_m - given_by_bridge(touches, frame, bridge_index) / 2;
    frame.by_exciter = active.excited ? given_by_exciter(touches, frame, bridge_index) / 2 : 0.0;
    frame.exciter_N = 0;
}

double strike_on_bridge(const StringModel& model, TouchState& touches, const BridgeEndFrame& frame,
                        double zeta_m, double zeta_per_N) JAWARI_REALTIME {
    const std::size_t place = frame.active.touches;
    const double by_bridge = given_by_bridge(touches, frame, exciter_index);
    StringAtExciter at;
    at.frame_s = frame_s(model);
    at.displacement_m = frame.paths.middle[place];
    at.rise_m = rise_alone(touches, frame, place) + by_bridge * zeta_m;
    at.give_m_per_N = given_by_exciter(touches, frame, exciter_index) + by_bridge * zeta_per_N;
    return exciter_force(at, touches.exciter);
}

EndForce end_end_frame(const StringModel& model, StringState& string, TouchState& touches,
                       const BridgeEndModel& end, const BridgeEndFrame& frame, double zeta_m,
                       PlayerWork& work) JAWARI_REALTIME {
    const HeldForces held = forces_of(frame, zeta_m);
    bool struck = false;
    if (fly_on_bridge(model, string, touches, end, frame, held)) {
        meter_flight(touches, frame.active, frame.paths, held.force_N, work);
    } else {
        note_paths(touches, frame.active, frame.paths, held.force_N);
        hold(model, string, frame.active, frame.paths, held);
        const std::uint64_t impulses = string.counters.impulses;
        advance_frame(model, string);
        struck = string.counters.impulses != impulses;
        meter_touches(model, string, touches, struck, work);
    }
    EndForce force;
    force.expected_N =
        frame.start_N + path_under(touches, frame.active, frame.paths, held.force_N, place_of_bridge(frame));
    force.force_N = struck ? end_force(model, string, end) : force.expected_N;
    return force;
}

double end_force(const StringModel& model, const StringState& string,
                 const BridgeEndModel& end) JAWARI_REALTIME {
    const std::size_t modes = string.active_modes;
    return kernels::row_product(modes, end.row, string.displacement.data()) -
           model.shape->step_s / 2 * kernels::row_product(modes, end.row, string.velocity.data()) -
           end.rest_N;
}

}  // namespace jawari
