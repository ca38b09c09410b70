// Gaussian elimination for a handful of unknowns and up to three right sides, for matrices I + D G with D
// diagonal, D >= 0, and G symmetric positive semidefinite. Their pivots are those of I + sqrt(D) G sqrt(D),
// at least 1: rows need not be exchanged.
#pragma once

#include <array>
#include <cstddef>

namespace jawari {

/// Only the first n rows and columns, and as many right sides as are solved for, are ever set or read:
/// clearing the others would cost as much as solving.
template <std::size_t N>
struct SmallSystem {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<std::array<double, N>, N> matrix;
    std::array<std::array<double, 3>, N> right;  ///< becomes the solutions
};

/// The first n <= N rows and columns, the first `sides` right sides.
template <std::size_t N, std::size_t sides>
inline void solve_small_system(SmallSystem<N>& s, std::size_t n) noexcept {
    std::array<double, N> per_pivot;  // NOLINT(cppcoreguidelines-pro-type-member-init): the first n are set
    for (std::size_t p = 0; p < n; ++p) {
        per_pivot[p] = 1 / s.matrix[p][p];
        for (std::size_t r = p + 1; r < n; ++r) {
            const double factor = s.matrix[r][p] * per_pivot[p];
            for (std::size_t c = p + 1; c < n; ++c) s.matrix[r][c] -= factor * s.matrix[p][c];
            for (std::size_t c = 0; c < sides; ++c) s.right[r][c] -= factor * s.right[p][c];
        }
    }
    for (std::size_t p = n; p-- > 0;) {
        for (std::size_t c = 0; c < sides; ++c) {
            double value = s.right[p][c];
            for (std::size_t i = p + 1; i < n; ++i) value -= s.matrix[p][i] * s.right[i][c];
            s.right[p][c] = value * per_pivot[p];
        }
    }
}

}  // namespace jawari
