// Block pivots: against the taut string over a parabola, whose shape and forces are in closed form, and by
// the conditions that define a solution.
#include "string/compile/block_pivots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <random>
#include <vector>

namespace jawari {
namespace {

/// A dense operator and its values.
struct Dense {
    explicit Dense(std::size_t n) : values(n * n), size(n) {}
    double& at(std::size_t i, std::size_t j) { return values[i * size + j]; }
    [[nodiscard]] ContactOperator view() const { return {values.data(), size}; }

    std::vector<double> values;
    std::size_t size;
};

double residual(const Dense& A, const std::vector<double>& r, const std::vector<double>& lambda,
                std::size_t row) {
    double sum = r[row];
    for (std::size_t j = 0; j < r.size(); ++j) sum += A.values[row * A.size + j] * lambda[j];
    return sum;
}

/// A flexible string of length and tension 1 over n points at height(x): the deflection at x under a unit
/// force at y is min(x, y) (1 - max(x, y)).
Dense flexible_string(const std::vector<double>& x) {
    Dense A(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = 0; j < x.size(); ++j)
            A.at(i, j) = std::min(x[i], x[j]) * (1 - std::max(x[i], x[j]));
    }
    return A;
}

TEST(BlockPivots, TautStringOverAParabola) {
    // Over y = top - bend (x - 1/2)^2 the string is straight to the point of the tangent through its end,
    // x_t = sqrt((bend/4 - top)/bend); from there on each point carries 2 bend spacing.
    const double top = 0.01, bend = 0.09;
    const double tangent = std::sqrt((bend / 4 - top) / bend);
    for (const std::size_t points : std::initializer_list<std::size_t>{63, 400, 1001}) {
        const double spacing = 1 / static_cast<double>(points + 1);
        std::vector<double> x(points), gap(points);
        for (std::size_t i = 0; i < points; ++i) {
            x[i] = spacing * static_cast<double>(i + 1);
            gap[i] = -(top - bend * (x[i] - 0.5) * (x[i] - 0.5));
        }
        const auto force = guess_by_block_pivots(flexible_string(x).view(), gap);
        for (std::size_t i = 0; i < points; ++i) {
            const double inside = std::min(x[i], 1 - x[i]) - tangent;
            if (inside < -spacing) {
                EXPECT_EQ(force[i], 0) << x[i];
            } else if (inside > spacing) {
                EXPECT_NEAR(force[i], 2 * bend * spacing, 1e-9 * bend) << x[i];
            }
        }
    }
}

TEST(BlockPivots, UpToAFewHundredContactsEndSolved) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const std::size_t size : std::initializer_list<std::size_t>{1, 20, 64, 65, 130, 256}) {
        Dense B(size), A(size);
        for (auto& value : B.values) value = uniform(random);
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t j = 0; j < size; ++j) {
                for (std::size_t k = 0; k < size; ++k) A.at(i, j) += B.at(i, k) * B.at(j, k);
            }
            A.at(i, i) += 0.1;
        }
        std::vector<double> r(size);
        for (auto& value : r) value = uniform(random);
        const auto lambda = guess_by_block_pivots(A.view(), r);
        for (std::size_t i = 0; i < size; ++i) {
            const double w = residual(A, r, lambda, i);
            EXPECT_GE(lambda[i], 0) << size;
            EXPECT_GE(w, -1e-9) << size;
            EXPECT_TRUE(lambda[i] == 0 || w < 1e-9) << size << ": " << w;
        }
    }
}

TEST(BlockPivots, NothingPenetratesNothingCarries) {
    const std::vector<double> x{0.25, 0.5, 0.75}, gap{0.0, 0.1, 0.2};
    EXPECT_EQ(guess_by_block_pivots(flexible_string(x).view(), gap), std::vector<double>(3, 0.0));
}

TEST(BlockPivots, OfDependentContactsNothingIsGuessed) {
    const std::vector<double> x{0.5, 0.5}, gap{-0.1, -0.1};
    EXPECT_EQ(guess_by_block_pivots(flexible_string(x).view(), gap), std::vector<double>(2, 0.0));
}

}  // namespace
}  // namespace jawari
