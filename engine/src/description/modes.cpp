#include "jawari/scene/modes.h"

#include <cmath>
#include <numbers>
#include "base/assert.h"
#include "base/square.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

/// f_k for real k, so that a wavenumber can be found for any frequency.
double stretched_frequency(const PhysicalModes& modes, double f0, double k) {
    const double B = modes.inharmonicity;
    return modes.inharmonicity_law == InharmonicityLaw::SquareRoot ? k * f0 * std::sqrt(1 + B * k * k)
                                                                   : k * f0 * (1 + B * k * k / 2);
}

/// The real k > 0 with stretched_frequency(k) = f: both laws increase and lie above k f_0, so bisection is
/// safe.
double mode_number_at(const PhysicalModes& modes, double f0, double f) {
    double low = 0;
    double high = f / f0;
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (stretched_frequency(modes, f0, middle) < f ? low : high) = middle;
    }
    return high;
}

double valette_decay(const ValetteLoss& loss, const StringDescription& string, const PhysicalModes& modes,
                     double f0k, double fk) {
    const double mu = string.linear_density_kg_per_m;
    const double R =
        2 * pi * loss.air_viscosity_Pa_s +
        2 * pi * loss.diameter_m * std::sqrt(pi * loss.air_viscosity_Pa_s * loss.air_density_kg_per_m3 * fk);
    const double air = R / (2 * pi * mu) * f0k / square(fk);
    const double viscoelastic = 4 * square(string.length_m) * modes.inharmonicity * mu *
                                loss.viscoelastic_loss_angle_rad / modes.tension_N * f0k * square(f0k) / fk;
    return pi * fk * (air + viscoelastic + loss.inverse_quality);
}

/// sigma = s0 + s1 k^2 through two (k, sigma) pairs; a single frequency given twice means s1 = 0.
struct QuadraticLoss {
    double s0 = 0;
    double s1 = 0;
};

QuadraticLoss loss_through(const DecayTimePoints& decay, const PhysicalModes& modes, double f0) {
    const double k1 = mode_number_at(modes, f0, decay.points[0].frequency_hz);
    const double k2 = mode_number_at(modes, f0, decay.points[1].frequency_hz);
    const double sigma1 = std::log(1000.0) / decay.points[0].t60_s;
    const double sigma2 = std::log(1000.0) / decay.points[1].t60_s;
    if (k1 == k2) return {sigma1, 0};
    const double s1 = (sigma2 - sigma1) / (square(k2) - square(k1));
    return {sigma1 - s1 * square(k1), s1};
}

/// Of a mode's losses that is its own, whatever it loses elsewhere.
constexpr double least_own_share = 0.1;

Modes physical_modes(const StringDescription& string, const PhysicalModes& physical) {
    const double f0 = std::sqrt(physical.tension_N / string.linear_density_kg_per_m) / (2 * string.length_m);
    QuadraticLoss quadratic;
    if (const auto* decay = std::get_if<DecayTimePoints>(&physical.damping)) {
        quadratic = loss_through(*decay, physical, f0);
    }
    Modes modes;
    for (std::size_t i = 0; i < physical.count; ++i) {
        const double k = static_cast<double>(i + 1);
        const double fk = stretched_frequency(physical, f0, k);
        modes.omega.push_back(2 * pi * fk);
        if (const auto* valette = std::get_if<ValetteLoss>(&physical.damping)) {
            modes.sigma.push_back(valette_decay(*valette, string, physical, k * f0, fk));
        } else {
            modes.sigma.push_back(quadratic.s0 + quadratic.s1 * k * k);
        }
        if (i < physical.lost_elsewhere_per_s.size()) {
            double& sigma = modes.sigma.back();
            sigma = std::max(least_own_share * sigma, sigma - physical.lost_elsewhere_per_s[i]);
        }
    }
    return modes;
}

/// sin(pi t), t reduced exactly to |t| <= 1/2 first.
double sin_pi(double t) {
    double r = std::remainder(t, 2.0);
    if (r > 0.5) r = 1 - r;
    if (r < -0.5) r = -1 - r;
    return std::sin(pi * r);
}

/// k x/L reduced to a whole turn, as the sum of two doubles on the way, so that its fractional part keeps
/// full precision at high k.
double half_turns(std::size_t k, double x, double length_m) {
    const double mode = static_cast<double>(k);
    const double ratio = x / length_m;
    const double ratio_error = std::fma(-ratio, length_m, x) / length_m;
    const double product = mode * ratio;
    const double product_error = std::fma(mode, ratio, -product) + mode * ratio_error;
    return std::remainder(product, 2.0) + product_error;
}

}  // namespace

Modes modes_of(const StringDescription& string) {
    JAWARI_ASSERT(string.shapes || (string.length_m > 0 && string.linear_density_kg_per_m > 0));
    if (const auto* physical = std::get_if<PhysicalModes>(&string.modes))
        return physical_modes(string, *physical);
    const auto& table = std::get<ModeTable>(string.modes);
    Modes modes;
    for (const double f : table.frequency_hz) modes.omega.push_back(2 * pi * f);
    modes.sigma = table.decay_per_s;
    return modes;
}

double mode_shape(std::size_t k, double x, double length_m) {
    return std::sqrt(2 / length_m) * sin_pi(half_turns(k, x, length_m));
}

double mode_slope(std::size_t k, double x, double length_m) {
    const double turns = half_turns(k, x, length_m);
    // cos(pi t) = sin(pi (1/2 - |t|)), |t| <= 1 and a little.
    return std::sqrt(2 / length_m) * static_cast<double>(k) * pi / length_m * sin_pi(0.5 - std::abs(turns));
}

double pluck_coordinate(std::size_t k, const Pluck& pluck, double length_m) {
    const double wavenumber = static_cast<double>(k) * pi / length_m;
    const double slope_change =
        pluck.height_m * length_m / (pluck.position_m * (length_m - pluck.position_m));
    return slope_change * mode_shape(k, pluck.position_m, length_m) / square(wavenumber);
}

}  // namespace jawari
