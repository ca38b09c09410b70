// The complementarity problem for active sets that are too large for a factor.
#pragma once

#include <cstdint>
#include <span>

#include "jawari/detail/lcp.h"
#include "jawari/realtime.h"

namespace jawari {

/// Solves 0 <= r + A lambda  perp  lambda >= 0 by modified proportioning with reduced gradient projections
/// (Dostal, "Optimal Quadratic Programming Algorithms", 2009, section 5.8), preconditioned by the diagonal:
/// conjugate gradients among the contacts with impulses, until one of them would turn negative or a contact
/// without impulse is violated by more. Each round is one or two products with A of at most candidates^2
/// operations; there are at most GradientWorkspace::most_rounds of them. On entry lambda holds a guess >= 0;
/// on return `residual` is r + A lambda at the candidates. `tolerance`: of LcpOutcome::residual.
LcpOutcome solve_by_projected_gradients(const ContactOperator& A, std::span<const double> r,
                                        std::span<const std::uint32_t> candidates, double tolerance,
                                        std::span<double> lambda, std::span<double> residual,
                                        GradientWorkspace& workspace) JAWARI_REALTIME;

/// Gershgorin's bound of the norm of A_ij/sqrt(A_ii A_jj) over the contacts; no part of them exceeds it.
double bound_of_norm(const ContactOperator& A, std::span<const std::uint32_t> contacts) JAWARI_REALTIME;

}  // namespace jawari
