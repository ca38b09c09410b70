// The vibrating string over obstacles without modes: d'Alembert's solution on a lattice that waves cross in
// one step. An independent reference.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "literature/unit_string.h"

namespace jawari::literature {

/// u(x, t + dx) = u(x - dx, t) + u(x + dx, t) - u(x, t - dx) is the free string exactly. A node that would
/// end below its obstacle ends at y+ = -e y_before instead (M. Schatzman and M. Bercovier, "Numerical
/// approximation of a wave equation with unilateral constraints", Math. Comp. 53, 1989: e = 1, where it
/// converges to the solution that conserves energy). With e = 0 it stops on the obstacle. With `steps` > 1 to
/// an interval it is the explicit scheme of finite differences below its limit of stability, with the same
/// contacts.
class LatticeString {
  public:
    explicit LatticeString(const UnitString& u, double steps = 1)
        : intervals_(u.intervals),
          share_(1 / (steps * steps)),
          restitution_(u.restitution),
          now_(u.intervals + 1, 0.0),
          before_(now_),
          next_(now_),
          low_(u.intervals + 1, -out_of_reach),
          high_(u.intervals + 1, out_of_reach) {
        const double dx = 1 / static_cast<double>(intervals_);
        for (std::size_t j = 1; j < intervals_; ++j) now_[j] = u.shape(dx * static_cast<double>(j));
        for (std::size_t j = 1; j < intervals_; ++j)
            before_[j] = now_[j] + share_ * bend(j) / 2 - u.speed * dx / steps;
        place(u);
    }

    void step() {
        for (std::size_t j = 1; j < intervals_; ++j) {
            const double free = 2 * now_[j] - before_[j] + share_ * bend(j);
            const double lowest = low_[j] - restitution_ * (before_[j] - low_[j]);
            const double highest = high_[j] - restitution_ * (before_[j] - high_[j]);
            next_[j] = std::min(std::max(free, lowest), highest);
        }
        before_.swap(now_);
        now_.swap(next_);
    }

    /// Displacement at a node.
    double at(double x) const {
        return now_[static_cast<std::size_t>(std::lround(x * static_cast<double>(intervals_)))];
    }

  private:
    double bend(std::size_t j) const { return now_[j - 1] - 2 * now_[j] + now_[j + 1]; }
    void place(const UnitString& u) {
        const double rounding = 1e-9;
        for (const Obstacle& obstacle : u.obstacles) {
            for (std::size_t j = 1; j < intervals_; ++j) {
                const double x = static_cast<double>(j) / static_cast<double>(intervals_);
                if (x < obstacle.from - rounding || x > obstacle.to + rounding) continue;
                (obstacle.side == Side::Below ? low_ : high_)[j] = obstacle.height(x);
            }
        }
    }

    static constexpr double out_of_reach = 1e100;
    std::size_t intervals_;
    double share_;  ///< (step/interval)^2
    double restitution_;
    std::vector<double> now_, before_, next_;
    std::vector<double> low_, high_;
};

/// Samples of a motion with at(x) and step() at the probes of `u`, as many rows as asked for.
template <typename Motion>
std::vector<Samples> samples_of(Motion&& motion, const UnitString& u, std::size_t rows,
                                std::size_t steps_per_row) {
    std::vector<Samples> samples(u.probes.size(), Samples(rows));
    for (std::size_t n = 0; n < rows; ++n) {
        for (std::size_t p = 0; p < u.probes.size(); ++p) samples[p][n] = motion.at(u.probes[p]);
        for (std::size_t i = 0; i < steps_per_row; ++i) motion.step();
    }
    return samples;
}

/// The lattice's samples. `refinement`: lattice intervals for each interval of `u`. The output rate must
/// divide the lattice's intervals.
inline std::vector<Samples> lattice_samples(UnitString u, std::size_t rows, std::size_t refinement = 1) {
    u.intervals *= refinement;
    const auto per_row = static_cast<std::size_t>(static_cast<double>(u.intervals) / u.output_rate_hz);
    return samples_of(LatticeString(u), u, rows, per_row);
}

/// The same by finite differences, `steps` to an interval.
inline std::vector<Samples> difference_samples(const UnitString& u, std::size_t rows, std::size_t steps) {
    const auto per_row =
        static_cast<std::size_t>(static_cast<double>(u.intervals * steps) / u.output_rate_hz);
    return samples_of(LatticeString(u, static_cast<double>(steps)), u, rows, per_row);
}

}  // namespace jawari::literature
