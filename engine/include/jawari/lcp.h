// The linear complementarity problem of one contact step, in bounded operations:
//     0 <= r + A lambda   perp   lambda >= 0,      A symmetric positive semidefinite.
// Projected Gauss-Seidel predicts the active set; the active set is then solved exactly by the symmetric
// principal pivoting method (Cottle, Pang, Stone, "The Linear Complementarity Problem", 1992, section 4.5),
// which also handles coincident contacts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "jawari/aligned.h"
#include "jawari/description.h"
#include "jawari/realtime.h"

namespace jawari {

/// Storage for active sets of up to `capacity` contacts.
struct LcpWorkspace {
    std::size_t capacity = 0;
    std::size_t active_count = 0;
    std::vector<std::uint32_t> active;  ///< indices of the active contacts, in order of the factor's rows
    AlignedVector<double>
        factor;  ///< lower Cholesky factor of A over the active set, capacity x capacity, row-major
    AlignedVector<double> solution;   ///< scratch, capacity
    AlignedVector<double> direction;  ///< scratch, capacity
};

/// Room for min(contacts, largest_active_set) active contacts.
LcpWorkspace make_lcp_workspace(std::size_t contacts,
                                std::size_t largest_active_set = limits::active_contacts);

struct LcpOutcome {
    bool finished =
        true;  ///< false: the bound on pivots or on the active set was hit, lambda is feasible but not final
    std::size_t pivots = 0;
    double residual = 0;  ///< max over candidates of |min(r + A lambda, A_cc lambda)| [unit of r]
};

/// A is row-major with rows `stride` apart. `candidates` are the indices that take part; lambda is zero
/// elsewhere on return. On entry lambda holds a guess >= 0 (the last step's impulses), on return the
/// solution, >= 0. `residual` receives r + A lambda at the candidates.
LcpOutcome solve_lcp(std::span<const double> A, std::size_t stride, std::span<const double> r,
                     std::span<const std::uint32_t> candidates, std::span<double> lambda,
                     std::span<double> residual, LcpWorkspace& workspace) JAWARI_REALTIME;

}  // namespace jawari
