// The string over stiff springs instead of a rigid obstacle: the elastic limit without any law of impact. An
// independent reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "literature/unit_string.h"

namespace jawari::literature {

/// d'Alembert's lattice with a potential K/2 min(0, y)^2 for each unit of length of the obstacles below. The
/// force of a step is the difference quotient of the potential over two steps, so that energy is kept; each
/// node has an equation of its own, which is quadratic.
class SpringString {
  public:
    /// `stiffness_N_per_m2`: K; resolved if K dx^2 is well below 1.
    SpringString(const UnitString& u, double stiffness_N_per_m2)
        : intervals_(u.intervals), now_(u.intervals + 1, 0.0), before_(now_), next_(now_), height_(now_) {
        const double dx = 1 / static_cast<double>(intervals_);
        pull_ = stiffness_N_per_m2 * dx * dx / 2;
        for (std::size_t j = 0; j <= intervals_; ++j)
            height_[j] = u.obstacles.at(0).height(dx * static_cast<double>(j));
        for (std::size_t j = 1; j < intervals_; ++j) now_[j] = u.shape(dx * static_cast<double>(j));
        for (std::size_t j = 1; j < intervals_; ++j) before_[j] = (now_[j - 1] + now_[j + 1]) / 2;
    }

    void step() {
        for (std::size_t j = 1; j < intervals_; ++j) {
            const double free = now_[j - 1] + now_[j + 1] - before_[j];
            next_[j] = height_[j] + end_of_step(free - height_[j], before_[j] - height_[j]);
        }
        before_.swap(now_);
        now_.swap(next_);
    }

    double at(double x) const {
        return now_[static_cast<std::size_t>(std::lround(x * static_cast<double>(intervals_)))];
    }

  private:
    /// y of y = free - pull (min(0,y)^2 - min(0,before)^2)/(y - before).
    double end_of_step(double free, double before) const {
        if (free >= 0 && before >= 0) return free;
        const double both_inside = (free - pull_ * before) / (1 + pull_);
        if (before <= 0 && both_inside <= 0) return both_inside;
        const double sum = free + before;
        if (before <= 0) {  // it leaves: (y - free)(y - before) = pull before^2
            const double product = free * before - pull_ * before * before;
            return (sum + std::sqrt(std::max(0.0, sum * sum - 4 * product))) / 2;
        }
        // It enters: (y - free)(y - before) = -pull y^2.
        const double square = 1 + pull_;
        return (sum - std::sqrt(std::max(0.0, sum * sum - 4 * square * free * before))) / (2 * square);
    }

    std::size_t intervals_;
    double pull_ = 0;
    std::vector<double> now_, before_, next_, height_;
};

}  // namespace jawari::literature
