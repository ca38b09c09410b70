#include "instrument/touch/touch_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/touch/exciters.h"
#include "instrument/touch/touch_kernels.h"
#include "instrument/touch/touches.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// Share of the way to its new pressure that a touch goes in a frame.
constexpr double pressure_follow = 0.01;
/// A sweeping touch takes this long to and fro, and is moved every so many frames. Each move is a small step
/// of force: every second frame they are at half the output rate, where no body radiates; every fourth they
/// were heard at 12 kHz.
constexpr double sweep_period_s = 0.04;
constexpr std::uint64_t sweep_frames = 2;

/// Age at which the touch's row was written last.
std::uint64_t written_at(const Touch& touch) {
    return (touch.age - 1) / sweep_frames * sweep_frames + 1;
}

/// Where a sweep is in its way to and fro, -1 to 1.
double sweep_at(const StringModel& model, std::uint64_t age) {
    const double turns = static_cast<double>(age) * frame_s(model) / sweep_period_s;
    return std::sin(2 * std::numbers::pi * turns);
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

}  // namespace

void leave(Touch& touch) JAWARI_REALTIME {
    touch.share_rate = -std::abs(touch.share_rate);
}

double place_of(const StringModel& model, const Touch& touch) JAWARI_REALTIME {
    if (touch.sweep_m == 0 || touch.age == 0) return touch.x_m;
    return touch.x_m + touch.sweep_m * sweep_at(model, written_at(touch));
}

bool sweep_touches(const StringModel& model, TouchState& touches,
                   const ActiveForces& active) JAWARI_REALTIME {
    bool moved = false;
    std::uint64_t age = 0;  // a hand's touches were laid together
    double sweep = 0;
    for (std::size_t a = 0; a < active.touches; ++a) {
        Touch& touch = touches.touches[active.index[a]];
        if (touch.sweep_m == 0) continue;
        if (touch.age++ % sweep_frames != 0) continue;
        if (written_at(touch) != age) {
            age = written_at(touch);
            sweep = sweep_at(model, age);
        }
        write_point_row(model, touch.modes, touch.x_m + touch.sweep_m * sweep, touch.width_m,
                        touch.row.data());
        moved = true;
    }
    touches.outdated = touches.outdated || moved;
    return moved;
}

void make_noises(const StringModel& model, TouchState& touches, const ActiveForces& active) JAWARI_REALTIME {
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

ActiveForces move_touches(TouchState& touches) JAWARI_REALTIME {
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
    if (touches.exciter.phase == ExciterPhase::None) return active;
    active.excited = true;
    active.index[active.count++] = exciter_index;
    return active;
}

kernels::TouchedRows free_paths(const StringModel& model, const StringState& string,
                                const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME {
    kernels::TouchedRows rows;  // NOLINT(cppcoreguidelines-pro-type-member-init): `count` entries are set
    rows.count = active.count;
    for (std::size_t a = 0; a < active.count; ++a) rows.row[a] = row_of(touches, active, a);
    const double lag = model.shape->step_s / 2;
    const double *q = string.displacement.data(), *v = string.velocity.data();
    kernels::free_paths(0, active.touched_modes, lag, model.tuning.flight, q, v, rows);
    if (!excites(active)) return rows;
    kernels::TouchedRows beyond;  // NOLINT(cppcoreguidelines-pro-type-member-init): one entry is set
    beyond.count = 1;             // what only the exciter reaches
    beyond.row[0] = touches.exciter.row.data();
    kernels::free_paths(active.touched_modes, model.shape->stride, lag, model.tuning.flight, q, v, beyond);
    rows.middle[active.touches] += beyond.middle[0];
    rows.rise[active.touches] += beyond.rise[0];
    return rows;
}

kernels::TouchedRows paths_of_all(const StringModel& model, const StringState& string,
                                  const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME {
    kernels::TouchedRows rows;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    rows.count = active.count;
    for (std::size_t a = 0; a < active.count; ++a) rows.row[a] = row_of(touches, active, a);
    kernels::free_paths(0, string.active_modes, model.shape->step_s / 2, model.tuning.flight,
                        string.displacement.data(), string.velocity.data(), rows);
    return rows;
}

bool will_sweep(const TouchState& touches, const ActiveForces& active) JAWARI_REALTIME {
    for (std::size_t a = 0; a < active.touches; ++a) {
        const Touch& touch = touches.touches[active.index[a]];
        if (touch.sweep_m != 0 && touch.age % sweep_frames == 0) return true;
    }
    return false;
}

double path_under(const TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                  const std::array<double, most_forces>& force_N, std::size_t a) JAWARI_REALTIME {
    double path_m = paths.rise[a];
    for (std::size_t b = 0; b < active.count; ++b)
        path_m += touches.compliance[active.index[a] * most_forces + active.index[b]] * force_N[b];
    return path_m;
}

void note_paths(TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                const std::array<double, most_forces>& force_N) JAWARI_REALTIME {
    for (std::size_t a = 0; a < active.count; ++a) {
        const std::size_t i = active.index[a];
        if (i == bridge_index) continue;
        TouchedPoint& point = i == exciter_index ? touches.exciter.point : touches.touches[i].point;
        point.force_N = force_N[a];
        point.start_m = paths.middle[a];
        point.path_m = path_under(touches, active, paths, force_N, a);
    }
}

void hold(const StringModel& model, StringState& string, const ActiveForces& active,
          const kernels::TouchedRows& paths, const HeldForces& held) JAWARI_REALTIME {
    // Only the last force may act beyond what all others reach; behind an exciter that is not so.
    const std::size_t shared = active.bridge != nullptr ? reach_of(model, active) : active.touched_modes;
    hold_forces(string, {active.count, held.force_N.data(), paths.row.data()}, shared,
                reach_of(model, active), held.passive);
}

void meter_flight(const TouchState& touches, const ActiveForces& active, const kernels::TouchedRows& paths,
                  const std::array<double, most_forces>& force_N, PlayerWork& work) JAWARI_REALTIME {
    for (std::size_t a = 0; a < active.count; ++a) {
        if (active.index[a] == bridge_index) continue;
        const double path_m = path_under(touches, active, paths, force_N, a);
        if (active.index[a] == exciter_index) {
            work.exciters_J += force_N[a] * path_m;
            continue;
        }
        const double noise_N = touches.touches[active.index[a]].point.noise_N;
        work.touches_J += (force_N[a] - noise_N) * path_m;
        work.noises_J += noise_N * path_m;
    }
}

}  // namespace jawari
