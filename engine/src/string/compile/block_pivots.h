// The complementarity problem of many contacts, while compiling.
#pragma once

#include <span>
#include <vector>

#include "jawari/detail/lcp.h"

namespace jawari {

/// A guess of lambda, >= 0, of 0 <= r + A lambda  perp  lambda >= 0 over the contacts 0 to r.size() - 1, for
/// solve_lcp(). Principal pivots of all contacts at once that have the wrong sign (Judice, Pires, "A block
/// principal pivoting algorithm for large-scale strictly monotone linear complementarity problems", Computers
/// and Operations Research 21, 1994), as long as that helps: a block costs contacts^3/3 operations, a
/// single pivot contacts^2. Few contacts are solved first, and what of them carries is the guess
/// for more. Zero where contacts depend on one another. Allocates.
std::vector<double> guess_by_block_pivots(const ContactOperator& A, std::span<const double> r);

}  // namespace jawari
