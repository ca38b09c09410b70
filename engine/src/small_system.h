// Gaussian elimination with row exchange for a handful of unknowns and two right sides.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace jawari {

template <std::size_t N>
struct SmallSystem {
    std::array<std::array<double, N>, N> matrix{};
    std::array<std::array<double, 2>, N> right{};  ///< becomes the solutions
};

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
