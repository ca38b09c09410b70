#include "instrument/touch/touches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/touch/exciters.h"
#include "instrument/touch/touch_forces.h"
#include "instrument/touch/touch_frame.h"
#include "instrument/touch/touch_kernels.h"
#include "string/frame/frame.h"
#include "string/kernels/mode_sums.h"
#include "string/kernels/touched_flight.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// Touches do not reach modes above this.
constexpr double touch_limit_hz = 12000;
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

/// The frame under the forces; what its rows do next is known from then on, if it is asked for and nothing is
/// about to move them. Returns the reading.
double fly_under(const StringModel& model, StringState& string, const TouchState& touches,
                 const ActiveForces& active, const kernels::TouchedRows& paths, const HeldForces& held,
                 TouchedRun& run) {
    kernels::TouchedFlight frame;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    frame.count = active.count;
    std::copy_n(paths.row.begin(), active.count, frame.row.begin());
    std::copy_n(held.force_N.begin(), active.count, frame.force_N.begin());
    frame.read_row = run.read_row;
    frame.looks_ahead = run.goes_on && !will_sweep(touches, active);
    cross_touched_frame(model, string, frame, reach_of(model, active), held.passive);
    if (frame.looks_ahead) {
        run.known.count = active.count;
        std::copy_n(frame.row.begin(), active.count, run.known.row.begin());
        std::copy_n(frame.middle.begin(), active.count, run.known.middle.begin());
        std::copy_n(frame.rise.begin(), active.count, run.known.rise.begin());
    }
    return frame.reading;
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
    if (active.count == 0 || (string.asleep && !excites(active))) {
        clear_excitation(string);
        return;
    }
    sweep_touches(model, touches, active);
    if (active.noisy) make_noises(model, touches, active);
    if (touches.outdated) set_compliance_of_touches(model, touches, active);
    const kernels::TouchedRows paths = free_paths(model, string, touches, active);
    const HeldForces held = solve_forces(model, touches, active, paths);
    note_paths(touches, active, paths, held.force_N);
    hold(model, string, active, paths, held);
}

double fly_touched(const StringModel& model, StringState& string, TouchState& touches, TouchedRun& run,
                   PlayerWork& work) JAWARI_REALTIME {
    const ActiveForces active = move_touches(touches);
    clear_excitation(string);
    const bool acts = active.count > 0 && (!string.asleep || excites(active));
    const bool stays = acts && !sweep_touches(model, touches, active);
    const bool known = stays && run.known.count == active.count;
    if (acts && active.noisy) make_noises(model, touches, active);
    if (acts && touches.outdated) set_compliance_of_touches(model, touches, active);
    const kernels::TouchedRows paths =
        known ? run.known : (acts ? paths_of_all(model, string, touches, active) : kernels::TouchedRows());
    const HeldForces held = acts ? solve_forces(model, touches, active, paths) : HeldForces();
    run.known.count = 0;
    if (!acts || !held.any || active.count > kernels::most_flight_forces) {
        if (acts) note_paths(touches, active, paths, held.force_N);
        if (acts) hold(model, string, active, paths, held);
        advance_frame(model, string);
        meter_touches(model, string, touches, false, work);
        return kernels::row_product(string.active_modes, run.read_row, string.displacement.data());
    }
    meter_flight(touches, active, paths, held.force_N, work);
    return fly_under(model, string, touches, active, paths, held, run);
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
