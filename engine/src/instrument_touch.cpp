#include "instrument_touch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "excitation.h"
#include "instrument_exciter.h"
#include "instrument_kernels.h"
#include "kernels.h"
#include "small_system.h"

namespace jawari {
namespace {

constexpr std::size_t forces = touch_slots + 1;
constexpr std::size_t exciter_index = touch_slots;
/// Touches do not reach modes above this.
constexpr double touch_limit_hz = 12000;
/// Share of the way to its new pressure that a touch goes in a frame.
constexpr double pressure_follow = 0.01;
/// A sweeping touch takes this long to and fro, and is moved every so many frames.
constexpr double sweep_period_s = 0.04;
constexpr std::uint64_t sweep_frames = 4;

double frame_s(const StringModel& model) {
    return model.step_s * static_cast<double>(model.steps_per_frame);
}

double dot(std::size_t modes, const double* a, const double* b) {
    double sum = 0;
    kernels::row_products(1, modes, modes, a, b, &sum);
    return sum;
}

/// Flesh and felt damp what is heard; modes far beyond die by themselves and need not be woken.
std::size_t modes_in_reach(const StringModel& model) {
    const auto end = model.omega.begin() + static_cast<std::ptrdiff_t>(model.mode_count);
    const auto first_beyond =
        std::upper_bound(model.omega.begin(), end, 2 * std::numbers::pi * touch_limit_hz);
    return padded(static_cast<std::size_t>(first_beyond - model.omega.begin()));
}

/// The touches and, if it acts, the exciter.
struct ActiveForces {
    std::array<std::size_t, forces> index{};
    std::size_t count = 0;
    std::size_t touches = 0;  ///< those in front
    std::size_t modes = 0;    ///< that any of them reaches
};

const AlignedVector<double>& row_of(const TouchState& touches, std::size_t i) {
    return i == exciter_index ? touches.exciter.row : touches.touches[i].row;
}

std::size_t modes_of(const StringModel& model, const TouchState& touches, std::size_t i) {
    return i == exciter_index ? model.stride : touches.touches[i].modes;
}

ActiveForces active_forces(const StringModel& model, const TouchState& touches) {
    ActiveForces active;
    for (std::size_t i = 0; i < touch_slots; ++i) {
        if (!touches.touches[i].active) continue;
        active.index[active.count++] = i;
        active.modes = std::max(active.modes, touches.touches[i].modes);
    }
    active.touches = active.count;
    if (touches.exciter.phase == ExciterPhase::None) return active;
    active.index[active.count++] = exciter_index;
    active.modes = model.stride;
    return active;
}

/// middle <- q - h v/2, rise <- its change over the frame in free flight.
void set_free_path(const StringModel& model, const StringState& string, TouchState& touches,
                   std::size_t modes) {
    kernels::free_path(modes, model.step_s / 2, model.flight, string.displacement.data(),
                       string.velocity.data(), touches.middle.data(), touches.rise.data());
}

/// G_ij = sum_k phi_i (q_held - h v_held/2) phi_j; rise is free to use.
void set_compliance_of_touches(const StringModel& model, TouchState& touches, const ActiveForces& active) {
    const double lag = model.step_s / 2;
    for (std::size_t a = 0; a < active.count; ++a) {
        const std::size_t i = active.index[a];
        const std::size_t modes = modes_of(model, touches, i);
        const double* row = row_of(touches, i).data();
        double* moved = touches.rise.data();
        kernels::moved_by_held(modes, lag, model.flight, row, moved);
        for (std::size_t b = 0; b <= a; ++b) {
            const std::size_t j = active.index[b];
            const double g =
                dot(std::min(modes, modes_of(model, touches, j)), row_of(touches, j).data(), moved);
            touches.compliance[i * forces + j] = g;
            touches.compliance[j * forces + i] = g;
        }
    }
    touches.outdated = false;
}

/// What the touches answer: force_i = alone_i + by_exciter_i F_exciter.
struct TouchAnswer {
    std::array<double, touch_slots> alone{};
    std::array<double, touch_slots> by_exciter{};
};

/// F_i = -(c/T + k/2) (rise_i + sum_j G_ij F_j) - k (w_i - rest_i), solved for the F of the touches.
TouchAnswer answer_of_touches(const StringModel& model, const TouchState& touches,
                              const ActiveForces& active) {
    TouchAnswer answer;
    SmallSystem<touch_slots> system;
    const std::size_t n = active.touches;
    for (std::size_t a = 0; a < n; ++a) {
        const std::size_t i = active.index[a];
        const Touch& touch = touches.touches[i];
        const double stiffness = touch.share * touch.stiffness_N_per_m;
        const double drag = touch.share * touch.damping_kg_per_s / frame_s(model) + stiffness / 2;
        for (std::size_t b = 0; b < n; ++b)
            system.matrix[a][b] =
                (a == b ? 1.0 : 0.0) + drag * touches.compliance[i * forces + active.index[b]];
        system.right[a][0] = -drag * dot(touch.modes, touch.row.data(), touches.rise.data());
        if (stiffness > 0) {
            const double w = dot(touch.modes, touch.row.data(), touches.middle.data());
            system.right[a][0] -= stiffness * (w - touch.rest_m);
        }
        system.right[a][1] = -drag * touches.compliance[i * forces + exciter_index];
    }
    solve_small_system(system, n);
    for (std::size_t a = 0; a < n; ++a) {
        answer.alone[a] = system.right[a][0];
        answer.by_exciter[a] = system.right[a][1];
    }
    return answer;
}

/// How the exciter's point moves: by `rise` without its force, and by `give` per newton of it.
StringAtExciter string_at_exciter(const StringModel& model, const TouchState& touches,
                                  const ActiveForces& active, const TouchAnswer& answer) {
    StringAtExciter at;
    const double* row = touches.exciter.row.data();
    at.frame_s = frame_s(model);
    at.displacement_m = dot(model.stride, row, touches.middle.data());
    at.rise_m = dot(model.stride, row, touches.rise.data());
    at.give_m_per_N = touches.compliance[exciter_index * forces + exciter_index];
    for (std::size_t a = 0; a < active.touches; ++a) {
        const double g = touches.compliance[exciter_index * forces + active.index[a]];
        at.rise_m += g * answer.alone[a];
        at.give_m_per_N += g * answer.by_exciter[a];
    }
    return at;
}

void leave(Touch& touch) {
    touch.share_rate = -std::abs(touch.share_rate);
}

/// Where the touch has lain since its row was written last.
double place_of(const StringModel& model, const Touch& touch) {
    if (touch.sweep_m == 0 || touch.age == 0) return touch.x_m;
    const std::uint64_t written = (touch.age - 1) / sweep_frames * sweep_frames + 1;
    const double turns = static_cast<double>(written) * frame_s(model) / sweep_period_s;
    return touch.x_m + touch.sweep_m * std::sin(2 * std::numbers::pi * turns);
}

void sweep_touches(const StringModel& model, TouchState& touches) {
    for (Touch& touch : touches.touches) {
        if (!touch.active || touch.sweep_m == 0) continue;
        if (touch.age++ % sweep_frames != 0) continue;
        write_point_row(model, touch.modes, place_of(model, touch), touch.width_m, touch.row.data());
        touches.outdated = true;
    }
}

/// Touches come, follow the pressure, and leave.
void move_touches(TouchState& touches) {
    for (Touch& touch : touches.touches) {
        if (!touch.active) continue;
        touch.damping_kg_per_s += pressure_follow * (touch.pressed_kg_per_s - touch.damping_kg_per_s);
        touch.share = std::min(1.0, touch.share + touch.share_rate);
        if (touch.share <= 0) touch.active = false;
        if (touch.frames_left == 0) continue;
        touch.frames_left -= 1;
        if (touch.frames_left == 0) leave(touch);
    }
}

}  // namespace

TouchState make_touch_state(std::size_t stride) {
    TouchState touches;
    for (Touch& touch : touches.touches) touch.row.assign(stride, 0.0);
    touches.exciter.row.assign(stride, 0.0);
    touches.middle.assign(stride, 0.0);
    touches.rise.assign(stride, 0.0);
    return touches;
}

void lift_all_touches(TouchState& touches) JAWARI_REALTIME {
    for (Touch& touch : touches.touches) touch.active = false;
    touches.exciter.phase = ExciterPhase::None;
    touches.outdated = true;
}

void lay_touch(const StringModel& model, const StringState& string, TouchState& touches, TouchSlot slot,
               const TouchPlan& plan) JAWARI_REALTIME {
    Touch& touch = touch_at(touches, slot);
    const bool eases = plan.ease_frames > 0;
    if (!touch.active) touch.share = eases ? 0.0 : 1.0;
    touch.share_rate = eases ? 1 / plan.ease_frames : 1.0;
    touch.active = true;
    touch.damping_kg_per_s = plan.damping_kg_per_s;
    touch.pressed_kg_per_s = plan.damping_kg_per_s;
    touch.stiffness_N_per_m = plan.stiffness_N_per_m;
    touch.frames_left = plan.frames;
    touch.x_m = plan.x_m;
    touch.width_m = plan.width_m;
    touch.sweep_m = plan.sweep_m;
    touch.age = 0;
    touches.outdated = true;
    touch.modes = modes_in_reach(model);
    write_point_row(model, touch.modes, plan.x_m, plan.width_m, touch.row.data());
    touch.rest_m = dot(touch.modes, touch.row.data(), string.displacement.data()) -
                   model.step_s / 2 * dot(touch.modes, touch.row.data(), string.velocity.data());
}

void press_touch(TouchState& touches, TouchSlot slot, double damping_kg_per_s) JAWARI_REALTIME {
    Touch& touch = touch_at(touches, slot);
    touch.pressed_kg_per_s = damping_kg_per_s;
    touch.share_rate = std::abs(touch.share_rate);
}

void lift_touch(TouchState& touches, TouchSlot slot) JAWARI_REALTIME {
    leave(touch_at(touches, slot));
}

void apply_touches(const StringModel& model, StringState& string, TouchState& touches) JAWARI_REALTIME {
    clear_excitation(string);
    move_touches(touches);
    for (Touch& touch : touches.touches) touch.force_N = 0;
    touches.exciter.force_N = 0;
    const ActiveForces active = active_forces(model, touches);
    const bool excites = active.count > active.touches;
    if (active.count == 0 || (string.asleep && !excites)) return;
    sweep_touches(model, touches);
    if (touches.outdated) set_compliance_of_touches(model, touches, active);
    set_free_path(model, string, touches, active.modes);
    const TouchAnswer answer = answer_of_touches(model, touches, active);
    double force_N = 0;
    if (excites) {
        force_N = exciter_force(string_at_exciter(model, touches, active, answer), touches.exciter);
        touches.exciter.force_N = force_N;
        if (force_N != 0) add_force(string, touches.exciter.row.data(), model.stride, force_N);
    }
    for (std::size_t a = 0; a < active.touches; ++a) {
        Touch& touch = touches.touches[active.index[a]];
        touch.force_N = answer.alone[a] + answer.by_exciter[a] * force_N;
        if (touch.force_N != 0) add_force(string, touch.row.data(), touch.modes, touch.force_N);
    }
}

void rewrite_touches(const StringModel& model, TouchState& touches, std::size_t kept) JAWARI_REALTIME {
    for (Touch& touch : touches.touches) {
        if (!touch.active) continue;
        touch.modes = modes_in_reach(model);
        write_point_row(model, touch.modes, place_of(model, touch), touch.width_m, touch.row.data());
    }
    // An exciter acts for milliseconds: modes that come in meanwhile do not feel it.
    AlignedVector<double>& row = touches.exciter.row;
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(kept), row.end(), 0.0);
    touches.outdated = true;
}

void meter_touches(const StringModel& model, const StringState& string, TouchState& touches,
                   PlayerWork& work) JAWARI_REALTIME {
    if (!string.excitation.active) return;
    const double lag = model.step_s / 2;
    double* path = touches.rise.data();
    kernels::path_since(string.excitation.modes, lag, string.displacement.data(), string.velocity.data(),
                        touches.middle.data(), path);
    for (const Touch& touch : touches.touches) {
        if (touch.force_N == 0) continue;
        work.touches_J += touch.force_N * dot(touch.modes, touch.row.data(), path);
    }
    const ExciterState& exciter = touches.exciter;
    if (exciter.force_N != 0)
        work.exciters_J += exciter.force_N * dot(model.stride, exciter.row.data(), path);
}

void write_point_row(const StringModel& model, std::size_t modes, double x, double width_m,
                     double* row) JAWARI_REALTIME {
    const std::size_t count = std::min(modes, model.mode_count);
    const double L = model.length_m;
    kernels::point_row(
        modes, {std::sqrt(2 / L), std::numbers::pi * x / L, std::numbers::pi * width_m / (2 * L)}, row);
    std::fill(row + count, row + modes, 0.0);
}

}  // namespace jawari
