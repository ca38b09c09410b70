#include "jawari/render.h"

#include <algorithm>

#include "frame.h"
#include "jawari/energy.h"
#include "kernels.h"

namespace jawari {
namespace {

/// Strings do not act on one another, so each renders the whole block by itself; one that sleeps is silence.
void render_string(const StringModel& model, StringState& state, std::span<double* const> outputs,
                   std::size_t frames, double frame_s) JAWARI_REALTIME {
    if (sleeps_on(state)) {
        for (double* output : outputs) std::fill_n(output, frames, 0.0);
        pass_asleep(model, state, frames);
        return;
    }
    for (std::size_t n = 0; n < frames; ++n) {
        for (std::size_t p = 0; p < outputs.size(); ++p)
            outputs[p][n] = probe_value(model, state, p, frame_s);
        advance_frame(model, state);
    }
}

}  // namespace

double probe_value(const StringModel& model, const StringState& state, std::size_t probe,
                   double frame_s) JAWARI_REALTIME {
    const double* row = model.probe_rows.data() + probe * model.stride;
    double value = 0;
    switch (model.probes[probe].quantity) {
        case Quantity::Displacement:
            kernels::row_products(1, state.active_modes, model.stride, row, state.displacement.data(),
                                  &value);
            break;
        case Quantity::Velocity:
            kernels::row_products(1, state.active_modes, model.stride, row, state.velocity.data(), &value);
            break;
        case Quantity::ContactForce: {
            const auto contact = model.contact_of_description[model.probes[probe].contact];
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

void render(const SceneModel& model, SceneState& state, std::span<double* const> outputs,
            std::size_t frames) JAWARI_REALTIME {
    std::size_t first_output = 0;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        const StringModel& string = model.strings[s];
        const std::size_t probes = string.probes.size();
        render_string(string, state.strings[s], outputs.subspan(first_output, probes), frames,
                      1 / model.output_rate_hz);
        first_output += probes;
    }
    state.frame += frames;
}

void move_contact(const StringModel& model, StringState& state, std::size_t contact, double height_m,
                  std::size_t steps) JAWARI_REALTIME {
    ContactState& moved = state.contact;
    const double sign = model.contact_side[contact] == Side::Below ? 1.0 : -1.0;
    const double distance = sign * height_m - moved.height[contact];
    moved.height_target[contact] = sign * height_m;
    moved.moving_steps[contact] = std::max<std::size_t>(steps, 1);
    moved.height_rate[contact] = distance / static_cast<double>(moved.moving_steps[contact]);
    moved.moving_count += 1;
}

}  // namespace jawari
