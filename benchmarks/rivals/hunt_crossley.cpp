#include "hunt_crossley.h"

#include <algorithm>
#include <cmath>

namespace jawari::rivals {
namespace {

constexpr int most_iterations = 60;
constexpr double tolerance = 1e-12;  ///< of a Newton step, relative to the movement of the step

/// x - ln(1 + x), without its cancellation for small |x|.
double separated(double x) {
    if (std::abs(x) > 1e-2) return x - std::log1p(x);
    double sum = 0, power = x * x;
    for (int n = 2; n < 12; ++n, power *= -x) sum += power / n;
    return sum;
}

/// The root of an increasing function in [low, high], by bisection to the last bit.
template <class F>
double root(F&& f, double low, double high) {
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (f(middle) < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace

double restitution_of_damping(double damping_s_per_m, double speed_m_per_s) {
    const double x = damping_s_per_m * speed_m_per_s;
    if (x == 0) return 1;
    const double arriving = separated(x);
    return root([&](double e) { return separated(-e * x) - arriving; }, 0, std::min(1.0, 1 / x));
}

double damping_of_restitution(double restitution, double speed_m_per_s) {
    const auto excess = [&](double x) { return restitution - restitution_of_damping(x, 1); };
    return root(excess, 0, 10 / restitution) / speed_m_per_s;
}

HuntCrossleyContacts::HuntCrossleyContacts(PowerLaw law, std::vector<double> damping_s_per_m, double step_s)
    : law_(law), damping_(std::move(damping_s_per_m)), step_s_(step_s) {}

std::pair<double, double> HuntCrossleyContacts::elastic(double before, double r) const {
    const double after = before + r;
    if (std::abs(r) <= 1e-9 * std::abs(before)) {  // the quotient's limit
        return {law_.force(before),
                before > 0 ? law_.stiffness * law_.exponent * std::pow(before, law_.exponent - 1) / 2 : 0};
    }
    const double quotient = (law_.energy(after) - law_.energy(before)) / r;
    return {quotient, (law_.force(after) - quotient) / r};
}

// G(r) = r - (p_free - p(n-1)) + M f(r) = 0 for r = p(n+1) - p(n-1).
void HuntCrossleyContacts::solve(std::span<const double> now, std::span<const double> before,
                                 std::span<const double> free, std::span<const double> M,
                                 std::span<double> force) {
    const std::size_t contacts = now.size();
    active_.clear();
    for (std::size_t c = 0; c < contacts; ++c) {
        force[c] = 0;
        if (free[c] > 0 || before[c] > 0 || now[c] > 0) active_.push_back(c);
    }
    if (active_.empty()) return;
    const auto n = static_cast<Eigen::Index>(active_.size());
    Eigen::MatrixXd coupling(n, n);
    Eigen::VectorXd r(n), drift(n), f(n), slope(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const std::size_t c = active_[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < n; ++j) {
            coupling(i, j) = M[c * contacts + active_[static_cast<std::size_t>(j)]];
        }
        drift[i] = free[c] - before[c];
        r[i] = now[c] - before[c];
    }
    ++solves;
    for (int iteration = 0;; ++iteration) {
        for (Eigen::Index i = 0; i < n; ++i) {
            const std::size_t c = active_[static_cast<std::size_t>(i)];
            const auto [value, derivative] = elastic(before[c], r[i]);
            const double damper = damping_[c] * law_.force(now[c]) / (2 * step_s_);
            f[i] = value + damper * r[i];
            slope[i] = derivative + damper;
        }
        if (iteration == most_iterations) {
            ++failures;
            break;
        }
        const Eigen::VectorXd residual = r - drift + coupling * f;
        Eigen::MatrixXd jacobian = coupling * slope.asDiagonal();
        jacobian.diagonal().array() += 1;
        const Eigen::VectorXd change = jacobian.partialPivLu().solve(residual);
        r -= change;
        ++iterations;
        if (change.lpNorm<Eigen::Infinity>() <= tolerance * (r.lpNorm<Eigen::Infinity>() + 1e-30)) {
            // f of the r that solves the equation, so that the step and the force agree.
            for (Eigen::Index i = 0; i < n; ++i) {
                const std::size_t c = active_[static_cast<std::size_t>(i)];
                f[i] =
                    elastic(before[c], r[i]).first + damping_[c] * law_.force(now[c]) / (2 * step_s_) * r[i];
            }
            break;
        }
    }
    for (Eigen::Index i = 0; i < n; ++i) force[active_[static_cast<std::size_t>(i)]] = f[i];
}

}  // namespace jawari::rivals
