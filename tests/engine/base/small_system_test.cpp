#include "base/small_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace jawari {
namespace {

constexpr std::size_t most = 7;
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// I + D G of touches: compliances of `n` places of which some coincide, dashpots from none to rigid.
Matrix random_system(std::mt19937& random, Eigen::Index n) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> exponent(-6, 6);
    const Eigen::Index modes = 1 + static_cast<Eigen::Index>(random() % 12);
    Matrix rows(n, modes);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < modes; ++k)
            rows(i, k) = i > 0 && i % 3 == 0 ? rows(i - 1, k) : normal(random);
    Matrix system = rows * rows.transpose();
    for (Eigen::Index i = 0; i < n; ++i)
        system.row(i) *= random() % 5 == 0 ? 0.0 : std::pow(10.0, exponent(random));
    return system + Matrix::Identity(n, n);
}

template <std::size_t sides>
void expect_solution(std::mt19937& random, std::size_t n) {
    std::normal_distribution<double> normal;
    const auto size = static_cast<Eigen::Index>(n);
    const Matrix matrix = random_system(random, size);
    SmallSystem<most> system{};
    Matrix rounded(size, size), right(size, static_cast<Eigen::Index>(sides));
    for (Eigen::Index i = 0; i < size; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (Eigen::Index j = 0; j < size; ++j) {
            const auto value = static_cast<double>(matrix(i, j));
            system.matrix[row][static_cast<std::size_t>(j)] = value;
            rounded(i, j) = value;
        }
        for (std::size_t c = 0; c < sides; ++c) {
            const double value = normal(random);
            system.right[row][c] = value;
            right(i, static_cast<Eigen::Index>(c)) = value;
        }
    }
    solve_small_system<most, sides>(system, n);
    // Backward error: of each row, against its largest terms.
    for (std::size_t c = 0; c < sides; ++c) {
        for (Eigen::Index i = 0; i < size; ++i) {
            long double residual = -right(i, static_cast<Eigen::Index>(c));
            long double scale = std::abs(residual);
            for (Eigen::Index j = 0; j < size; ++j) {
                const long double term = rounded(i, j) * system.right[static_cast<std::size_t>(j)][c];
                residual += term;
                scale = std::max(scale, std::abs(term));
            }
            EXPECT_LT(std::abs(residual), 1e-13L * scale) << n << " unknowns, row " << i;
        }
    }
}

TEST(SmallSystem, SolvesWhatTouchesAsk) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 2000; ++trial) {
        const std::size_t n = 1 + random() % most;
        expect_solution<1>(random, n);
        expect_solution<2>(random, n);
    }
}

}  // namespace
}  // namespace jawari
