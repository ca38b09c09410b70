// A pinned bar (Euler and Bernoulli; length, mass per length and bending stiffness 1) on a stop at its
// middle. Its modes are those of a string, sin(k pi x), at the angular frequencies (k pi)^2.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "literature/unit_string.h"

namespace jawari::literature {

inline double bar_omega(std::size_t mode) {
    const double wave = std::numbers::pi * static_cast<double>(mode);
    return wave * wave;
}

inline StringDescription bar(std::size_t modes) {
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 1;
    ModeTable table;
    for (std::size_t k = 1; k <= modes; ++k)
        table.frequency_hz.push_back(bar_omega(k) / (2 * std::numbers::pi));
    table.decay_per_s.assign(modes, 0);
    string.modes = table;
    return string;
}

/// The bar rests on a stop that lifts its middle by `rise`, and swings without leaving it: each half is then
/// pinned at its end and clamped at the middle. u = rise (3 x - 4 x^3) + amplitude X(x) cos(beta^2 t) for
/// x <= 1/2, X = sin(beta x) - sin(z)/sinh(z) sinh(beta x), z = beta/2 the first root of tan z = tanh z.
struct ClampedHalves {
    double rise = 0.1;
    double amplitude = 0.002;      ///< small enough that the stop always presses
    double z = 3.926602312047919;  ///< tan z = tanh z (R. D. Blevins, "Formulas for Natural Frequency", 1979)

    double beta() const { return 2 * z; }
    double period_s() const { return 2 * std::numbers::pi / (beta() * beta()); }
    double at(double x, double t) const {
        const double near = std::min(x, 1 - x);
        const double swing = std::sin(beta() * near) - std::sin(z) / std::sinh(z) * std::sinh(beta() * near);
        return rise * (3 * near - 4 * near * near * near) + amplitude * swing * std::cos(beta() * beta() * t);
    }
    /// Modal coordinates at t = 0, by the integrals of sin(k pi x) over the shapes above.
    std::vector<double> modal(std::size_t modes) const {
        std::vector<double> q(modes, 0.0);
        for (std::size_t k = 1; k <= modes; k += 2) {
            const double p = std::numbers::pi * static_cast<double>(k);
            const double top = std::numbers::sqrt2 * std::sin(p / 2);
            const double b = beta();
            const double bent = b * std::cos(z) / (p * p - b * b) -
                                std::sin(z) / std::sinh(z) * b * std::cosh(z) / (p * p + b * b);
            q[k - 1] = top * (48 * rise / (p * p * p * p) + 2 * amplitude * bent);
        }
        return q;
    }
};

/// Free flights in closed form between impacts whose times are roots of the gap; an impact changes the modal
/// velocities by -(1 + e) (S v) S'/(S S'). The bar is dropped from its first two symmetric modes.
class BouncingBar {
  public:
    BouncingBar(std::vector<double> displacement, double place, double stop, double restitution)
        : q_(std::move(displacement)),
          v_(q_.size(), 0.0),
          row_(q_.size()),
          stop_(stop),
          restitution_(restitution) {
        for (std::size_t k = 0; k < q_.size(); ++k) row_[k] = mode_shape(k + 1, place, 1);
    }

    /// Displacement at x; t must not fall.
    double at(double x, double t) {
        while (next_impact() <= t) strike();
        double u = 0;
        for (std::size_t k = 0; k < q_.size(); ++k) u += mode_shape(k + 1, x, 1) * flown(k, t - begin_s_);
        return u;
    }
    std::size_t impacts() const { return impacts_; }

  private:
    double flown(std::size_t k, double t) const {
        const double omega = bar_omega(k + 1);
        return q_[k] * std::cos(omega * t) + v_[k] / omega * std::sin(omega * t);
    }
    double gap(double t) const {
        double sum = -stop_;
        for (std::size_t k = 0; k < q_.size(); ++k) sum += row_[k] * flown(k, t);
        return sum;
    }
    /// Time of the first sign change of the gap after this flight began.
    double next_impact() {
        if (impact_s_ > begin_s_) return impact_s_;
        const double stride = 0.01 / bar_omega(q_.size());
        double high = stride;
        while (gap(high) > 0) high += stride;
        double low = high - stride;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = (low + high) / 2;
            (gap(middle) > 0 ? low : high) = middle;
        }
        return impact_s_ = begin_s_ + low;
    }
    void strike() {
        const double t = impact_s_ - begin_s_;
        double approach = 0;
        double mobility = 0;
        for (std::size_t k = 0; k < q_.size(); ++k) {
            const double omega = bar_omega(k + 1);
            const double q = flown(k, t);
            v_[k] = v_[k] * std::cos(omega * t) - q_[k] * omega * std::sin(omega * t);
            q_[k] = q;
            approach += row_[k] * v_[k];
            mobility += row_[k] * row_[k];
        }
        for (std::size_t k = 0; k < q_.size(); ++k)
            v_[k] -= (1 + restitution_) * approach * row_[k] / mobility;
        begin_s_ = impact_s_;
        impacts_ += 1;
    }

    std::vector<double> q_, v_, row_;
    double stop_, restitution_;
    double begin_s_ = 0;
    double impact_s_ = 0;
    std::size_t impacts_ = 0;
};

}  // namespace jawari::literature
