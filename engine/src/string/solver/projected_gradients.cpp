#include "string/solver/projected_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "string/kernels/response_sums.h"

namespace jawari {
namespace {

/// Of 2/norm, the longest step along a gradient that cannot raise the energy.
constexpr double step_share = 0.95;

/// Times that the residual is computed afresh because the updated one has reached the tolerance and rounding
/// has made it untrue.
constexpr int most_refreshes = 3;

/// minimise f = lambda' A lambda/2 + r' lambda over lambda >= 0; its gradient is the residual r + A lambda.
struct Minimisation {
    const ContactOperator& A;
    std::span<const double> r;
    std::span<const std::uint32_t> candidates;
    std::span<double> lambda;
    std::span<double> gradient;
    GradientWorkspace& work;
    double step = 0;  ///< along the gradient

    [[nodiscard]] double weight(std::uint32_t c) const { return work.weight[c]; }
};

void set_weights(const Minimisation& m) {
    for (const auto c : m.candidates) m.work.weight[c] = 1 / m.A(c, c);
}

/// out <- A x at the candidates; x is zero elsewhere.
void multiply(const Minimisation& m, const double* x, double* out) {
    GradientWorkspace& work = m.work;
    work.sources.clear();
    for (const auto c : m.candidates) {
        work.sources.push_if(x[c] != 0, c);
        out[c] = 0;
    }
    kernels::add_responses(m.A, work.sources.span(), x, m.candidates, out);
}

void refresh_gradient(const Minimisation& m) {
    multiply(m, m.lambda.data(), m.gradient.data());
    for (const auto c : m.candidates) m.gradient[c] += m.r[c];
}

double largest_residual(const Minimisation& m) {
    double worst = 0;
    for (const auto c : m.candidates)
        worst = std::max(worst, std::abs(std::min(m.gradient[c], m.lambda[c] / m.weight(c))));
    return worst;
}

/// Whether contacts without impulse are violated by less than the others are from their optimum.
bool is_proportional(const Minimisation& m) {
    double chopped = 0;
    double reduced = 0;
    for (const auto c : m.candidates) {
        const double g = m.gradient[c];
        const double square = m.weight(c) * g * g;
        if (m.lambda[c] > 0) {
            reduced += g > 0 ? std::min(m.lambda[c] * g / m.step, square) : square;
        } else if (g < 0) {
            chopped += square;
        }
    }
    return chopped <= reduced;
}

/// direction <- the gradient among the contacts with impulses
void follow_free_gradient(const Minimisation& m) {
    for (const auto c : m.candidates)
        m.work.direction[c] = m.lambda[c] > 0 ? m.weight(c) * m.gradient[c] : 0.0;
}

/// direction <- the gradient at the violated contacts without impulse
void follow_chopped_gradient(const Minimisation& m) {
    for (const auto c : m.candidates) {
        const bool violated = m.lambda[c] <= 0 && m.gradient[c] < 0;
        m.work.direction[c] = violated ? m.weight(c) * m.gradient[c] : 0.0;
    }
}

struct LineSearch {
    double slope = 0;      ///< of f against the direction
    double curvature = 0;  ///< of f along it; not positive if the operator does not see the direction
    double feasible = std::numeric_limits<double>::infinity();  ///< the step at which an impulse turns zero
};

/// response <- A direction
LineSearch search_line(const Minimisation& m) {
    multiply(m, m.work.direction.data(), m.work.response.data());
    LineSearch line;
    for (const auto c : m.candidates) {
        const double d = m.work.direction[c];
        line.slope += m.gradient[c] * d;
        line.curvature += d * m.work.response[c];
        if (d > 0) line.feasible = std::min(line.feasible, m.lambda[c] / d);
    }
    return line;
}

void go(const Minimisation& m, double length) {
    for (const auto c : m.candidates) {
        m.lambda[c] = std::max(0.0, m.lambda[c] - length * m.work.direction[c]);
        m.gradient[c] -= length * m.work.response[c];
    }
}

/// direction <- the next one of the conjugate gradients
void conjugate(const Minimisation& m, double curvature) {
    double coupling = 0;
    for (const auto c : m.candidates) {
        if (m.lambda[c] > 0) coupling += m.weight(c) * m.gradient[c] * m.work.response[c];
    }
    const double share = coupling / curvature;
    for (const auto c : m.candidates) {
        const double free = m.lambda[c] > 0 ? m.weight(c) * m.gradient[c] : 0.0;
        m.work.direction[c] = free - share * m.work.direction[c];
    }
}

/// Up to the boundary, and on along the free gradient; impulses that would turn negative become zero.
void expand(const Minimisation& m, double feasible) {
    if (std::isfinite(feasible)) go(m, feasible);
    for (const auto c : m.candidates) {
        if (m.lambda[c] > 0) m.lambda[c] = std::max(0.0, m.lambda[c] - m.step * m.weight(c) * m.gradient[c]);
    }
    refresh_gradient(m);
    follow_free_gradient(m);
}

/// Lets violated contacts have impulses.
void proportion(const Minimisation& m) {
    follow_chopped_gradient(m);
    const LineSearch line = search_line(m);
    if (line.curvature > 0) {
        go(m, line.slope / line.curvature);
    } else {
        go(m, m.step);
    }
    follow_free_gradient(m);
}

/// One round: one or two products.
void descend(const Minimisation& m) {
    if (!is_proportional(m)) {
        proportion(m);
        return;
    }
    const LineSearch line = search_line(m);
    const double length = line.slope / line.curvature;
    if (line.curvature > 0 && length <= line.feasible) {
        go(m, length);
        conjugate(m, line.curvature);
    } else {
        expand(m, line.feasible);
    }
}

}  // namespace

GradientWorkspace make_gradient_workspace(std::size_t contacts, std::size_t most_rounds) {
    GradientWorkspace work;
    work.most_rounds = most_rounds;
    work.sources.allocate(contacts + 1);
    for (auto* array : {&work.weight, &work.direction, &work.response}) array->assign(padded(contacts), 0.0);
    return work;
}

double bound_of_norm(const ContactOperator& A, std::span<const std::uint32_t> contacts) JAWARI_REALTIME {
    double largest = 0;
    for (const auto i : contacts) {
        double sum = 0;
        for (const auto j : contacts) sum += std::abs(A(i, j)) / std::sqrt(A(j, j));
        largest = std::max(largest, sum / std::sqrt(A(i, i)));
    }
    return largest;
}

LcpOutcome solve_by_projected_gradients(const ContactOperator& A, std::span<const double> r,
                                        std::span<const std::uint32_t> candidates, double tolerance,
                                        std::span<double> lambda, std::span<double> residual,
                                        GradientWorkspace& workspace) JAWARI_REALTIME {
    Minimisation m{A, r, candidates, lambda, residual, workspace};
    set_weights(m);
    m.step = step_share * 2 / (A.norm > 0 ? A.norm : bound_of_norm(A, candidates));
    refresh_gradient(m);
    follow_free_gradient(m);
    LcpOutcome outcome;
    int refreshes = 0;
    while (outcome.pivots < workspace.most_rounds) {
        if (largest_residual(m) <= tolerance) {
            if (refreshes == most_refreshes) break;
            refreshes += 1;
            refresh_gradient(m);
            if (largest_residual(m) <= tolerance) break;
            follow_free_gradient(m);
        }
        descend(m);
        outcome.pivots += 1;
    }
    refresh_gradient(m);
    outcome.residual = largest_residual(m);
    return outcome;
}

}  // namespace jawari
