// The linear complementarity problem of one contact step, in bounded operations:
//     0 <= r + A lambda   perp   lambda >= 0,      A symmetric positive semidefinite.
// Projected Gauss-Seidel predicts the active set; the active set is then solved exactly by the symmetric
// principal pivoting method (Cottle, Pang, Stone, "The Linear Complementarity Problem", 1992, section 4.5),
// which also handles coincident contacts. For active sets beyond `largest_factor` projected gradients come
// first (string/solver/projected_gradients.h); where contacts are too nearly dependent for them, pivots
// follow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "jawari/detail/aligned.h"
#include "jawari/detail/index_list.h"
#include "jawari/realtime.h"

namespace jawari {

/// Table rows of two nodes of a grid: |i - j| and i + j.
struct GridDistances {
    std::size_t apart;
    std::size_t together;
};

constexpr GridDistances grid_distances(std::uint32_t i, std::uint32_t j) {
    return {i > j ? i - j : j - i, i + j};
}

/// Entries by which a table by distance is longer than its period: a kernel reads that far at once.
inline constexpr std::size_t grid_repeats = 4 * lane_padding;

/// A symmetric operator over contacts: a dense matrix, or, for contacts on a uniform grid, a table by
/// distance: A_ij = values[|n_i - n_j|] - values[n_i + n_j]. The table has `period` distances, of which
/// values[d] = values[period - d], and begins again for grid_repeats more.
struct ContactOperator {
    const double* values = nullptr;
    std::size_t stride = 0;               ///< between the rows of a dense matrix
    const std::uint32_t* node = nullptr;  ///< grid node of each contact, or null for a dense matrix
    std::uint64_t id = 0;    ///< the same for the same operator only; 0: unknown, nothing is kept of it
    std::size_t period = 0;  ///< of the table by distance: twice the grid's intervals
    double norm = 0;         ///< bound of the norm of A_ij/sqrt(A_ii A_jj); 0: not known

    double operator()(std::size_t i, std::size_t j) const {
        if (node == nullptr) return values[i * stride + j];
        const GridDistances d = grid_distances(node[i], node[j]);
        return values[d.apart] - values[d.together];
    }
};

/// What a solver takes for rounding, as shares of the problem's own numbers.
struct SolverTolerances {
    double rounding;          ///< of the worst violation: violations up to this are none
    double dependent_pivot;   ///< of its diagonal: a contact with a smaller pivot moves with the active ones
    double largest_residual;  ///< of the worst violation: what leaves more is no solution
};

/// solve_lcp(): each row of its factor is made from the operator itself, so that a pivot is wrong by no more
/// than a solve of up to largest_factor unknowns rounds. No solver comes after it: a residual far
/// above rounding, as nearly dependent contacts leave it, is still better than impulses scaled down.
inline constexpr SolverTolerances factor_tolerances{1e-13, 1e-13, 1e-6};

/// The pivot table of short frames (short_frame_contacts.h): entries carry the rounding of all pivots since
/// the table was made, so that a pivot is known a hundred times less well. What the table cannot solve nearly
/// to rounding goes to solve_lcp(), so that little is accepted.
inline constexpr SolverTolerances table_tolerances{1e-13, 1e-11, 1e-9};

/// Active sets up to this size are solved by a factor.
inline constexpr std::size_t largest_factor = 128;

/// Rounds after which solve_by_projected_gradients() gives up.
inline constexpr std::size_t most_gradient_rounds = 400;

/// Pivots after which solve_lcp() gives up, for active sets of up to `capacity` contacts.
constexpr std::size_t most_pivots(std::size_t capacity) {
    return 4 * capacity + 16;
}

/// Pivots after which a pivot table's problem is left to solve_lcp().
constexpr std::size_t most_table_pivots(std::size_t contacts) {
    return 2 * contacts;
}

/// Storage of solve_by_projected_gradients(); arrays over contacts, empty where the factor has room for all.
struct GradientWorkspace {
    std::size_t most_rounds = 0;
    AlignedVector<double> weight;     ///< scratch: 1/A_cc
    AlignedVector<double> direction;  ///< scratch: of the search
    AlignedVector<double> response;   ///< scratch: A direction
    IndexList sources;                ///< scratch: contacts at which a factor of a product is not zero
};

/// Room for `contacts` contacts.
GradientWorkspace make_gradient_workspace(std::size_t contacts, std::size_t most_rounds);

/// Storage of solve_lcp(). The factor outlives a solve: the next one of the same operator keeps what its
/// first guess has in common.
struct LcpWorkspace {
    std::size_t capacity = 0;  ///< active contacts that are solved by the factor at first
    std::size_t room = 0;      ///< active contacts that the factor has room for, >= capacity
    std::size_t active_count = 0;
    std::uint64_t factored = 0;  ///< id of the operator that the factor is of; 0: of none
    std::size_t repeated = 0;    ///< solves in a row that kept the active set
    AlignedVector<double>
        inverse;  ///< of A over a small active set that has been kept, rows largest_inverse apart
    std::vector<std::uint32_t> active;  ///< indices of the active contacts, in order of the factor's rows
    AlignedVector<double> factor;  ///< lower Cholesky factor of A over the active set, room x room, row-major
    AlignedVector<double> solution;   ///< scratch, room
    AlignedVector<double> direction;  ///< scratch, room
    bool full = false;                ///< scratch: the solve needs more than `capacity` active contacts
    GradientWorkspace gradients;      ///< for what is larger
};

/// Active sets up to this size get their inverse when they last: a product instead of two triangular solves.
inline constexpr std::size_t largest_inverse = 32;

/// Bounds of the stages of solve_lcp().
struct LcpLimits {
    std::size_t factored = largest_factor;     ///< active contacts above which projected gradients come first
    std::size_t independent = largest_factor;  ///< active contacts that pivots may come to after those
    std::size_t gradient_rounds = most_gradient_rounds;
};

/// Room for `contacts` contacts.
LcpWorkspace make_lcp_workspace(std::size_t contacts, const LcpLimits& limits = {});

struct LcpOutcome {
    bool finished = true;  ///< false: the bound on pivots or rounds was hit, lambda is feasible but not final
    std::size_t pivots = 0;  ///< and rounds
    double residual = 0;     ///< max over candidates of |min(r + A lambda, A_cc lambda)| [unit of r]
};

/// `candidates` are the indices that take part; lambda is zero
/// elsewhere on return. On entry lambda holds a guess >= 0 (the last step's impulses), on return the
/// solution, >= 0. `residual` receives r + A lambda at the candidates.
LcpOutcome solve_lcp(const ContactOperator& A, std::span<const double> r,
                     std::span<const std::uint32_t> candidates, std::span<double> lambda,
                     std::span<double> residual, LcpWorkspace& workspace) JAWARI_REALTIME;

}  // namespace jawari
