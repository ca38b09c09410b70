#include "jawari/detail/lcp.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "string/solver/projected_gradients.h"

namespace jawari {
namespace {

constexpr SolverTolerances tolerances = factor_tolerances;
constexpr int predictor_sweeps = 2;
// Solves in a row with the same active set, after which its inverse is worth making.
constexpr std::size_t lasting = 8;
// Of nearly dependent contacts, rounding may come to this many times the tolerance.
constexpr double largest_rounding = 1000;
// Nothing is done about violations below this: their tolerance would underflow.
constexpr double smallest_violation = 1e-280;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Factor = Eigen::Map<Matrix, Eigen::Aligned, Eigen::OuterStride<>>;
using Vector = Eigen::Map<Eigen::VectorXd>;

/// The problem and its workspace, so that the stages below read as sentences.
struct Problem {
    const ContactOperator& A;
    std::span<const double> r;
    std::span<const std::uint32_t> candidates;
    std::span<double> lambda;
    std::span<double> residual;
    LcpWorkspace& work;
    double tolerance = 0;  ///< violations below it are rounding

    [[nodiscard]] double a(std::size_t i, std::size_t j) const { return A(i, j); }
    [[nodiscard]] Factor factor() const {
        const auto n = static_cast<Eigen::Index>(work.active_count);
        return {work.factor.data(), n, n, Eigen::OuterStride<>(static_cast<Eigen::Index>(work.capacity))};
    }
    [[nodiscard]] Vector vector(AlignedVector<double>& storage) const {
        return {storage.data(), static_cast<Eigen::Index>(work.active_count)};
    }
};

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

/// direction <- column of A at the active contacts, row `contact`.
void gather_column(const Problem& p, std::size_t contact, AlignedVector<double>& column) {
    for (std::size_t i = 0; i < p.work.active_count; ++i) column[i] = p.a(contact, p.work.active[i]);
}

/// Appends a contact to the active set and a row to the factor; false if it depends on the active ones or
/// there is no room.
bool append_active(const Problem& p, std::size_t contact) {
    LcpWorkspace& work = p.work;
    work.repeated = 0;
    if (work.active_count == work.capacity) {
        work.full = true;
        return false;
    }
    gather_column(p, contact, work.direction);
    auto row = p.vector(work.direction);
    p.factor().triangularView<Eigen::Lower>().solveInPlace(row);
    const double pivot = p.a(contact, contact) - row.squaredNorm();
    if (!(pivot > tolerances.dependent_pivot * p.a(contact, contact))) return false;
    double* factor_row = work.factor.data() + work.active_count * work.capacity;
    std::copy_n(work.direction.data(), work.active_count, factor_row);
    factor_row[work.active_count] = std::sqrt(pivot);
    work.active[work.active_count++] = static_cast<std::uint32_t>(contact);
    return true;
}

/// Keeps the first `kept` active contacts and refactors those that follow in work.active up to `count`.
void refactor_from(const Problem& p, std::size_t kept, std::size_t count) {
    p.work.active_count = kept;
    p.work.repeated = 0;
    for (std::size_t i = kept; i < count; ++i) {
        const auto contact = p.work.active[i];  // read before append_active writes at or before i
        if (!append_active(p, contact)) p.lambda[contact] = 0;
    }
}

void remove_active(const Problem& p, std::size_t position) {
    LcpWorkspace& work = p.work;
    work.repeated = 0;
    const std::size_t count = work.active_count - 1;
    std::copy(work.active.begin() + static_cast<std::ptrdiff_t>(position) + 1,
              work.active.begin() + static_cast<std::ptrdiff_t>(work.active_count),
              work.active.begin() + static_cast<std::ptrdiff_t>(position));
    refactor_from(p, position, count);
}

void solve_with_factor(const Problem& p, AlignedVector<double>& storage) {
    auto x = p.vector(storage);
    const auto lower = p.factor();
    lower.triangularView<Eigen::Lower>().solveInPlace(x);
    lower.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
}

/// solution <- -A_FF^{-1} r_F
void solve_active(const Problem& p) {
    for (std::size_t i = 0; i < p.work.active_count; ++i) p.work.solution[i] = -p.r[p.work.active[i]];
    solve_with_factor(p, p.work.solution);
}

using Inverse = Eigen::Map<Matrix, Eigen::Aligned, Eigen::OuterStride<largest_inverse>>;

Inverse inverse_of_active(const Problem& p) {
    const auto n = static_cast<Eigen::Index>(p.work.active_count);
    return {p.work.inverse.data(), n, n};
}

/// When a small active set has lasted, its inverse is made; from then on it serves.
void solve_kept_set(const Problem& p) {
    LcpWorkspace& work = p.work;
    work.repeated += 1;
    if (work.repeated < lasting || work.active_count > largest_inverse) {
        solve_active(p);
        return;
    }
    Inverse inverse = inverse_of_active(p);
    if (work.repeated == lasting) {
        inverse.setIdentity();
        p.factor().triangularView<Eigen::Lower>().solveInPlace(inverse);
        p.factor().transpose().triangularView<Eigen::Upper>().solveInPlace(inverse);
    }
    for (std::size_t i = 0; i < work.active_count; ++i) work.direction[i] = -p.r[work.active[i]];
    for (std::size_t i = 0; i < work.active_count; ++i) {
        const double* row = work.inverse.data() + i * largest_inverse;
        double sum = 0;
        for (std::size_t j = 0; j < work.active_count; ++j) sum += row[j] * work.direction[j];
        work.solution[i] = sum;
    }
}

/// Solves for the active impulses exactly; contacts whose impulse is not positive leave until all are.
void solve_and_thin(const Problem& p) {
    LcpWorkspace& work = p.work;
    while (work.active_count > 0) {
        solve_active(p);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < work.active_count; ++i) {
            const auto c = work.active[i];
            if (work.solution[i] > 0) {
                work.active[kept++] = c;
            } else {
                p.lambda[c] = 0;
            }
        }
        if (kept == work.active_count) break;
        refactor_from(p, 0, kept);
    }
    for (std::size_t i = 0; i < work.active_count; ++i) p.lambda[work.active[i]] = work.solution[i];
}

/// The active set becomes the candidates with a positive impulse; the factor's rows that agree stay.
void adopt_active_set(const Problem& p) {
    LcpWorkspace& work = p.work;
    std::size_t agreed = 0;
    bool agrees = true;
    for (const auto c : p.candidates) {
        if (p.lambda[c] <= 0) continue;
        agrees = agrees && agreed < work.active_count && work.active[agreed] == c;
        if (agrees) {
            agreed += 1;
            continue;
        }
        work.active_count = agreed;
        if (!append_active(p, c)) p.lambda[c] = 0;
        agreed = work.active_count;
    }
    if (agreed < work.active_count) work.repeated = 0;
    work.active_count = agreed;
}

void update_residual(const Problem& p) {
    for (const auto c : p.candidates) p.residual[c] = p.r[c];
    for (std::size_t i = 0; i < p.work.active_count; ++i) {
        const auto f = p.work.active[i];
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
    if (work.repeated >= lasting && !active_gaps_close(p)) {
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

bool is_active(const LcpWorkspace& work, std::size_t contact) {
    const auto end = work.active.begin() + static_cast<std::ptrdiff_t>(work.active_count);
    return std::find(work.active.begin(), end, contact) != end;
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
        const bool dependent = !(curvature > tolerances.dependent_pivot * p.a(entering, entering));
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

/// Whether the guess alone has more impulses than the factor has room for.
bool guess_is_large(const Problem& p) {
    if (p.candidates.size() <= p.work.capacity) return false;
    const auto positive = [&](std::uint32_t c) { return p.lambda[c] > 0; };
    const auto count = std::count_if(p.candidates.begin(), p.candidates.end(), positive);
    return static_cast<std::size_t>(count) > p.work.capacity;
}

LcpOutcome solve_large(const Problem& p) {
    p.work.active_count = p.work.repeated = 0;
    return solve_by_projected_gradients(p.A, p.r, p.candidates, p.tolerance, p.lambda, p.residual,
                                        p.work.gradients);
}

}  // namespace

LcpWorkspace make_lcp_workspace(std::size_t contacts, std::size_t factored, std::size_t gradient_rounds) {
    LcpWorkspace work;
    work.capacity = std::min(contacts, factored);
    work.active.assign(work.capacity + 1, 0);
    work.factor.assign(work.capacity * work.capacity, 0.0);
    work.inverse.assign(std::min(work.capacity, largest_inverse) * largest_inverse, 0.0);
    work.solution.assign(work.capacity, 0.0);
    work.direction.assign(work.capacity, 0.0);
    work.gradients = make_gradient_workspace(contacts > work.capacity ? contacts : 0, gradient_rounds);
    return work;
}

LcpOutcome solve_lcp(const ContactOperator& A, std::span<const double> r,
                     std::span<const std::uint32_t> candidates, std::span<double> lambda,
                     std::span<double> residual, LcpWorkspace& workspace) JAWARI_REALTIME {
    Problem p{A, r, candidates, lambda, residual, workspace};
    double lowest = 0;
    for (const auto c : candidates) lowest = std::min(lowest, r[c]);
    p.tolerance = -tolerances.rounding * lowest;
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
    const bool large = workspace.full;
    if (large) outcome = solve_large(p);
    // Contradictory contacts whose pivot is just not recognised as dependent end with enormous impulses and a
    // poor residual.
    if (!(outcome.residual <= -tolerances.largest_residual * lowest)) outcome.finished = false;
    if (!outcome.finished && !large) keep_active_impulses(p, outcome);
    return outcome;
}

}  // namespace jawari
