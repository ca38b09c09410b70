// Gaussian elimination with row exchange for a handful of unknowns and two right sides.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace jawari {

/// Only the first n rows and columns are ever set or read, and clearing the others would cost as much as
/// solving.
template <std::size_t N>
struct SmallSystem {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<std::array<double, N>, N> matrix;
    std::array<std::array<double, 2>, N> right;  ///< becomes the solutions
};

/// Two unknowns by Cramer's rule. The matrix must be regular.
inline void solve_two(SmallSystem<2>& s) noexcept {
    const auto& m = s.matrix;
    const double per_determinant = 1 / (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    for (std::size_t c = 0; c < 2; ++c) {
        const double x = (m[1][1] * s.right[0][c] - m[0][1] * s.right[1][c]) * per_determinant;
        s.right[1][c] = (m[0][0] * s.right[1][c] - m[1][0] * s.right[0][c]) * per_determinant;
        s.right[0][c] = x;
    }
}

/// The first n rows and columns. The matrix must be regular.
template <std::size_t N>
void solve_small_system(SmallSystem<N>& s, std::size_t n) noexcept {
    for (std::size_t p = 0; p < n; ++p) {
        std::size_t pivot = p;
        for (std::size_t r = p + 1; r < n; ++r) {
            if (std::abs(s.matrix[r][p]) > std::abs(s.matrix[pivot][p])) pivot = r;
        }
        std::swap(s.matrix[p], s.matrix[pivot]);
        std::swap(s.right[p], s.right[pivot]);
        for (std::size_t r = p + 1; r < n; ++r) {
            const double factor = s.matrix[r][p] / s.matrix[p][p];
            for (std::size_t c = p; c < n; ++c) s.matrix[r][c] -= factor * s.matrix[p][c];
            for (std::size_t c = 0; c < 2; ++c) s.right[r][c] -= factor * s.right[p][c];
        }
    }
    for (std::size_t p = n; p-- > 0;) {
        for (std::size_t c = 0; c < 2; ++c) {
            double value = s.right[p][c];
            for (std::size_t i = p + 1; i < n; ++i) value -= s.matrix[p][i] * s.right[i][c];
            s.right[p][c] = value / s.matrix[p][p];
        }
    }
}

}  // namespace jawari
