// The complementarity problem of many contacts, while compiling.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "jawari/detail/lcp.h"

namespace jawari {

/// lambda of 0 <= r + A lambda  perp  lambda >= 0 over the contacts 0 to r.size() - 1 by principal pivots of
/// all contacts at once that have the wrong sign (Judice, Pires, "A block principal pivoting algorithm for
/// large-scale strictly monotone linear complementarity problems", Computers and Operations Research 21,
/// 1994), one at a time where that goes round in circles. Few contacts are solved first, and what of them
/// carries is the guess for more: each solve of all costs contacts^3/3 operations, and few are needed. For
/// contacts that are independent of one another, such as no more than the modes; nothing otherwise.
/// Allocates.
std::optional<std::vector<double>> solve_by_block_pivots(const ContactOperator& A, std::span<const double> r);

}  // namespace jawari
