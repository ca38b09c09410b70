#include "jawari/detail/lcp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "string/kernels/response_sums.h"
#include "string/solver/active_set.h"
#include "string/solver/projected_gradients.h"

namespace jawari {
namespace {

constexpr int predictor_sweeps = 2;
// Of nearly dependent contacts, rounding may come to this many times the tolerance.
constexpr double largest_rounding = 1000;
// Nothing is done about violations below this: their tolerance would underflow.
constexpr double smallest_violation = 1e-280;

using Problem = ActiveSetProblem;

void predict_by_gauss_seidel(const Problem& p) {
    for (int sweep = 0; sweep < predictor_sweeps; ++sweep) {
        for (const auto c : p.candidates) {
            if (p.r[c] >= 0 && p.lambda[c] == 0) continue;
            double sum = p.r[c];
            for (const auto other : p.candidates) {
                if (p.lambda[other] > 0) sum += p.a(c, other) * p.lambda[other];
            }
            p.lambda[c] = std::max(0.0, p.lambda[c] - sum / p.a(c, c));
        }
    }
}

/// Solves for the active impulses exactly; contacts whose impulse is not positive leave until all are.
void solve_and_thin(const Problem& p) {
    LcpWorkspace& work = p.work;
    while (work.active_count > 0) {
        solve_active(p);
        if (!thin_active(p)) break;
    }
    for (std::size_t i = 0; i < work.active_count; ++i) p.lambda[work.active[i]] = work.solution[i];
}

void update_residual(const Problem& p) {
    for (const auto c : p.candidates) p.residual[c] = p.r[c];
    const std::span<const std::uint32_t> active(p.work.active.data(), p.work.active_count);
    if (active.size() > kernels::few_sources) {
        kernels::add_responses(p.A, active, p.lambda.data(), p.candidates, p.residual.data());
        return;
    }
    for (const auto f : active) {
        const double impulse = p.lambda[f];
        if (p.A.node == nullptr) {
            const double* row = p.A.values + f * p.A.stride;
            for (const auto c : p.candidates) p.residual[c] += row[c] * impulse;
        } else {
            for (const auto c : p.candidates) p.residual[c] += p.a(f, c) * impulse;
        }
    }
}

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// Violations up to this are rounding. Where contacts are nearly dependent the active gaps, which should be
/// zero, miss it by more than the tolerance: no gap is known better than they are.
double attainable(const Problem& p) {
    double missed = 0;
    for (std::size_t i = 0; i < p.work.active_count; ++i)
        missed = std::max(missed, std::abs(p.residual[p.work.active[i]]));
    return std::clamp(2 * missed, p.tolerance, largest_rounding * p.tolerance);
}

/// The inactive candidate that violates its constraint most, or `none`.
std::size_t most_violated(const Problem& p) {
    std::size_t worst = none;
    double lowest = -attainable(p);
    for (const auto c : p.candidates) {
        if (p.lambda[c] > 0 || p.residual[c] >= lowest) continue;
        lowest = p.residual[c];
        worst = c;
    }
    return worst;
}

/// Whether the active gaps are what they should be, up to rounding.
bool active_gaps_close(const Problem& p) {
    const LcpWorkspace& work = p.work;
    for (std::size_t i = 0; i < work.active_count; ++i) {
        if (!(std::abs(p.residual[work.active[i]]) <= largest_rounding * p.tolerance)) return false;
    }
    return true;
}

bool adopt_solution(const Problem& p) {
    LcpWorkspace& work = p.work;
    for (std::size_t i = 0; i < work.active_count; ++i) {
        if (!(work.solution[i] > 0)) return false;
    }
    for (std::size_t i = 0; i < work.active_count; ++i) p.lambda[work.active[i]] = work.solution[i];
    update_residual(p);
    return true;
}

/// Contacts that touch mostly go on to touch: true if the contacts of the first guess are the solution's.
bool last_set_holds(const Problem& p) {
    LcpWorkspace& work = p.work;
    adopt_active_set(p);
    if (work.active_count == 0) return false;
    solve_kept_set(p);
    if (!adopt_solution(p)) return false;
    if (uses_inverse(p) && !active_gaps_close(p)) {
        // Contacts that nearly coincide: an explicit inverse loses what the factor keeps.
        solve_active(p);
        if (!adopt_solution(p)) return false;
    }
    return most_violated(p) == none;
}

void predict(const Problem& p) {
    predict_by_gauss_seidel(p);
    adopt_active_set(p);
    solve_and_thin(p);
    update_residual(p);
}

/// Raises the entering contact's impulse until its own residual is zero; active contacts that would turn
/// negative leave on the way. Returns false if that takes more than the pivots left, finds no room, or the
/// problem is infeasible.
bool bring_in(const Problem& p, std::size_t entering, std::size_t& pivots_left) {
    LcpWorkspace& work = p.work;
    double violation = p.residual[entering];
    for (; pivots_left > 0; --pivots_left) {
        gather_column(p, entering, work.direction);
        solve_with_factor(
            p, work.direction);  // active impulses change by -direction per unit of the entering one
        double curvature = p.a(entering, entering);
        for (std::size_t i = 0; i < work.active_count; ++i) {
            curvature -= work.direction[i] * p.a(entering, work.active[i]);
        }
        const bool dependent = !(curvature > factor_tolerances.dependent_pivot * p.a(entering, entering));
        double length = dependent ? std::numeric_limits<double>::infinity() : -violation / curvature;
        std::size_t blocking = work.active_count;
        for (std::size_t i = 0; i < work.active_count; ++i) {
            if (work.direction[i] <= 0) continue;
            const double reach = p.lambda[work.active[i]] / work.direction[i];
            if (reach < length) {
                length = reach;
                blocking = i;
            }
        }
        if (!std::isfinite(length)) return false;
        for (std::size_t i = 0; i < work.active_count; ++i) {
            double& impulse = p.lambda[work.active[i]];
            impulse = std::max(0.0, impulse - length * work.direction[i]);
        }
        p.lambda[entering] += length;
        violation += length * (dependent ? 0.0 : curvature);
        if (blocking == work.active_count) return append_active(p, entering);
        p.lambda[work.active[blocking]] = 0;
        remove_active(p, blocking);
    }
    return false;
}

double natural_residual(const Problem& p) {
    double worst = 0;
    for (const auto c : p.candidates) {
        worst = std::max(worst, std::abs(std::min(p.residual[c], p.a(c, c) * p.lambda[c])));
    }
    return worst;
}

/// Brings in violated contacts until there are none.
LcpOutcome pivot(const Problem& p) {
    LcpOutcome outcome;
    const std::size_t bound = most_pivots(p.work.capacity);
    std::size_t pivots_left = bound;
    for (std::size_t entering = most_violated(p); entering != none && !p.work.full;
         entering = most_violated(p)) {
        if (pivots_left == 0 || !bring_in(p, entering, pivots_left)) {
            outcome.finished = false;
            break;
        }
        pivots_left -= std::min<std::size_t>(pivots_left, 1);
        solve_and_thin(p);  // removes the rounding that the pivots have gathered
        update_residual(p);
    }
    outcome.pivots = bound - pivots_left;
    outcome.residual = natural_residual(p);
    return outcome;
}

/// The impulses of a truncated solve are those of the active set.
void keep_active_impulses(const Problem& p, LcpOutcome& outcome) {
    for (const auto c : p.candidates) {
        if (!is_active(p.work, c)) p.lambda[c] = 0;
    }
    update_residual(p);
    outcome.residual = natural_residual(p);
}

/// Whether the guess alone has more impulses than a small factor has room for.
bool guess_is_large(const Problem& p) {
    if (p.candidates.size() <= p.work.capacity) return false;
    const auto positive = [&](std::uint32_t c) { return p.lambda[c] > 0; };
    const auto count = std::count_if(p.candidates.begin(), p.candidates.end(), positive);
    return static_cast<std::size_t>(count) > p.work.capacity;
}

/// By pivots from the guess, with all the room that there is.
LcpOutcome pivot_large(const Problem& p) {
    p.work.full = false;
    adopt_active_set(p);
    solve_and_thin(p);
    update_residual(p);
    LcpOutcome outcome = pivot(p);
    outcome.finished = outcome.finished && !p.work.full;
    return outcome;
}

/// Active sets beyond the small factor: by the last one's factor if that was needed and still holds; by
/// projected gradients; and where contacts are so nearly dependent that those do not get there, by pivots.
LcpOutcome solve_large(const Problem& p, double largest_residual) {
    LcpWorkspace& work = p.work;
    const std::size_t small = work.capacity;
    const bool factored = work.active_count > small;
    work.capacity = work.room;
    LcpOutcome outcome;
    if (factored && last_set_holds(p)) {
        outcome.residual = natural_residual(p);
    } else {
        if (!factored) {
            work.active_count = work.repeated = 0;
            outcome = solve_by_projected_gradients(p.A, p.r, p.candidates, p.tolerance, p.lambda, p.residual,
                                                   work.gradients);
        }
        const std::size_t rounds = outcome.pivots;
        if (factored || !(outcome.residual <= largest_residual)) outcome = pivot_large(p);
        outcome.pivots += rounds;
    }
    work.capacity = small;
    return outcome;
}

}  // namespace

LcpWorkspace make_lcp_workspace(std::size_t contacts, const LcpLimits& limits) {
    LcpWorkspace work;
    work.capacity = std::min(contacts, limits.factored);
    work.room = std::max(work.capacity, std::min(contacts, limits.independent));
    work.active.assign(work.room + 1, 0);
    work.factor.assign(work.room * work.room, 0.0);
    work.inverse.assign(std::min(work.room, largest_inverse) * largest_inverse, 0.0);
    work.solution.assign(work.room, 0.0);
    work.direction.assign(work.room, 0.0);
    work.gradients = make_gradient_workspace(contacts > work.capacity ? contacts : 0, limits.gradient_rounds);
    return work;
}

LcpOutcome solve_lcp(const ContactOperator& A, std::span<const double> r,
                     std::span<const std::uint32_t> candidates, std::span<double> lambda,
                     std::span<double> residual, LcpWorkspace& workspace) JAWARI_REALTIME {
    Problem p{A, r, candidates, lambda, residual, workspace};
    double lowest = 0;
    for (const auto c : candidates) lowest = std::min(lowest, r[c]);
    p.tolerance = -factor_tolerances.rounding * lowest;
    if (-lowest < smallest_violation) {
        for (const auto c : candidates) lambda[c] = 0;
        for (const auto c : candidates) residual[c] = r[c];
        return {};
    }

    if (A.id == 0 || workspace.factored != A.id) workspace.active_count = workspace.repeated = 0;
    workspace.factored = A.id;

    LcpOutcome outcome;
    workspace.full = guess_is_large(p);
    if (!workspace.full) {
        if (!last_set_holds(p)) predict(p);
        outcome = pivot(p);
    }
    if (workspace.full) outcome = solve_large(p, -table_tolerances.largest_residual * lowest);
    // Contradictory contacts whose pivot is just not recognised as dependent end with enormous impulses and a
    // poor residual.
    if (!(outcome.residual <= -factor_tolerances.largest_residual * lowest)) outcome.finished = false;
    if (!outcome.finished) keep_active_impulses(p, outcome);
    return outcome;
}

}  // namespace jawari
