#include "instrument/model/body_on_string.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "base/square.h"
#include "jawari/scene/modes.h"

namespace jawari {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// Newton's method: rounds, relative difference for the slope, longest relative step, relative error.
constexpr int rounds = 40;
constexpr double difference = 1e-6, longest_step = 0.03, settled = 1e-10;
/// Points over a third octave at which mobilities are averaged.
constexpr int points_per_band = 17;

/// Displacement of the bridge under a string per force there, at the complex frequency s [m/N].
Complex receptance(const InstrumentDescription& instrument, std::size_t index, Complex s) {
    Complex sum = 0;
    for (const BodyModeDescription& mode : instrument.body) {
        if (mode.mass_kg == 0) continue;
        const double shape = instrument.strings[index].level * (mode.shape.empty() ? 1.0 : mode.shape[index]);
        const double omega = 2 * pi * mode.frequency_hz;
        const double sigma = std::log(1000.0) / mode.t60_s;
        sum += square(shape) / (mode.mass_kg * (s * s + 2 * sigma * s + square(omega)));
    }
    return sum;
}

struct Partials {
    Modes modes;
    std::vector<double> pull;  ///< b_k^2/mu [N/(m s^2)]
    double kappa = 0;          ///< sum b_k^2/(mu omega_k^2) + T/L [N/m]
};

Partials partials_of(const StringDescription& stopped) {
    Partials partials;
    partials.modes = modes_of(stopped);
    const double L = stopped.length_m, mu = stopped.linear_density_kg_per_m;
    partials.kappa = std::get<PhysicalModes>(stopped.modes).tension_N / L;
    for (std::size_t k = 0; k < partials.modes.omega.size(); ++k) {
        const double a = std::sqrt(2 / L) * L / (static_cast<double>(k + 1) * pi);
        const double b = mu * square(partials.modes.omega[k]) * a;
        partials.pull.push_back(square(b) / mu);
        partials.kappa += b * a;
    }
    return partials;
}

/// Force on the bridge per displacement of it, but for the first partial's.
Complex stiffness_of_others(const Partials& partials, Complex s) {
    Complex sum = -partials.kappa;
    for (std::size_t k = 1; k < partials.pull.size(); ++k) {
        sum += partials.pull[k] / (s * s + 2 * partials.modes.sigma[k] * s + square(partials.modes.omega[k]));
    }
    return sum;
}

}  // namespace

double coupled_first_partial(const InstrumentDescription& instrument, std::size_t index,
                             const StringDescription& stopped) {
    const Partials partials = partials_of(stopped);
    const double omega = partials.modes.omega[0], sigma = partials.modes.sigma[0];
    // s^2 + 2 sigma s + omega^2 = (b^2/mu) G/(1 - G R), G the body, R the other partials.
    const auto rest = [&](Complex s) {
        const Complex body = receptance(instrument, index, s);
        const Complex pull = partials.pull[0] * body / (1.0 - body * stiffness_of_others(partials, s));
        return s * s + 2 * sigma * s + square(omega) - pull;
    };
    Complex s{-sigma, omega};
    for (int round = 0; round < rounds; ++round) {
        const Complex step = difference * s;
        const Complex here = rest(s);
        const Complex change = here * step / (rest(s + step) - here);
        // Half a semitone at most: a step over a resonance of the body would lead to another partial.
        const double shortened = std::min(1.0, longest_step * std::abs(s) / std::abs(change));
        s -= shortened * change;
        if (std::abs(change) < settled * std::abs(s)) break;
    }
    return s.imag() / (2 * pi);
}

std::vector<double> body_losses(const InstrumentDescription& instrument, std::size_t index,
                                const StringDescription& stopped) {
    const Modes modes = modes_of(stopped);
    const double L = stopped.length_m, mu = stopped.linear_density_kg_per_m;
    const double Z = std::sqrt(std::get<PhysicalModes>(stopped.modes).tension_N * mu);
    std::vector<double> losses;
    for (const double omega : modes.omega) {
        double mobility = 0;
        for (int i = 0; i < points_per_band; ++i) {
            const double place = (static_cast<double>(i) / (points_per_band - 1) - 0.5) / 3;
            const Complex s{0, omega * std::exp2(place)};
            mobility += (s * receptance(instrument, index, s)).real() / points_per_band;
        }
        // A round trip of 2 L/c returns 1 - 2 Z Y of the amplitude, c = Z/mu.
        losses.push_back(Z * mobility * Z / (mu * L));
    }
    return losses;
}

}  // namespace jawari
