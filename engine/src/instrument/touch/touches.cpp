#include "instrument/touch/touches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/small_system.h"
#include "instrument/touch/exciters.h"
#include "instrument/touch/touch_kernels.h"
#include "string/kernels/mode_sums.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

constexpr std::size_t forces = touch_slots + 1;
constexpr std::size_t exciter_index = touch_slots;
/// Touches do not reach modes above this.
constexpr double touch_limit_hz = 12000;
/// Share of the way to its new pressure that a touch goes in a frame.
constexpr double pressure_follow = 0.01;
/// A sweeping touch takes this long to and fro, and is moved every so many frames. Each move is a small step
/// of force: every second frame they are at half the output rate, where no body radiates; every fourth they
/// were heard at 12 kHz.
constexpr double sweep_period_s = 0.04;
constexpr std::uint64_t sweep_frames = 2;

double frame_s(const StringModel& model) {
    return model.shape->step_s * static_cast<double>(model.shape->steps_per_frame);
}

/// Flesh and felt damp what is heard; modes far beyond die by themselves and need not be woken.
std::size_t modes_in_reach(const StringModel& model) {
    const auto end = model.tuning.omega.begin() + static_cast<std::ptrdiff_t>(model.shape->mode_count);
    const auto first_beyond =
        std::upper_bound(model.tuning.omega.begin(), end, 2 * std::numbers::pi * touch_limit_hz);
    return padded(static_cast<std::size_t>(first_beyond - model.tuning.omega.begin()));
}

/// Behind its reach the row is zero, so that touches of different reach can be summed together.
void set_reach(const StringModel& model, Touch& touch) {
    touch.modes = modes_in_reach(model);
    std::fill(touch.row.begin() + static_cast<std::ptrdiff_t>(touch.modes), touch.row.end(), 0.0);
}

// Of the arrays in the structures below only the first entries, one per force that acts, are ever set or
// read: this runs for every voice in every frame, and clearing them takes a tenth of its time.

/// The touches and, if it acts, the exciter.
struct ActiveForces {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<std::size_t, forces> index;
    std::size_t count = 0;
    std::size_t touches = 0;        ///< those in front
    std::size_t touched_modes = 0;  ///< that any of them reaches
    bool sprung = false;            ///< one of them has a spring
    bool noisy = false;             ///< one of them makes a noise
};

const AlignedVector<double>& row_of(const TouchState& touches, std::size_t i) {
    return i == exciter_index ? touches.exciter.row : touches.touches[i].row;
}

std::size_t modes_of(const StringModel& model, const TouchState& touches, std::size_t i) {
    return i == exciter_index ? model.shape->stride : touches.touches[i].modes;
}

/// w = phi (q - h v/2) under each force at the frame's start, and its change over the frame in free flight.
kernels::TouchedRows free_paths(const StringModel& model, const StringState& string,
                                const TouchState& touches, const ActiveForces& active) {
    kernels::TouchedRows rows;  // NOLINT(cppcoreguidelines-pro-type-member-init): `count` entries are set
    rows.count = active.count;
    for (std::size_t a = 0; a < active.count; ++a) rows.row[a] = row_of(touches, active.index[a]).data();
    const double lag = model.shape->step_s / 2;
    const double *q = string.displacement.data(), *v = string.velocity.data();
    kernels::free_paths(0, active.touched_modes, lag, model.tuning.flight, q, v, rows);
    if (active.count == active.touches) return rows;
    kernels::TouchedRows beyond;  // NOLINT(cppcoreguidelines-pro-type-member-init): one entry is set
    beyond.count = 1;             // what only the exciter reaches
    beyond.row[0] = touches.exciter.row.data();
    kernels::free_paths(active.touched_modes, model.shape->stride, lag, model.tuning.flight, q, v, beyond);
    rows.middle[active.touches] += beyond.middle[0];
    rows.rise[active.touches] += beyond.rise[0];
    return rows;
}

