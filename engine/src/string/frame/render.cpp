#include "jawari/scene/render.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "jawari/scene/energy.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/frame/drive.h"
#include "string/frame/frame.h"
#include "string/kernels/flight.h"

namespace jawari {
namespace {

/// Whether a probe reads a row over the displacements or over the velocities.
bool is_linear(Quantity quantity) {
    switch (quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity:
        case Quantity::Slope:
        case Quantity::NutForce:
        case Quantity::BridgeForce:
        case Quantity::ModeDisplacement:
        case Quantity::ModeVelocity:
        case Quantity::HammerDisplacement:
            return true;
        case Quantity::Acceleration:
        case Quantity::ModeEnergy:
        case Quantity::ContactForce:
        case Quantity::HammerForce:
        case Quantity::Energy:
            return false;
    }
    return false;
}

bool reads_velocity(Quantity quantity) {
    return quantity == Quantity::Velocity || quantity == Quantity::ModeVelocity;
}

/// sum phi_k (v_free - v)/h, v_free that of predict_velocity() in step.cpp.
double acceleration(const StringModel& model, const StringState& state, const double* row) {
    const StringShape& shape = *model.shape;
    const ExcitationState& excitation = state.excitation;
    const auto elapsed = static_cast<double>(excitation.elapsed);
    double sum = 0;
    for (std::size_t k = 0; k < state.active_modes; ++k) {
        const double retained = shape.carry[k] - 1 + shape.change[k];
        sum += row[k] * (retained * state.velocity[k] + model.tuning.restoring[k] * state.displacement[k]) /
               shape.step_s;
        if (excitation.active)
            sum += row[k] * shape.mobility[k] * (excitation.held[k] + elapsed * excitation.ramp[k]);
    }
    return sum;
}

double mode_energy(const StringModel& model, const StringState& state, std::size_t k) {
    const bool exact = model.shape->scheme == Scheme::Exact;
    const double v = state.velocity[k];
    const double q = state.displacement[k] - (exact ? model.shape->step_s / 2 * v : 0.0);
    return model.tuning.kinetic[k] * v * v + model.tuning.potential[k] * q * q;
}

double mean_force(const StringState& state, std::ptrdiff_t contact, double frame_s) {
    return contact < 0 ? 0.0 : state.contact.frame_impulse[static_cast<std::size_t>(contact)] / frame_s;
}

void read_all(const StringState& state, std::span<const Reading> readings, std::size_t at) JAWARI_REALTIME {
    kernels::read(state.active_modes, readings, state.displacement.data(), state.velocity.data(), at);
}

/// Frames that a sleeping string passes before something from outside wakes it, `frames` at most; 0 if it is
/// awake.
std::size_t sleeping_frames(const StringModel& model, const StringState& state, std::size_t frames) {
    if (!sleeps_on(state)) return 0;
    return static_cast<std::size_t>(std::min<std::uint64_t>(undriven_frames(model, state), frames));
}

/// Readings of a string's linear probes; returns how many there are.
std::size_t linear_probes(const StringModel& model, std::span<double* const> outputs,
                          std::span<Reading> readings) JAWARI_REALTIME {
    std::size_t count = 0;
    for (std::size_t p = 0; p < outputs.size(); ++p) {
        const Quantity quantity = model.shape->probes[p].quantity;
        if (!is_linear(quantity)) continue;
        readings[count++] = {model.shape->probe_rows.data() + p * model.shape->stride,
                             reads_velocity(quantity), outputs[p]};
    }
    return count;
}

/// Strings do not act on one another, so each renders the whole block by itself.
void render_string(const StringModel& model, StringState& state, std::span<double* const> outputs,
                   std::size_t frames, double frame_s) JAWARI_REALTIME {
    std::array<Reading, limits::probes> storage;
    const std::span<const Reading> readings(storage.data(), linear_probes(model, outputs, storage));
    if (readings.size() == outputs.size()) {
        advance_frames(model, state, readings, ReadAt::Start, frames);
        return;
    }
    for (std::size_t n = 0; n < frames;) {
        drive_frame(model, state);
        if (const std::size_t asleep = sleeping_frames(model, state, frames - n); asleep > 0) {
            for (double* output : outputs) std::fill_n(output + n, asleep, 0.0);
            pass_asleep(model, state, asleep);
            n += asleep;
            continue;
        }
        for (std::size_t p = 0; p < outputs.size(); ++p)
            outputs[p][n] = probe_value(model, state, p, frame_s);
        cross_frame(model, state, plan_frames(model, state));
        ++n;
    }
}

}  // namespace

double probe_value(const StringModel& model, const StringState& state, std::size_t probe,
                   double frame_s) JAWARI_REALTIME {
    JAWARI_ASSERT(probe < model.shape->probes.size() && frame_s > 0);
    const Quantity quantity = model.shape->probes[probe].quantity;
    const double* row = model.shape->probe_rows.data() + probe * model.shape->stride;
    if (is_linear(quantity)) {
        double value = 0;
        const Reading reading{row, reads_velocity(quantity), &value};
        read_all(state, {&reading, 1}, 0);
        return value;
    }
    const ProbeDescription& description = model.shape->probes[probe];
    switch (quantity) {
        case Quantity::Acceleration:
            return acceleration(model, state, row);
        case Quantity::ModeEnergy:
            return mode_energy(model, state, description.mode - 1);
        case Quantity::ContactForce:
            return mean_force(state, model.shape->contact_of_description[description.contact], frame_s);
        case Quantity::HammerForce:
            return mean_force(state, model.shape->contact_of_hammer[description.hammer], frame_s);
        default:
            return energy(model, state);
    }
}

void advance_frames(const StringModel& model, StringState& state, std::span<const Reading> readings,
                    ReadAt when, std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(state.displacement.size() >= model.shape->stride);
    for (std::size_t n = 0; n < frames;) {
        drive_frame(model, state);
        if (const std::size_t asleep = sleeping_frames(model, state, frames - n); asleep > 0) {
            for (const Reading& reading : readings) std::fill_n(reading.out + n, asleep, 0.0);
            pass_asleep(model, state, asleep);
            n += asleep;
            continue;
        }
        const BroadPhaseAnswer answer = plan_frames(model, state);
        if (answer == BroadPhaseAnswer::Planned) {
            const std::size_t flying = static_cast<std::size_t>(
                std::min({planned_frames(state), undriven_frames(model, state), std::uint64_t{frames - n}}));
            fly_ahead(model, state, readings, when, n, flying);
            n += flying;
            continue;
        }
        if (when == ReadAt::Start) read_all(state, readings, n);
        cross_frame(model, state, answer);
        if (when == ReadAt::End) read_all(state, readings, n);
        ++n;
    }
}

void render(const SceneModel& model, SceneState& state, std::span<double* const> outputs,
            std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(state.strings.size() == model.strings.size());
    JAWARI_ASSERT(outputs.size() >= model.probe_count);
    std::size_t first_output = 0;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        const StringModel& string = model.strings[s];
        const std::size_t probes = string.shape->probes.size();
        render_string(string, state.strings[s], outputs.subspan(first_output, probes), frames,
                      1 / model.output_rate_hz);
        first_output += probes;
    }
    state.frame += frames;
}

void move_contact(const StringModel& model, StringState& state, std::size_t contact, double height_m,
                  std::size_t steps) JAWARI_REALTIME {
    JAWARI_ASSERT(contact < model.shape->contact_of_description.size());
    const std::ptrdiff_t kept = model.shape->contact_of_description[contact];
    if (kept < 0) return;
    const auto c = static_cast<std::size_t>(kept);
    ContactState& moved = state.contact;
    const double sign = model.shape->contact_side[c] == Side::Below ? 1.0 : -1.0;
    const double distance = sign * height_m - moved.height[c];
    moved.height_target[c] = sign * height_m;
    moved.moving_steps[c] = std::max<std::size_t>(steps, 1);
    moved.height_rate[c] = distance / static_cast<double>(moved.moving_steps[c]);
    moved.moving_count += 1;
}

}  // namespace jawari
