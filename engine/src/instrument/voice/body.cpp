#include "instrument/voice/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/touch/touch_kernels.h"

namespace jawari {
namespace {

/// A body whose largest speed is below this share of full scale is put to rest, before its numbers become
/// denormal.
constexpr double still = 1e-12;

/// Modes above this share of the output rate are left out: it is just below the Nyquist rate, half the output
/// rate, from which on they would alias.
constexpr double highest_audible = 0.48;
/// No mode is damped beyond this share of its frequency: the free motion below is that of an oscillator.
constexpr double strongest_damping = 0.9;

struct Oscillator {
    double omega = 0;
    double sigma = 0;
};

/// y'' + 2 sigma y' + omega^2 y = F. Free motion over T, and the response to F held or growing from 0 to 1.
void set_mode(BodyModel& body, std::size_t i, const Oscillator& mode, double T) {
    const double s = mode.sigma;
    const double w2 = mode.omega * mode.omega;
    const double W = std::sqrt(w2 - s * s);
    const double decay = std::exp(-s * T);
    const double c = decay * std::cos(W * T);
    const double n = decay * std::sin(W * T) / W;
    body.yy[i] = c + s * n;
    body.yv[i] = n;
    body.vy[i] = -w2 * n;
    body.vv[i] = c - s * n;
    // Held: y = 1/omega^2 is at rest; what is left of its negative is free motion.
    body.y_held[i] = (1 - body.yy[i]) / w2;
    body.v_held[i] = -body.vy[i] / w2;
    // Growing as t/T: y = (t - 2 sigma/omega^2)/(omega^2 T) solves it; its start is taken away by free
    // motion.
    const double y0 = -2 * s / (w2 * w2 * T);
    const double v0 = 1 / (w2 * T);
    body.y_ramp[i] = y0 + 1 / w2 - (body.yy[i] * y0 + body.yv[i] * v0);
    body.v_ramp[i] = v0 - (body.vy[i] * y0 + body.vv[i] * v0);
}

void silence(BodyState& state) {
    std::fill(state.y.begin(), state.y.end(), 0.0);
    std::fill(state.v.begin(), state.v.end(), 0.0);
    state.force_N = 0;
    state.ringing = false;
}

}  // namespace

BodyModel body_model(const InstrumentDescription& instrument, double output_rate_hz) {
    BodyModel body;
    body.count = instrument.body.size();
    const std::size_t stride = padded(body.count);
    for (auto* array : {&body.yy, &body.yv, &body.vy, &body.vv, &body.y_held, &body.v_held, &body.y_ramp,
                        &body.v_ramp, &body.gain_left, &body.gain_right}) {
        array->assign(stride, 0.0);
    }
    for (std::size_t i = 0; i < body.count; ++i) {
        const BodyModeDescription& mode = instrument.body[i];
        if (mode.frequency_hz >= highest_audible * output_rate_hz) continue;
        const double omega = 2 * std::numbers::pi * mode.frequency_hz;
        const double sigma = std::min(std::log(1000.0) / mode.t60_s, strongest_damping * omega);
        set_mode(body, i, {omega, sigma}, 1 / output_rate_hz);
        body.gain_left[i] = mode.gain_left;
        body.gain_right[i] = mode.gain_right;
    }
    return body;
}

BodyState make_body_state(const BodyModel& body) {
    BodyState state;
    state.y.assign(padded(body.count), 0.0);
    state.v.assign(padded(body.count), 0.0);
    return state;
}

void reset_body(BodyState& state) JAWARI_REALTIME {
    silence(state);
    state.nonfinite_resets = 0;
}

StereoSample advance_body(const BodyModel& body, BodyState& state, double force_N) JAWARI_REALTIME {
    const double before = state.force_N;
    if (!state.ringing && force_N == 0 && before == 0) return {};
    state.force_N = force_N;
    const kernels::BodyFrame frame = kernels::advance_body(padded(body.count), body, before, force_N - before,
                                                           state.y.data(), state.v.data());
    const StereoSample sample{frame.left, frame.right};
    state.ringing = true;
    const bool lost = !std::isfinite(sample.left + sample.right);
    if (lost || (frame.largest < still && force_N == 0)) {
        silence(state);
        if (lost) {
            state.nonfinite_resets += 1;
            return {};
        }
    }
    return sample;
}

}  // namespace jawari
