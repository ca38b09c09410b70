// The machine's peak of fused multiply-adds, as measured.
#pragma once

#include <cstddef>

namespace jawari::benchmarks {

/// Runs `rounds` rounds of independent multiply-adds in registers; returns how many scalar multiply-adds that
/// were. `sink` receives their result, so that they are not optimised away.
std::size_t multiply_adds(std::size_t rounds, double& sink);

}  // namespace jawari::benchmarks