/// G_ij = sum_k phi_i (q_held - h v_held/2) phi_j; `moved` is scratch.
void set_compliance_of_touches(const StringModel& model, TouchState& touches, const ActiveForces& active) {
    const double lag = model.shape->step_s / 2;
    for (std::size_t a = 0; a < active.count; ++a) {
        const std::size_t i = active.index[a];
        const std::size_t modes = modes_of(model, touches, i);
        const double* row = row_of(touches, i).data();
        double* moved = touches.moved.data();
        kernels::moved_by_held(modes, lag, model.tuning.flight, row, moved);
        for (std::size_t b = 0; b <= a; ++b) {
            const std::size_t j = active.index[b];
            const double g = kernels::row_product(std::min(modes, modes_of(model, touches, j)),
                                                  row_of(touches, j).data(), moved);
            touches.compliance[i * forces + j] = g;
            touches.compliance[j * forces + i] = g;
        }
    }
    touches.outdated = false;
}

/// What the touches answer: force_i = alone_i + by_exciter_i F_exciter.
struct TouchAnswer {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<double, touch_slots> alone;
    std::array<double, touch_slots> by_exciter;
};

/// F_i = -(c/T + k/2) (rise_i + sum_j G_ij F_j) - k (w_i - rest_i) + N_i, solved for the F of the touches.
/// With one right side nothing is said of the exciter.
template <std::size_t most, std::size_t sides>
TouchAnswer answer_of(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                      const kernels::TouchedRows& paths) {
    TouchAnswer answer;        // NOLINT(cppcoreguidelines-pro-type-member-init): the first n are set
    SmallSystem<most> system;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    const std::size_t n = active.touches;
    const double per_frame_s = 1 / frame_s(model);
    for (std::size_t a = 0; a < n; ++a) {
        const std::size_t i = active.index[a];
        const Touch& touch = touches.touches[i];
        const double stiffness = touch.share * touch.stiffness_N_per_m;
        const double drag = touch.share * touch.damping_kg_per_s * per_frame_s + stiffness / 2;
        for (std::size_t b = 0; b < n; ++b)
            system.matrix[a][b] =
                (a == b ? 1.0 : 0.0) + drag * touches.compliance[i * forces + active.index[b]];
        system.right[a][0] =
            -drag * paths.rise[a] - stiffness * (paths.middle[a] - touch.rest_m) + touch.point.noise_N;
        if (sides == 2) system.right[a][1] = -drag * touches.compliance[i * forces + exciter_index];
    }
    solve_small_system<most, sides>(system, n);
    for (std::size_t a = 0; a < n; ++a) {
        answer.alone[a] = system.right[a][0];
        answer.by_exciter[a] = sides == 2 ? system.right[a][1] : 0.0;
    }
    return answer;
}

/// A hand has two places: most often there are no more touches.
template <std::size_t sides>
TouchAnswer answer_of_touches(const StringModel& model, const TouchState& touches, const ActiveForces& active,
                              const kernels::TouchedRows& paths) {
    if (active.touches <= 2) return answer_of<2, sides>(model, touches, active, paths);
    return active.touches <= 4 ? answer_of<4, sides>(model, touches, active, paths)
                               : answer_of<touch_slots, sides>(model, touches, active, paths);
}

