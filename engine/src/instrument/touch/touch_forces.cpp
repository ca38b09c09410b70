#include "instrument/touch/touch_forces.h"

#include "base/small_system.h"
#include "instrument/touch/exciters.h"

namespace jawari {
namespace {

/// Compliances among those of `active` with these places in it.
template <std::size_t count>
void set_compliances(const StringModel& model, TouchState& touches, const ActiveForces& active,
                     const std::array<std::size_t, count>& places, std::size_t used) {
    std::array<const double*, count> rows;  // NOLINT(cppcoreguidelines-pro-type-member-init): `used` set
    std::array<double, count * count> compliance;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    for (std::size_t a = 0; a < used; ++a) rows[a] = row_of(touches, active, places[a]);
    // Behind its reach a row is zero.
    kernels::compliances_of(reach_of(model, active), used, model.shape->step_s / 2, model.tuning.flight,
                            rows.data(), compliance.data());
    for (std::size_t a = 0; a < used; ++a) {
        for (std::size_t b = 0; b < used; ++b)
            touches.compliance[active.index[places[a]] * most_forces + active.index[places[b]]] =
                compliance[a * used + b];
    }
}

/// F_i = -(c/T + k/2) (rise_i + sum_j G_ij F_j) - k (w_i - rest_i) + N_i, solved for the F of the touches.
/// With one right side nothing is said of the exciter, with two nothing of the bridge.
template <std::size_t most, std::size_t sides>
TouchAnswer answer_of(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                      const kernels::TouchedRows& paths, std::size_t n) {
    TouchAnswer answer;        // NOLINT(cppcoreguidelines-pro-type-member-init): the first n are set
    SmallSystem<most> system;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    const double per_frame_s = 1 / frame_s(model);
    for (std::size_t a = 0; a < n; ++a) {
        const std::size_t i = active.index[a];
        const Touch& touch = touches.touches[i];
        const double stiffness = touch.share * touch.stiffness_N_per_m;
        const double drag = touch.share * touch.damping_kg_per_s * per_frame_s + stiffness / 2;
        for (std::size_t b = 0; b < n; ++b)
            system.matrix[a][b] =
                (a == b ? 1.0 : 0.0) + drag * touches.compliance[i * most_forces + active.index[b]];
        system.right[a][0] =
            -drag * paths.rise[a] - stiffness * (paths.middle[a] - touch.rest_m) + touch.point.noise_N;
        if (sides >= 2) system.right[a][1] = -drag * touches.compliance[i * most_forces + exciter_index];
        if (sides >= 3) system.right[a][2] = -drag * touches.compliance[i * most_forces + bridge_index];
    }
    solve_small_system<most, sides>(system, n);
    for (std::size_t a = 0; a < n; ++a) {
        answer.alone[a] = system.right[a][0];
        answer.by_exciter[a] = sides >= 2 ? system.right[a][1] : 0.0;
        if (sides >= 3) answer.by_bridge[a] = system.right[a][2];
    }
    return answer;
}

/// With as many unknowns as there are touches, so that the loops over them unroll: most often a hand's two.
template <std::size_t sides>
TouchAnswer answer_of_touches(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                              const kernels::TouchedRows& paths) {
    switch (active.touches) {
        case 0:
            return TouchAnswer();
        case 1:
            return answer_of<1, sides>(model, touches, active, paths, 1);
        case 2:
            return answer_of<2, sides>(model, touches, active, paths, 2);
        case 3:
            return answer_of<3, sides>(model, touches, active, paths, 3);
        default:
            return answer_of<touch_slots, sides>(model, touches, active, paths, active.touches);
    }
}

/// How the exciter's point moves: by `rise` without its force, and by `give` per newton of it.
StringAtExciter string_at_exciter(const StringModel& model, const TouchState& touches,
                                  const ActiveForces& active, const kernels::TouchedRows& paths,
                                  const TouchAnswer& answer) {
    StringAtExciter at;
    at.frame_s = frame_s(model);
    at.displacement_m = paths.middle[active.touches];
    at.rise_m = paths.rise[active.touches];
    at.give_m_per_N = touches.compliance[exciter_index * most_forces + exciter_index];
    for (std::size_t a = 0; a < active.touches; ++a) {
        const double g = touches.compliance[exciter_index * most_forces + active.index[a]];
        at.rise_m += g * answer.alone[a];
        at.give_m_per_N += g * answer.by_exciter[a];
    }
    return at;
}

}  // namespace

TouchAnswer answer_to_bridge(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                             const kernels::TouchedRows& paths) JAWARI_REALTIME {
    return answer_of_touches<3>(model, touches, active, paths);
}

/// G_ij = sum_k phi_i (q_held - h v_held/2) phi_j
void set_compliance_of_touches(const StringModel& model, TouchState& touches,
                               const ActiveForces& active) JAWARI_REALTIME {
    touches.outdated = false;
    if (active.count <= kernels::most_compliant_rows) {
        set_compliances<kernels::most_compliant_rows>(model, touches, active, {0, 1, 2, 3}, active.count);
        return;
    }
    for (std::size_t a = 1; a < active.count; ++a) {
        for (std::size_t b = 0; b < a; ++b) set_compliances<2>(model, touches, active, {b, a}, 2);
    }
}

HeldForces solve_forces(const StringModel& model, TouchState& touches, const ActiveForces& active,
                        const kernels::TouchedRows& paths) JAWARI_REALTIME {
    HeldForces held;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    const TouchAnswer answer = excites(active) ? answer_of_touches<2>(model, touches, active, paths)
                                               : answer_of_touches<1>(model, touches, active, paths);
    double exciter_N = 0;
    if (excites(active)) {
        exciter_N = exciter_force(string_at_exciter(model, touches, active, paths, answer), touches.exciter);
        held.force_N[active.touches] = exciter_N;
    }
    for (std::size_t a = 0; a < active.touches; ++a)
        held.force_N[a] = answer.alone[a] + answer.by_exciter[a] * exciter_N;
    for (std::size_t a = 0; a < active.count; ++a) held.any = held.any || held.force_N[a] != 0;
    held.passive = exciter_N == 0 && !active.sprung && !active.noisy;
    return held;
}

}  // namespace jawari
