// Active sets beyond the factor: the solution is unique where the operator is definite, so that the
// optimality conditions, evaluated in long double, are the oracle; and strings whose landing is known.
#include "string/solver/projected_gradients.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace jawari {
namespace {

struct Solved {
    LcpOutcome outcome;
    std::vector<double> lambda;
    std::size_t active = 0;
    double worst_gap = 0;      ///< below zero, as a share of the worst violation
    double worst_product = 0;  ///< of a gap and an impulse that should exclude each other, the same
};

Solved solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& r, std::vector<double> guess = {}) {
    const auto n = static_cast<std::size_t>(r.size());
    std::vector<std::uint32_t> candidates(n);
    std::iota(candidates.begin(), candidates.end(), 0U);
    std::vector<double> residual(n);
    guess.resize(n, 0.0);
    Solved solved;
    solved.lambda = std::move(guess);
    LcpLimits limits;
    limits.independent = n;
    LcpWorkspace workspace = make_lcp_workspace(n, limits);
    const Eigen::MatrixXd symmetric = (A + A.transpose()) / 2;
    ContactOperator op;
    op.values = symmetric.data();
    op.stride = n;
    solved.outcome = solve_lcp(op, {r.data(), n}, candidates, solved.lambda, residual, workspace);
    const long double size = -r.minCoeff();
    for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        long double gap = r[row];
        for (std::size_t j = 0; j < n; ++j)
            gap += static_cast<long double>(symmetric(row, static_cast<Eigen::Index>(j))) * solved.lambda[j];
        EXPECT_GE(solved.lambda[i], 0);
        if (solved.lambda[i] > 0) {
            solved.active += 1;
            solved.worst_product = std::max(solved.worst_product, static_cast<double>(std::abs(gap) / size));
        }
        solved.worst_gap = std::max(solved.worst_gap, static_cast<double>(-gap / size));
    }
    return solved;
}

/// S S^T for contacts on a stretch of a string of so many modes.
Eigen::MatrixXd contacts_on(double from, double to, Eigen::Index contacts, Eigen::Index modes) {
    Eigen::MatrixXd S(contacts, modes);
    for (Eigen::Index c = 0; c < contacts; ++c) {
        const double x = from + (to - from) * static_cast<double>(c + 1) / static_cast<double>(contacts + 1);
        for (Eigen::Index k = 0; k < modes; ++k)
            S(c, k) = std::sqrt(2.0) * std::sin(static_cast<double>(k + 1) * std::numbers::pi * x);
    }
    return S * S.transpose();
}

Eigen::VectorXd pressed(Eigen::Index n, double share, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i)
        r[i] = 0.3 * normal(random) - (static_cast<double>(i) < share * static_cast<double>(n) ? 1.0 : -1.0);
    return r;
}

TEST(ProjectedGradients, MeetTheOptimalityConditionsWhereContactsAreIndependent) {
    std::mt19937_64 random(1);
    for (const Eigen::Index n : {200, 400, 700}) {
        const Eigen::MatrixXd A = contacts_on(0, 1, n, n + 100);
        const Solved solved = solve(A, pressed(n, 0.7, random));
        EXPECT_TRUE(solved.outcome.finished);
        EXPECT_GT(solved.active, largest_factor) << n;
        EXPECT_LE(solved.worst_gap, 2e-13) << n;
        EXPECT_LE(solved.worst_product, 2e-13) << n;
    }
}

TEST(ProjectedGradients, MeetThemWhereContactsOutnumberTheModes) {
    // The operator is singular; r + A lambda is still unique. Pivots finish what the gradients leave.
    const Eigen::Index n = 600;
    const Eigen::MatrixXd A = contacts_on(0, 1, n, 300);
    for (const double margin : {0.0, 0.1}) {
        Eigen::VectorXd r(n);
        for (Eigen::Index c = 0; c < n; ++c) {
            const double x = static_cast<double>(c + 1) / static_cast<double>(n + 1);
            r[c] = x > margin && x < 1 - margin ? -1.0 : 1.0;
        }
        const Solved solved = solve(A, r);
        EXPECT_TRUE(solved.outcome.finished) << margin;
        EXPECT_GT(solved.active, largest_factor) << margin;
        EXPECT_LE(solved.worst_gap, 1e-12) << margin;
        EXPECT_LE(solved.worst_product, 1e-12) << margin;
    }
}

TEST(ProjectedGradients, AGoodGuessCostsFewRounds) {
    std::mt19937_64 random(3);
    const Eigen::Index n = 400;
    const Eigen::MatrixXd A = contacts_on(0, 1, n, n + 100);
    Eigen::VectorXd r = pressed(n, 0.7, random);
    const Solved first = solve(A, r);
    r *= 1 + 1e-6;
    const Solved second = solve(A, r, first.lambda);
    EXPECT_TRUE(second.outcome.finished);
    EXPECT_LT(second.outcome.pivots, first.outcome.pivots);
}

TEST(ProjectedGradients, SmallProblemsAreLeftToTheFactor) {
    std::mt19937_64 random(4);
    const Eigen::Index n = 300;
    const Solved solved = solve(contacts_on(0, 1, n, n + 100), pressed(n, 0.2, random));
    EXPECT_TRUE(solved.outcome.finished);
    EXPECT_LE(solved.active, largest_factor);
    EXPECT_LE(solved.worst_product, 2e-13);
}

TEST(ProjectedGradients, ContradictoryContactsEndInBoundedWork) {
    // Pressed from both sides at one place: no impulses satisfy both.
    const Eigen::Index n = 300;
    Eigen::MatrixXd A = contacts_on(0, 1, n, n + 100);
    for (Eigen::Index i = 1; i < n; i += 2) {
        A.row(i) = -A.row(i - 1);
        A.col(i) = -A.col(i - 1);
    }
    const Solved solved = solve(A, Eigen::VectorXd::Constant(n, -1.0));
    EXPECT_FALSE(solved.outcome.finished);
    EXPECT_LE(solved.outcome.pivots, most_gradient_rounds + most_pivots(largest_factor));
    for (const double lambda : solved.lambda) EXPECT_TRUE(std::isfinite(lambda));
}

TEST(ProjectedGradients, TheBoundOfTheNormHoldsItsEigenvalues) {
    for (const Eigen::Index n : {20, 90}) {
        const Eigen::MatrixXd A = contacts_on(0.1, 0.5, n, 150);
        const Eigen::VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
        const double largest =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * A * scale.asDiagonal())
                .eigenvalues()
                .maxCoeff();
        ContactOperator op;
        op.values = A.data();
        op.stride = static_cast<std::size_t>(n);
        std::vector<std::uint32_t> contacts(static_cast<std::size_t>(n));
        std::iota(contacts.begin(), contacts.end(), 0U);
        EXPECT_GE(bound_of_norm(op, contacts), largest * (1 - 1e-12));
    }
}

}  // namespace
}  // namespace jawari
