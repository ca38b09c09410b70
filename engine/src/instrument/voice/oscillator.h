// A body mode of 1 kg over an output frame: y'' + 2 sigma y' + omega^2 y = F, exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jawari/instrument/description.h"

namespace jawari {

struct Oscillator {
    double omega = 0;
    double sigma = 0;
};

/// Modes above this share of the output rate are left out: it is just below the Nyquist rate, half the output
/// rate, from which on they would alias.
inline constexpr double highest_audible = 0.48;
/// No mode is damped beyond this share of its frequency: the free motion below is that of an oscillator.
inline constexpr double strongest_damping = 0.9;

inline bool is_audible(const BodyModeDescription& mode, double output_rate_hz) {
    return mode.frequency_hz < highest_audible * output_rate_hz;
}

/// Whether the mode moves the bridge; else it listens.
inline bool moves_bridge(const InstrumentDescription& instrument, const BodyModeDescription& mode) {
    return instrument.bridge.has_value() && mode.mass_kg > 0;
}

inline Oscillator oscillator_of(const BodyModeDescription& mode) {
    const double omega = 2 * std::numbers::pi * mode.frequency_hz;
    return {omega, std::min(std::log(1000.0) / mode.t60_s, strongest_damping * omega)};
}

/// Free motion over T, and the response to a force that is held at 1 N or grows from 0 to 1 N.
struct OscillatorFrame {
    double yy = 0, yv = 0, vy = 0, vv = 0;
    double y_held = 0, v_held = 0, y_ramp = 0, v_ramp = 0;
};

inline OscillatorFrame oscillator_frame(const Oscillator& mode, double T) {
    OscillatorFrame frame;
    const double s = mode.sigma;
    const double w2 = mode.omega * mode.omega;
    const double W = std::sqrt(w2 - s * s);
    const double decay = std::exp(-s * T);
    const double c = decay * std::cos(W * T);
    const double n = decay * std::sin(W * T) / W;
    frame.yy = c + s * n;
    frame.yv = n;
    frame.vy = -w2 * n;
    frame.vv = c - s * n;
    // Held: y = 1/omega^2 is at rest; what is left of its negative is free motion.
    frame.y_held = (1 - frame.yy) / w2;
    frame.v_held = -frame.vy / w2;
    // Growing as t/T: y = (t - 2 sigma/omega^2)/(omega^2 T) solves it; its start is taken away by free
    // motion.
    const double y0 = -2 * s / (w2 * w2 * T);
    const double v0 = 1 / (w2 * T);
    frame.y_ramp = y0 + 1 / w2 - (frame.yy * y0 + frame.yv * v0);
    frame.v_ramp = v0 - (frame.vy * y0 + frame.vv * v0);
    return frame;
}

}  // namespace jawari
