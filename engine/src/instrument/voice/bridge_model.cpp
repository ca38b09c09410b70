#include "instrument/voice/bridge_model.h"

#include <algorithm>
#include <cmath>

#include "instrument/voice/bridge_kernels.h"
#include "instrument/voice/oscillator.h"

namespace jawari {
namespace {

/// Bounds are widened by rounding.
constexpr double bounds_margin = 1 + 1e-9;

void append_mode(BridgeModel& bridge, const InstrumentDescription& instrument,
                 const BodyModeDescription& mode, double output_rate_hz) {
    const Oscillator oscillator = oscillator_of(mode);
    const OscillatorFrame frame = oscillator_frame(oscillator, 1 / output_rate_hz);
    const std::size_t j = bridge.count++;
    bridge.yy[j] = frame.yy;
    bridge.yv[j] = frame.yv;
    bridge.vy[j] = frame.vy;
    bridge.vv[j] = frame.vv;
    bridge.y_held[j] = frame.y_held / mode.mass_kg;
    bridge.v_held[j] = frame.v_held / mode.mass_kg;
    bridge.mass_kg[j] = mode.mass_kg;
    bridge.stiffness[j] = mode.mass_kg * oscillator.omega * oscillator.omega;
    bridge.gain_left[j] = instrument.gain * mode.gain_left;
    bridge.gain_right[j] = instrument.gain * mode.gain_right;
    for (std::size_t s = 0; s < instrument.strings.size(); ++s)
        bridge.shape[s * bridge.stride + j] = mode.shape.empty() ? 1.0 : mode.shape[s];
}

/// The tables by strings.
void set_by_strings(BridgeModel& bridge, std::size_t strings) {
    bridge.string_stride = padded(strings);
    bridge.receptance.assign(strings * bridge.string_stride, 0.0);
    for (std::size_t j = 0; j < bridge.count; ++j) {
        for (std::size_t s = 0; s < strings; ++s) {
            const double shape = bridge.shape[s * bridge.stride + j];
            for (std::size_t t = 0; t < strings; ++t)
                bridge.receptance[s * bridge.string_stride + t] +=
                    bridge.y_held[j] * shape * bridge.shape[t * bridge.stride + j];
        }
    }
}

}  // namespace

BridgeModel bridge_model(const InstrumentDescription& instrument, double output_rate_hz) {
    BridgeModel bridge;
    if (!instrument.bridge) return bridge;
    bridge.open_strings = instrument.bridge->open_strings;
    const auto moving = [&](const BodyModeDescription& mode) {
        return moves_bridge(instrument, mode) && is_audible(mode, output_rate_hz);
    };
    bridge.stride = padded(
        static_cast<std::size_t>(std::count_if(instrument.body.begin(), instrument.body.end(), moving)));
    for (auto* array : {&bridge.yy, &bridge.yv, &bridge.vy, &bridge.vv, &bridge.y_held, &bridge.v_held,
                        &bridge.mass_kg, &bridge.stiffness, &bridge.gain_left, &bridge.gain_right})
        array->assign(bridge.stride, 0.0);
    bridge.shape.assign(instrument.strings.size() * bridge.stride, 0.0);
    for (const BodyModeDescription& mode : instrument.body) {
        if (moving(mode)) append_mode(bridge, instrument, mode, output_rate_hz);
    }
    set_by_strings(bridge, instrument.strings.size());
    return bridge;
}

BridgeState make_bridge_state(const BridgeModel& bridge, std::size_t strings, std::size_t voices) {
    BridgeState state;
    if (bridge.count == 0) return state;
    for (auto* array : {&state.y, &state.v, &state.mean, &state.force_N, &state.path, &state.solution})
        array->assign(bridge.stride, 0.0);
    for (auto* array : {&state.matrix, &state.factor}) array->assign(bridge.count * bridge.stride, 0.0);
    for (auto* array : {&state.y_of, &state.v_of}) array->assign(strings * bridge.stride, 0.0);
    state.couplings.assign(voices, 0.0);
    state.voices.resize(voices);
    state.factorised.assign(1 + 3 * bridge.count, 0.0);
    state.pull.assign(padded(voices), 0.0);
    state.under_mean.assign(strings, 0.0);
    state.sounding.allocate(strings);
    state.string_pull.assign(strings, 0.0);
    return state;
}

void silence_bridge(BridgeState& state) JAWARI_REALTIME {
    for (auto* array : {&state.y, &state.v, &state.y_of, &state.v_of})
        std::fill(array->begin(), array->end(), 0.0);
    state.debt_J = 0;
    state.ringing = false;
    state.drives = false;
}

void reset_bridge(BridgeState& state) JAWARI_REALTIME {
    silence_bridge(state);
    state.level = 0;
    state.channel = 0;
    state.answers_from = 0;
    state.nonfinite_resets = 0;
    state.stale = true;
    state.summed = false;
    std::fill(state.factorised.begin(), state.factorised.end(), 0.0);
    state.voice_count = 0;
}

double body_energy(const BridgeModel& bridge, const BridgeState& state) JAWARI_REALTIME {
    return kernels::energy_of_body(bridge, state.y.data(), state.v.data());
}

double end_stiffness(const StringModel& model, const double* end_row, double tension_N,
                     double growth) JAWARI_REALTIME {
    double sum = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        sum += end_row[k] * end_row[k] / (2 * model.tuning.potential[k]);
    // The coupling multiplies it by growth^2, the tension has grown once.
    return sum + tension_N / (growth * model.shape->length_m);
}

void set_end_bounds(StoppedStringModel& stopped) {
    const StringModel& model = stopped.string;
    const std::size_t modes = model.shape->stride;
    const double lag = model.shape->step_s / 2;
    double energy_J = 0, kicks = 0, point_kicks = 0;
    for (std::size_t k = 0; k < modes; ++k) {
        const double q = model.tuning.flight.q_held[k] * stopped.end_row[k];
        const double v = model.tuning.flight.v_held[k] * stopped.end_row[k];
        const double w = q - lag * v;
        energy_J += model.tuning.kinetic[k] * v * v + model.tuning.potential[k] * w * w;
        if (model.tuning.certificate.kick.empty()) continue;
        kicks += model.tuning.certificate.kick[k] * std::abs(stopped.end_row[k]);
        point_kicks += model.tuning.certificate.kick[k];
    }
    stopped.end_root = bounds_margin * std::sqrt(energy_J);
    // A point force of 1 N moves mode k by sqrt(2/L) at most.
    const double shape = std::sqrt(2 / model.shape->length_m);
    stopped.end_strength = point_kicks > 0 ? bounds_margin * kicks / (shape * point_kicks) : 0.0;
}

}  // namespace jawari
