#include "phase_drift.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jawari/jawari.h"
#include "support/high_precision.h"

namespace jawari::soak {
namespace {

using test::Real;

constexpr double output_rate_hz = 48000;
constexpr std::size_t steps_per_frame = 42;
constexpr std::size_t pairs = 8;
/// Of every second mode: it falls to a fifth in 496 s, a thousand million steps.
constexpr double slow_decay_per_s = 1.0 / 300;
constexpr std::uint64_t frames_between_questions = 20000;

SceneModel free_string() {
    ModeTable table;
    ModalState start;
    for (std::size_t i = 0; i < 2 * pairs; ++i) {
        const double share = static_cast<double>(i) / (2 * pairs - 1);
        table.frequency_hz.push_back(20 * std::pow(1000.0, share));
        table.decay_per_s.push_back(i % 2 == 0 ? 0 : slow_decay_per_s);
        const double omega = 2 * std::numbers::pi * table.frequency_hz.back();
        start.displacement.push_back(1e-3 * std::cos(0.7 * static_cast<double>(i)));
        start.velocity.push_back(-1e-3 * omega * std::sin(0.7 * static_cast<double>(i)));
    }
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 0.005;
    string.modes = table;
    string.initial.shape = start;
    string.initial.start = Start::Exact;
    SceneDescription scene;
    scene.output_rate_hz = output_rate_hz;
    scene.contact_rate_hz = output_rate_hz * steps_per_frame;
    scene.strings = {string};
    auto compiled = compile(scene);
    if (!compiled) throw std::runtime_error(compiled.failure().line());
    return std::move(compiled.value());
}

/// q(t) = exp(-sigma t) Re(c exp(iWt)).
struct Closed {
    Real W, sigma, real, imaginary;

    [[nodiscard]] Real displacement(const Real& t) const {
        return exp(-sigma * t) * (real * cos(W * t) - imaginary * sin(W * t));
    }
    [[nodiscard]] Real amplitude(const Real& t) const {
        return exp(-sigma * t) * sqrt(real * real + imaginary * imaginary);
    }
};

/// The motion that has these values of q and of the backward velocity at t = 0: what the state holds, and no
/// rounding of the start is counted.
Closed closed_form(const StringModel& model, const StringState& start, std::size_t k) {
    const Real omega = model.tuning.omega[k], sigma = model.shape->sigma[k], h = model.shape->step_s;
    Closed closed{sqrt((omega - sigma) * (omega + sigma)), sigma, start.displacement[k], 0};
    const Real before = Real(start.displacement[k]) - h * Real(start.velocity[k]);
    closed.imaginary = (before * exp(-sigma * h) - closed.real * cos(closed.W * h)) / sin(closed.W * h);
    return closed;
}

/// Errors along and across the circle on which (q, v/W) turns.
ModeDrift drift_of(const StringModel& model, const StringState& state, const Closed& closed, std::size_t k,
                   std::uint64_t steps) {
    const Real h = model.shape->step_s;
    const Real t = h * steps;
    const Real q = closed.displacement(t);
    const Real v = (q - closed.displacement(t - h)) / h;
    const Real A = closed.amplitude(t);
    const Real q_error = Real(state.displacement[k]) - q;
    const Real v_error = Real(state.velocity[k]) - v;
    const Real W = closed.W;
    ModeDrift drift;
    drift.frequency_hz = model.tuning.omega[k] / (2 * std::numbers::pi);
    drift.decay_per_s = model.shape->sigma[k];
    drift.phase_rad = static_cast<double>((q_error * v / W - v_error / W * q) / (A * A));
    drift.amplitude = static_cast<double>((q_error * q + v_error / W * v / W) / (A * A));
    return drift;
}

template <double ModeDrift::*error>
double worst(const std::vector<ModeDrift>& modes) {
    double largest = 0;
    for (const ModeDrift& mode : modes) largest = std::max(largest, std::abs(mode.*error));
    return largest;
}

}  // namespace

double PhaseDrift::worst_phase_rad() const {
    return worst<&ModeDrift::phase_rad>(modes);
}

double PhaseDrift::worst_amplitude() const {
    return worst<&ModeDrift::amplitude>(modes);
}

PhaseDrift run_phase_drift(std::uint64_t steps, Advance advance,
                           const std::function<bool(std::uint64_t done)>& goes_on) {
    const SceneModel scene = free_string();
    const StringModel& model = scene.strings[0];
    StringState state = make_string_state(model);
    std::vector<Closed> closed;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) closed.push_back(closed_form(model, state, k));

    const std::uint64_t frames = steps / steps_per_frame;
    std::uint64_t done = 0;
    while (done < frames && (done % frames_between_questions != 0 || goes_on(done * steps_per_frame))) {
        if (advance == Advance::Frames) {
            advance_frame(model, state);
        } else {
            for (std::size_t i = 0; i < steps_per_frame; ++i) step(model, state);
        }
        done += 1;
    }

    PhaseDrift drift;
    drift.steps = done * steps_per_frame;
    drift.contact_rate_hz = scene.contact_rate_hz;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        drift.modes.push_back(drift_of(model, state, closed[k], k, drift.steps));
    return drift;
}

}  // namespace jawari::soak
