#include "jawari/scene/render.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "jawari/scene/energy.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/frame/frame.h"
#include "string/kernels/flight.h"

namespace jawari {
namespace {

void read_all(const StringState& state, std::span<const Reading> readings, std::size_t at) JAWARI_REALTIME {
    kernels::read(state.active_modes, readings, state.displacement.data(), state.velocity.data(), at);
}

/// Readings of a string's displacement and velocity probes; returns how many there are.
std::size_t linear_probes(const StringModel& model, std::span<double* const> outputs,
                          std::span<Reading> readings) JAWARI_REALTIME {
    std::size_t count = 0;
    for (std::size_t p = 0; p < outputs.size(); ++p) {
        const Quantity quantity = model.shape->probes[p].quantity;
        if (quantity != Quantity::Displacement && quantity != Quantity::Velocity) continue;
        readings[count++] = {model.shape->probe_rows.data() + p * model.shape->stride,
                             quantity == Quantity::Velocity, outputs[p]};
    }
    return count;
}

/// Strings do not act on one another, so each renders the whole block by itself.
void render_string(const StringModel& model, StringState& state, std::span<double* const> outputs,
                   std::size_t frames, double frame_s) JAWARI_REALTIME {
    if (sleeps_on(state)) {
        for (double* output : outputs) std::fill_n(output, frames, 0.0);
        pass_asleep(model, state, frames);
        return;
    }
    std::array<Reading, limits::probes> storage;
    const std::span<const Reading> readings(storage.data(), linear_probes(model, outputs, storage));
    if (readings.size() == outputs.size()) {
        advance_frames(model, state, readings, ReadAt::Start, frames);
        return;
    }
    for (std::size_t n = 0; n < frames; ++n) {
        if (sleeps_on(state)) {
            for (double* output : outputs) std::fill_n(output + n, frames - n, 0.0);
            pass_asleep(model, state, frames - n);
            return;
        }
        for (std::size_t p = 0; p < outputs.size(); ++p)
            outputs[p][n] = probe_value(model, state, p, frame_s);
        advance_frame(model, state);
    }
}

}  // namespace

double probe_value(const StringModel& model, const StringState& state, std::size_t probe,
                   double frame_s) JAWARI_REALTIME {
    JAWARI_ASSERT(probe < model.shape->probes.size() && frame_s > 0);
    const Quantity quantity = model.shape->probes[probe].quantity;
    double value = 0;
    switch (quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity: {
            const Reading reading{model.shape->probe_rows.data() + probe * model.shape->stride,
                                  quantity == Quantity::Velocity, &value};
            read_all(state, {&reading, 1}, 0);
            break;
        }
        case Quantity::ContactForce: {
            const auto contact = model.shape->contact_of_description[model.shape->probes[probe].contact];
            if (contact >= 0)
                value = state.contact.frame_impulse[static_cast<std::size_t>(contact)] / frame_s;
            break;
        }
        case Quantity::Energy:
            value = energy(model, state);
            break;
    }
    return value;
}

void advance_frames(const StringModel& model, StringState& state, std::span<const Reading> readings,
                    ReadAt when, std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(state.displacement.size() >= model.shape->stride);
    for (std::size_t n = 0; n < frames;) {
        if (sleeps_on(state)) {
            for (const Reading& reading : readings) std::fill_n(reading.out + n, frames - n, 0.0);
            pass_asleep(model, state, frames - n);
            return;
        }
        const BroadPhaseAnswer answer = plan_frames(model, state);
        if (answer == BroadPhaseAnswer::Planned) {
            const std::size_t flying = std::min<std::size_t>(planned_frames(state), frames - n);
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
