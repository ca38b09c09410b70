// Prints the largest error of a free mode after ten seconds, relative to its initial amplitude, for three
// ways of stepping with the same coefficients. Markdown, to standard output. The modes are every eighth of
// the 862 of smooth/bass.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "jawari/detail/step_coefficients.h"
#include "jawari/scene/modes.h"
#include "support/high_precision.h"

namespace {

using jawari::test::Real;

jawari::Modes bass_modes() {
    jawari::StringDescription string;
    string.length_m = 0.863;
    string.linear_density_kg_per_m = 0.0067;
    jawari::PhysicalModes physical;
    physical.count = 862;
    physical.tension_N = 191.6;
    physical.inharmonicity = 3.5e-5;
    physical.inharmonicity_law = jawari::InharmonicityLaw::FirstOrder;
    physical.damping = jawari::ValetteLoss{1.14e-3, 1.8e-5, 1.2, 0.01, 3.3e-5};
    string.modes = physical;
    return modes_of(string);
}

/// Position after `steps` steps, from q = 1 and backward velocity v.
using Stepper = double (*)(double omega, double sigma, double h, double v, std::size_t steps);

/// v + (change v + restoring q), as the engine does it.
double small_change(double omega, double sigma, double h, double v, std::size_t steps) {
    const jawari::StepCoefficients c = jawari::exact_step(omega, sigma, h);
    double q = 1;
    for (std::size_t n = 0; n < steps; ++n) {
        v = std::fma(c.carry, v, std::fma(c.change, v, c.restoring * q));
        q = std::fma(h, v, q);
    }
    return q;
}

/// e v + restoring q, e rounded to a double.
double multiplied_by_e(double omega, double sigma, double h, double v, std::size_t steps) {
    const jawari::ExactFactors c = jawari::exact_factors(omega, sigma, h);
    double q = 1;
    for (std::size_t n = 0; n < steps; ++n) {
        v = std::fma(c.e, v, -c.d / h * q);
        q = std::fma(h, v, q);
    }
    return q;
}

/// q(t+h) = A q(t) - e q(t-h), the textbook's recursion.
double two_term_recursion(double omega, double sigma, double h, double v, std::size_t steps) {
    const jawari::ExactFactors c = jawari::exact_factors(omega, sigma, h);
    const double A = 1 + c.e - c.d;
    double q = 1, before = q - h * v;
    for (std::size_t n = 0; n < steps; ++n) {
        const double next = std::fma(A, q, -c.e * before);
        before = q;
        q = next;
    }
    return q;
}

double worst_error(const jawari::Modes& modes, double rate, Stepper stepper) {
    const double h = 1 / rate;
    const auto steps = static_cast<std::size_t>(10 * rate);
    double worst = 0;
    for (std::size_t k = 0; k < modes.omega.size(); k += 8) {
        const Real sigma = modes.sigma[k], t = Real(h) * steps;
        const Real W = sqrt((modes.omega[k] - sigma) * (modes.omega[k] + sigma));
        if (modes.sigma[k] * 10 > 100) continue;  // inaudible for seconds: nothing to compare
        const Real truth = exp(-sigma * t) * (cos(W * t) + sigma / W * sin(W * t));
        const Real amplitude = sqrt(1 + sigma * sigma / (W * W));
        const double v = jawari::exact_backward_velocity(modes.omega[k], modes.sigma[k], h, 1, 0);
        const double q = stepper(modes.omega[k], modes.sigma[k], h, v, steps);
        worst = std::max(worst, static_cast<double>(abs(Real(q) - truth) / amplitude));
    }
    return worst;
}

}  // namespace

int main() {
    const jawari::Modes modes = bass_modes();
    std::printf(
        "| rate | v + (change v - d/h q), the engine's | e v - d/h q | q+ = A q - e q_before "
        "|\n|---|---|---|---|\n");
    for (const double rate : {44100.0, 48000.0, 96000.0, 2e6}) {
        std::printf("| %.0f Hz | %.1e | %.1e | %.1e |\n", rate, worst_error(modes, rate, small_change),
                    worst_error(modes, rate, multiplied_by_e), worst_error(modes, rate, two_term_recursion));
        std::fflush(stdout);
    }
    return 0;
}