/// How the exciter's point moves: by `rise` without its force, and by `give` per newton of it.
StringAtExciter string_at_exciter(const StringModel& model, const TouchState& touches,
                                  const ActiveForces& active, const kernels::TouchedRows& paths,
                                  const TouchAnswer& answer) {
    StringAtExciter at;
    at.frame_s = frame_s(model);
    at.displacement_m = paths.middle[active.touches];
    at.rise_m = paths.rise[active.touches];
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

void sweep_touches(const StringModel& model, TouchState& touches, const ActiveForces& active) {
    for (std::size_t a = 0; a < active.touches; ++a) {
        Touch& touch = touches.touches[active.index[a]];
        if (touch.sweep_m == 0) continue;
        if (touch.age++ % sweep_frames != 0) continue;
        write_point_row(model, touch.modes, place_of(model, touch), touch.width_m, touch.row.data());
        touches.outdated = true;
    }
}

/// The touch comes, follows the pressure, and leaves.
void move(Touch& touch) {
    touch.damping_kg_per_s += pressure_follow * (touch.pressed_kg_per_s - touch.damping_kg_per_s);
    touch.share = std::min(1.0, touch.share + touch.share_rate);
    if (touch.share <= 0) touch.active = false;
    if (touch.frames_left == 0) return;
    touch.frames_left -= 1;
    if (touch.frames_left == 0) leave(touch);
}

/// Noises swell and end as half a sine.
void make_noises(const StringModel& model, TouchState& touches, const ActiveForces& active) {
    for (std::size_t a = 0; a < active.touches; ++a) {
        Touch& touch = touches.touches[active.index[a]];
        TouchNoise& noise = touch.noise;
        if (noise.level_N == 0) continue;
        const double middle = static_cast<double>(noise.frame) + 0.5;
        const double swell = std::sin(std::numbers::pi * middle / static_cast<double>(noise.frames));
        touch.point.noise_N = noise.level_N * swell * noise_at(noise.seed, middle * frame_s(model));
        noise.frame += 1;
        if (noise.frame >= noise.frames) noise.level_N = 0;
    }
}

/// Moves the touches on by a frame; those that are left, and the exciter.
ActiveForces move_touches(TouchState& touches) {
    ActiveForces active;  // NOLINT(cppcoreguidelines-pro-type-member-init): the first `count` are set
    for (std::size_t i = 0; i < touch_slots; ++i) {
        Touch& touch = touches.touches[i];
        if (!touch.active) continue;
        touch.point = {};
        move(touch);
        if (!touch.active) continue;
        active.index[active.count++] = i;
        active.touched_modes = std::max(active.touched_modes, touch.modes);
        active.sprung = active.sprung || touch.stiffness_N_per_m > 0;
        active.noisy = active.noisy || touch.noise.level_N > 0;
    }
    active.touches = active.count;
    touches.exciter.point = {};
    if (touches.exciter.phase != ExciterPhase::None) active.index[active.count++] = exciter_index;
    return active;
}

/// What the frame's forces are, and how far their points go if no contact acts.
void note_paths(TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                const std::array<double, forces>& force_N) {
    for (std::size_t a = 0; a < active.count; ++a) {
        const std::size_t i = active.index[a];
        TouchedPoint& point = i == exciter_index ? touches.exciter.point : touches.touches[i].point;
        point.force_N = force_N[a];
        point.start_m = paths.middle[a];
        point.path_m = paths.rise[a];
        for (std::size_t b = 0; b < active.count; ++b)
            point.path_m += touches.compliance[i * forces + active.index[b]] * force_N[b];
    }
}

}  // namespace

TouchState make_touch_state(std::size_t stride) {
    TouchState touches;
    for (Touch& touch : touches.touches) touch.row.assign(stride, 0.0);
    touches.exciter.row.assign(stride, 0.0);
    touches.moved.assign(stride, 0.0);
    return touches;
}

void lift_all_touches(TouchState& touches) JAWARI_REALTIME {
    for (Touch& touch : touches.touches) {
        touch.active = false;
        touch.point = {};
    }
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
    touch.noise = {.level_N = plan.noise_N, .frames = plan.noise_frames};
    if (plan.noise_N > 0) touch.noise.seed = next_noise(model, touches);
    touch.x_m = plan.x_m;
    touch.width_m = plan.width_m;
    touch.sweep_m = plan.sweep_m;
    touch.age = 0;
    touches.outdated = true;
    set_reach(model, touch);
    write_point_row(model, touch.modes, plan.x_m, plan.width_m, touch.row.data());
    touch.rest_m =
        kernels::row_product(touch.modes, touch.row.data(), string.displacement.data()) -
        model.shape->step_s / 2 * kernels::row_product(touch.modes, touch.row.data(), string.velocity.data());
}

