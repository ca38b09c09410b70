#include "instrument/voice/body.h"

#include <algorithm>
#include <cmath>

#include "instrument/touch/touch_kernels.h"
#include "instrument/voice/oscillator.h"

namespace jawari {
namespace {

/// A body whose largest speed is below this share of full scale is put to rest, before its numbers become
/// denormal.
constexpr double still = 1e-12;

void silence(BodyState& state) {
    std::fill(state.y.begin(), state.y.end(), 0.0);
    std::fill(state.v.begin(), state.v.end(), 0.0);
    state.force_N = 0;
    state.ringing = false;
}

}  // namespace

BodyModel body_model(const InstrumentDescription& instrument, double output_rate_hz) {
    BodyModel body;
    for (const BodyModeDescription& mode : instrument.body)
        body.count += moves_bridge(instrument, mode) ? 0 : 1;
    const std::size_t stride = padded(body.count);
    for (auto* array : {&body.yy, &body.yv, &body.vy, &body.vv, &body.y_held, &body.v_held, &body.y_ramp,
                        &body.v_ramp, &body.gain_left, &body.gain_right}) {
        array->assign(stride, 0.0);
    }
    std::size_t next = 0;
    for (const BodyModeDescription& mode : instrument.body) {
        if (moves_bridge(instrument, mode)) continue;
        const std::size_t i = next++;
        if (!is_audible(mode, output_rate_hz)) continue;
        const OscillatorFrame frame = oscillator_frame(oscillator_of(mode), 1 / output_rate_hz);
        body.yy[i] = frame.yy;
        body.yv[i] = frame.yv;
        body.vy[i] = frame.vy;
        body.vv[i] = frame.vv;
        body.y_held[i] = frame.y_held;
        body.v_held[i] = frame.v_held;
        body.y_ramp[i] = frame.y_ramp;
        body.v_ramp[i] = frame.v_ramp;
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
