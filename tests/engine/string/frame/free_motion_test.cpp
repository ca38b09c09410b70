// Free motion over ten seconds, through compile() and the engine's own stepping, against the analytic
// solution of each mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "jawari/denormals.h"
#include "jawari/jawari.h"
#include "support/high_precision.h"

namespace jawari {
namespace {

using test::Real;

#if defined(JAWARI_SANITIZED) || !defined(__OPTIMIZE__)
constexpr std::size_t mode_stride =
    29;  // instrumented code: every 29th mode is enough to find what it looks for
#else
constexpr std::size_t mode_stride = 1;
#endif

/// The 862 damped modes of smooth/bass. Modes above the step's Nyquist rate, and far above it, are among them
/// at every rate.
Modes bass_modes() {
    StringDescription string;
    string.length_m = 0.863;
    string.linear_density_kg_per_m = 0.0067;
    PhysicalModes physical;
    physical.count = 862;
    physical.tension_N = 191.6;
    physical.inharmonicity = 3.5e-5;
    physical.inharmonicity_law = InharmonicityLaw::FirstOrder;
    physical.damping = ValetteLoss{1.14e-3, 1.8e-5, 1.2, 0.01, 3.3e-5};
    string.modes = physical;
    return modes_of(string);
}

/// Tables whose omega/2pi are the modes', so that compile() sees exactly these modes, each with its own phase
/// at t = 0.
SceneDescription free_scene(double rate_hz, std::size_t steps_per_frame) {
    const Modes modes = bass_modes();
    ModeTable table;
    ModalState start;
    for (std::size_t k = 0; k < modes.omega.size(); k += mode_stride) {
        const double phase = 0.7 * static_cast<double>(k);
        const double amplitude = 1e-3 / static_cast<double>(k + 1);
        table.frequency_hz.push_back(modes.omega[k] / 6.283185307179586);
        table.decay_per_s.push_back(modes.sigma[k]);
        start.displacement.push_back(amplitude * std::cos(phase));
        start.velocity.push_back(-amplitude * modes.omega[k] * std::sin(phase));
    }
    StringDescription string;
    string.length_m = 0.863;
    string.linear_density_kg_per_m = 0.0067;
    string.modes = table;
    string.initial.shape = start;
    string.initial.start = Start::Exact;
    SceneDescription scene;
    scene.output_rate_hz = rate_hz / static_cast<double>(steps_per_frame);
    scene.contact_rate_hz = rate_hz;
    scene.strings = {string};
    return scene;
}

struct Oscillation {
    Real displacement;
    Real amplitude;  ///< of the undamped motion with the same phase: sqrt(q0^2 + ((u0 + sigma q0)/W)^2)
};

Oscillation analytic(double omega_in, double sigma_in, const Real& t, double q0, double u0) {
    const Real omega = omega_in, sigma = sigma_in;
    const Real W = sqrt((omega - sigma) * (omega + sigma));
    const Real sine_part = (u0 + sigma * q0) / W;
    return {exp(-sigma * t) * (q0 * cos(W * t) + sine_part * sin(W * t)),
            sqrt(q0 * Real(q0) + sine_part * sine_part)};
}

enum class Advance { StepByStep, FrameByFrame };
constexpr std::size_t frame_steps = 100;  // divides ten seconds at every rate

/// Largest error of a mode after ten seconds, relative to its initial amplitude.
double worst_error_after_ten_seconds(double rate_hz, Advance advance) {
    const SceneDescription scene = free_scene(rate_hz, frame_steps);
    const auto& start = std::get<ModalState>(scene.strings[0].initial.shape);
    const Result<SceneModel> compiled = compile(scene);
    EXPECT_TRUE(compiled.ok()) << (compiled.ok() ? "" : compiled.failure().line());
    const StringModel& model = compiled.value().strings[0];
    EXPECT_EQ(model.shape->mode_count, start.displacement.size());
    StringState state = make_string_state(model);

    // The highest modes end far below 1e-308, and stepping them through denormals takes some processors half
    // an hour.
    const NoDenormals guard;
    const auto steps = static_cast<std::size_t>(std::llround(10 * rate_hz));
    for (std::size_t n = 0; n < steps; n += frame_steps) {
        if (advance == Advance::FrameByFrame) {
            advance_frame(model, state);
        } else {
            for (std::size_t i = 0; i < frame_steps; ++i) step(model, state);
        }
    }

    // h is the double nearest to 1/rate: over 2e7 steps its last half bit would show, so time is counted in
    // steps of h.
    const Real t = Real(model.shape->step_s) * steps;
    double worst = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const Oscillation truth = analytic(model.tuning.omega[k], model.shape->sigma[k], t,
                                           start.displacement[k], start.velocity[k]);
        const double error =
            static_cast<double>(abs(Real(state.displacement[k]) - truth.displacement) / truth.amplitude);
        EXPECT_LE(error, 1e-12) << "mode " << k * mode_stride + 1 << " at " << rate_hz << " Hz";
        worst = std::max(worst, error);
    }
    return worst;
}

class FreeMotion : public testing::TestWithParam<double> {};

void expect_exact(double rate_hz, Advance advance, const char* how) {
    const double worst = worst_error_after_ten_seconds(rate_hz, advance);
    std::printf("free motion, 10 s at %.0f Hz, %s: worst error %.2e of the initial amplitude\n", rate_hz, how,
                worst);
}

TEST_P(FreeMotion, StepByStep) {
    expect_exact(GetParam(), Advance::StepByStep, "step by step");
}

TEST_P(FreeMotion, FrameByFrame) {
    expect_exact(GetParam(), Advance::FrameByFrame, "frame by frame");
}

INSTANTIATE_TEST_SUITE_P(Rates, FreeMotion, testing::Values(44100.0, 48000.0, 96000.0, 2e6),
                         [](const auto& rate) {
                             return std::to_string(static_cast<long>(rate.param)) + "_Hz";
                         });

}  // namespace
}  // namespace jawari