void press_touch(TouchState& touches, TouchSlot slot, double damping_kg_per_s) JAWARI_REALTIME {
    Touch& touch = touch_at(touches, slot);
    touch.pressed_kg_per_s = damping_kg_per_s;
    touch.share_rate = std::abs(touch.share_rate);
}

void lift_touch(TouchState& touches, TouchSlot slot) JAWARI_REALTIME {
    Touch& touch = touch_at(touches, slot);
    touch.noise.level_N = 0;
    leave(touch);
}

void apply_touches(const StringModel& model, StringState& string, TouchState& touches) JAWARI_REALTIME {
    const ActiveForces active = move_touches(touches);
    const bool excites = active.count > active.touches;
    if (active.count == 0 || (string.asleep && !excites)) {
        clear_excitation(string);
        return;
    }
    sweep_touches(model, touches, active);
    if (active.noisy) make_noises(model, touches, active);
    if (touches.outdated) set_compliance_of_touches(model, touches, active);
    const kernels::TouchedRows paths = free_paths(model, string, touches, active);
    const TouchAnswer answer = excites ? answer_of_touches<2>(model, touches, active, paths)
                                       : answer_of_touches<1>(model, touches, active, paths);
    std::array<double, forces> force_N;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    double exciter_N = 0;
    if (excites) {
        exciter_N = exciter_force(string_at_exciter(model, touches, active, paths, answer), touches.exciter);
        force_N[active.touches] = exciter_N;
    }
    for (std::size_t a = 0; a < active.touches; ++a)
        force_N[a] = answer.alone[a] + answer.by_exciter[a] * exciter_N;
    note_paths(touches, active, paths, force_N);
    const bool passive = exciter_N == 0 && !active.sprung && !active.noisy;
    hold_forces(string, {active.count, force_N.data(), paths.row.data()}, active.touched_modes,
                excites ? model.shape->stride : active.touched_modes, passive);
}

void rewrite_touches(const StringModel& model, TouchState& touches, std::size_t kept) JAWARI_REALTIME {
    for (Touch& touch : touches.touches) {
        if (!touch.active) continue;
        set_reach(model, touch);
        write_point_row(model, touch.modes, place_of(model, touch), touch.width_m, touch.row.data());
    }
    // An exciter acts for milliseconds: modes that come in meanwhile do not feel it.
    AlignedVector<double>& row = touches.exciter.row;
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(kept), row.end(), 0.0);
    touches.outdated = true;
}

void meter_touches(const StringModel& model, const StringState& string, TouchState& touches, bool struck,
                   PlayerWork& work) JAWARI_REALTIME {
    if (!string.excitation.active) return;
    const auto path_of = [&](const TouchedPoint& point, const AlignedVector<double>& row, std::size_t modes) {
        if (!struck) return point.path_m;
        const double q = kernels::row_product(modes, row.data(), string.displacement.data());
        const double v = kernels::row_product(modes, row.data(), string.velocity.data());
        return q - model.shape->step_s / 2 * v - point.start_m;
    };
    for (const Touch& touch : touches.touches) {
        if (touch.point.force_N == 0) continue;
        const double path_m = path_of(touch.point, touch.row, touch.modes);
        work.touches_J += (touch.point.force_N - touch.point.noise_N) * path_m;
        work.noises_J += touch.point.noise_N * path_m;
    }
    const ExciterState& exciter = touches.exciter;
    if (exciter.point.force_N != 0)
        work.exciters_J += exciter.point.force_N * path_of(exciter.point, exciter.row, model.shape->stride);
}

void write_point_row(const StringModel& model, std::size_t modes, double x, double width_m,
                     double* row) JAWARI_REALTIME {
    const std::size_t count = std::min(modes, model.shape->mode_count);
    const double L = model.shape->length_m;
    kernels::point_row(
        modes, {std::sqrt(2 / L), std::numbers::pi * x / L, std::numbers::pi * width_m / (2 * L)}, row);
    std::fill(row + count, row + modes, 0.0);
}

}  // namespace jawari
