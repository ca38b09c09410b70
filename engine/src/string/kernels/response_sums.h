// What impulses at many contacts do to the gaps of many contacts: the product of the Delassus operator and a
// vector, for active sets that are too large for a factor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "jawari/detail/lcp.h"

namespace jawari::kernels {

/// Up to so many sources are added as fast one by one.
inline constexpr std::size_t few_sources = 32;

/// out[t] += sum of A(s, t) x[s] over the sources s, for the targets t. Fast where the targets follow each
/// other (on a grid: at neighbouring nodes); correct in any order. `x` and `out` do not overlap.
void add_responses(const ContactOperator& A, std::span<const std::uint32_t> sources, const double* x,
                   std::span<const std::uint32_t> targets, double* out) noexcept;

}  // namespace jawari::kernels
