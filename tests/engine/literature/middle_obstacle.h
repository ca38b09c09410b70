// Cabannes' string in closed form: plucked in the middle, over a point obstacle in the middle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "literature/unit_string.h"

namespace jawari::literature {

/// A function of time that is constant between breakpoints, and its integral.
class PiecewiseConstant {
  public:
    explicit PiecewiseConstant(double start_s) : begin_{start_s}, integral_{0.0} {}

    /// The value from now on, up to `end_s`.
    void append(double value, double end_s) {
        const double length = end_s - begin_.back();
        if (length <= 0) return;
        value_.push_back(value);
        integral_.push_back(integral_.back() + value * length);
        begin_.push_back(end_s);
    }
    /// Index of the piece that holds just after `t`.
    std::size_t piece(double t) const {
        const auto after = std::upper_bound(begin_.begin(), begin_.end(), t + same_instant);
        return static_cast<std::size_t>(after - begin_.begin()) - 1;
    }
    double value(double t) const { return value_[piece(t)]; }
    double end_of_piece(double t) const { return begin_[piece(t) + 1]; }
    /// From the start to `t`.
    double integral(double t) const {
        const std::size_t i = std::min(piece(t), value_.size() - 1);
        return integral_[i] + value_[i] * (t - begin_[i]);
    }
    double end() const { return begin_.back(); }

  private:
    static constexpr double same_instant = 1e-12;
    std::vector<double> begin_, value_, integral_;
};

/// H. Cabannes, "Cordes vibrantes avec obstacles", Acustica 55, 1984: the unit string starts as a triangle of
/// height 1 over a point obstacle at its middle, at height -h. By symmetry one half suffices: a wave a(t)
/// arrives at the middle, b(t) leaves it (both as velocities), and a(t) = -b(t - 1) from the fixed end. The
/// free middle moves with 2a and sends b = a; the middle on the obstacle sends b = -a, as long as a < 0
/// presses it down. Everything is piecewise constant, so that each event has a time in closed form. A point
/// has no mass: restitution does not appear.
class MiddleObstacle {
  public:
    MiddleObstacle(double depth, double duration_s) : depth_(depth), arriving_(0.0), leaving_(-0.5) {
        leaving_.append(1, 0);    // what was on its way to the fixed end when the triangle was released
        arriving_.append(-1, 1);  // and what was on its way to the middle
        while (leaving_.end() < duration_s) next_event();
    }

    double at(double x, double t) const {
        const double distance = std::abs(x - 0.5);
        const double start = 1 - 2 * distance;
        return start + leaving_.integral(t - distance) - leaving_.integral(-distance) +
               arriving_.integral(t + distance) - arriving_.integral(distance);
    }
    std::size_t landings() const { return landings_; }

  private:
    void next_event() {
        const double now = leaving_.end();
        const double a = arriving_.value(now);
        if (on_obstacle_ && a > 0) on_obstacle_ = false;
        double until = arriving_.end_of_piece(now);
        if (on_obstacle_) {
            send(-a, until);
            return;
        }
        const double lands = a < 0 ? now + (height_ + depth_) / (-2 * a) : HUGE_VAL;
        if (lands <= until) {
            on_obstacle_ = true;
            landings_ += 1;
            until = lands;
        }
        height_ = on_obstacle_ ? -depth_ : height_ + 2 * a * (until - now);
        send(a, until);
    }
    void send(double b, double until) {
        leaving_.append(b, until);
        arriving_.append(-b, until + 1);
    }

    double depth_;
    double height_ = 1;  ///< of the middle
    bool on_obstacle_ = false;
    std::size_t landings_ = 0;
    PiecewiseConstant arriving_;  ///< from t = 0
    PiecewiseConstant leaving_;   ///< from t = -1/2
};

}  // namespace jawari::literature
