// The complementarity solver against enumeration of all active sets, against the optimality conditions
// themselves (necessary and sufficient for a semidefinite A), and against its promises: bounded, never
// negative, never NaN.
#include "jawari/detail/lcp.h"
#include "support/test_names.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

namespace jawari {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

struct Problem {
    Eigen::MatrixXd A;
    Eigen::VectorXd r;
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(r.size()); }
};

struct Solution {
    LcpOutcome outcome;
    std::vector<double> lambda;
    std::vector<double> residual;
};

/// Solves with rows `stride` apart; `guess` is the warm start.
Solution solve(const Problem& problem, std::vector<double> guess, std::size_t capacity,
               std::size_t padding = 0, std::size_t gradient_rounds = most_gradient_rounds) {
    const std::size_t n = problem.size();
    const std::size_t stride = n + padding;
    std::vector<double> A(n * stride, std::nan(""));  // what lies between the rows must not be read
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            A[i * stride + j] = problem.A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
    }
    std::vector<std::uint32_t> candidates(n);
    std::iota(candidates.begin(), candidates.end(), 0U);
    const std::vector<double> r(problem.r.data(), problem.r.data() + n);
    Solution solution{{}, std::move(guess), std::vector<double>(n, 0.0)};
    solution.lambda.resize(n, 0.0);
    LcpWorkspace workspace = make_lcp_workspace(n, {capacity, capacity, gradient_rounds});
    solution.outcome =
        solve_lcp({A.data(), stride}, r, candidates, solution.lambda, solution.residual, workspace);
    return solution;
}

Solution solve(const Problem& problem) {
    return solve(problem, {}, problem.size());
}

/// r + A lambda in long double, from the problem and lambda alone.
LongVector gaps_of(const Problem& problem, const std::vector<double>& lambda) {
    LongVector x(problem.r.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = lambda[static_cast<std::size_t>(i)];
    return problem.r.cast<long double>() + problem.A.cast<long double>() * x;
}

/// The unique r + A lambda of the problem, found by trying every active set; nothing if no set is feasible.
std::optional<LongVector> by_enumeration(const Problem& problem, long double tolerance) {
    const Eigen::Index n = problem.r.size();
    const LongMatrix A = problem.A.cast<long double>();
    const LongVector r = problem.r.cast<long double>();
    for (unsigned set = 0; set < 1U << n; ++set) {
        std::vector<Eigen::Index> active;
        for (Eigen::Index i = 0; i < n; ++i) {
            if ((set >> i & 1U) != 0) active.push_back(i);
        }
        LongVector lambda = LongVector::Zero(n);
        if (!active.empty()) {
            Eigen::FullPivLU<LongMatrix> factor{LongMatrix(A(active, active))};
            factor.setThreshold(1e-13L);           // A is singular to double precision only
            if (!factor.isInvertible()) continue;  // some solution always has an invertible active block
            const LongVector active_r = r(active);
            lambda(active) = factor.solve(-active_r);
        }
        const LongVector y = r + A * lambda;
        if ((lambda.array() >= 0).all() && y.minCoeff() >= -tolerance) return y;
    }
    return {};
}

enum class Family { Definite, RankDeficient, Coincident, NearlyCoincident, BadlyScaled, IllConditioned };

const char* name_of(Family family) {
    constexpr const char* names[] = {"Definite",         "RankDeficient", "Coincident",
                                     "NearlyCoincident", "BadlyScaled",   "IllConditioned"};
    return names[static_cast<int>(family)];
}

struct RandomProblem {
    std::mt19937_64 random;
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform{0, 1};

    explicit RandomProblem(std::uint64_t seed) : random(seed) {}
    bool coin() { return random() % 2 == 0; }

    /// Gram matrix of n vectors, each a contact's row weighted by the modes' mobility.
    Eigen::MatrixXd matrix(Family family, Eigen::Index n) {
        const bool deficient = family == Family::RankDeficient;
        const Eigen::Index m =
            deficient ? 1 + static_cast<Eigen::Index>(random() % static_cast<unsigned>(n)) : n + 3;
        Eigen::MatrixXd B(m, n);
        for (Eigen::Index i = 0; i < B.size(); ++i) B.data()[i] = normal(random);
        for (Eigen::Index j = 1; j < n; ++j) {
            const auto other = static_cast<Eigen::Index>(random() % static_cast<unsigned>(j));
            if (family == Family::Coincident && coin()) B.col(j) = B.col(other);
            if (family == Family::NearlyCoincident && coin()) {
                B.col(j) = B.col(other) + std::pow(10, -1 - 3 * uniform(random)) * B.col(j);
            }
        }
        if (family == Family::BadlyScaled) {
            for (Eigen::Index j = 0; j < n; ++j) B.col(j) *= std::pow(10, -3 * uniform(random));
        }
        if (family == Family::IllConditioned) {
            for (Eigen::Index i = 0; i < m; ++i)
                B.row(i) *= std::pow(10, -3.0 * static_cast<double>(i) / static_cast<double>(m));
        }
        return B.transpose() * B;
    }

    /// A problem with a solution: r = y - A lambda with y, lambda >= 0, not complementary, so that the
    /// solver's differs.
    Problem feasible(Family family, Eigen::Index n) {
        Problem problem{matrix(family, n), Eigen::VectorXd(n)};
        Eigen::VectorXd lambda(n);
        Eigen::VectorXd y(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            lambda[i] = coin() ? uniform(random) : 0;
            y[i] = coin() ? uniform(random) * problem.A(i, i) : 0;
        }
        problem.r = y - problem.A * lambda;
        return problem;
    }

    /// Whole numbers, so that A is singular without rounding; may have no solution.
    Problem integral(Eigen::Index n) {
        std::uniform_int_distribution<int> digit(-4, 4);
        Eigen::MatrixXd B(1 + static_cast<Eigen::Index>(random() % static_cast<unsigned>(n)), n);
        for (Eigen::Index i = 0; i < B.size(); ++i) B.data()[i] = digit(random);
        Problem problem{B.transpose() * B, Eigen::VectorXd(n)};
        for (Eigen::Index i = 0; i < n; ++i) {
            problem.r[i] = digit(random);
            problem.A(i, i) += problem.A(i, i) == 0 ? 1 : 0;  // every contact can move the string
        }
        return problem;
    }

    std::vector<double> guess(std::size_t n) {
        std::vector<double> lambda(n);
        for (double& x : lambda) x = coin() ? 2 * uniform(random) : 0;
        return lambda;
    }
};

class LcpFamily : public testing::TestWithParam<Family> {};

TEST_P(LcpFamily, AgreesWithEnumerationOfAllActiveSets) {
    std::size_t pressed = 0;
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
        RandomProblem random(seed);
        const auto n = static_cast<Eigen::Index>(1 + random.random() % 9);
        const Problem problem = random.feasible(GetParam(), n);
        const double size = problem.r.cwiseAbs().maxCoeff();
        const auto expected = by_enumeration(problem, 1e-15L * size);
        if (!expected)
            continue;  // rounding of r may leave a degenerate problem without an exactly feasible set
        const Solution solution =
            solve(problem, random.guess(problem.size()), problem.size(), random.random() % 5);
        ASSERT_TRUE(solution.outcome.finished) << "seed " << seed;
        const LongVector y = gaps_of(problem, solution.lambda);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double lambda = solution.lambda[static_cast<std::size_t>(i)];
            ASSERT_GE(lambda, 0) << "seed " << seed;
            ASSERT_NEAR(static_cast<double>(y[i]), static_cast<double>((*expected)[i]), 1e-9 * size)
                << "seed " << seed;
            ASSERT_LE(std::abs(y[i]) * (lambda > 0 ? 1 : 0), 1e-10 * size) << "seed " << seed;
            pressed += lambda > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(pressed, 2000U);
}

TEST_P(LcpFamily, MeetsTheOptimalityConditionsAndReportsTheirResidual) {
    for (std::uint64_t seed = 5000; seed < 5600; ++seed) {
        RandomProblem random(seed);
        const auto n = static_cast<Eigen::Index>(10 + random.random() % 30);
        const Problem problem = random.feasible(GetParam(), n);
        const double size = problem.r.cwiseAbs().maxCoeff();
        const Solution solution = solve(problem, random.guess(problem.size()), problem.size());
        ASSERT_TRUE(solution.outcome.finished) << "seed " << seed;
        const LongVector y = gaps_of(problem, solution.lambda);
        long double natural = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto c = static_cast<std::size_t>(i);
            natural = std::max(natural,
                               std::abs(std::min<long double>(y[i], problem.A(i, i) * solution.lambda[c])));
            EXPECT_NEAR(static_cast<double>(y[i]), solution.residual[c], 1e-10 * size);
        }
        EXPECT_LE(natural, 1e-10 * size) << "seed " << seed;
        EXPECT_NEAR(static_cast<double>(natural), solution.outcome.residual, 1e-11 * size) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Families, LcpFamily,
                         testing::Values(Family::Definite, Family::RankDeficient, Family::Coincident,
                                         Family::NearlyCoincident, Family::BadlyScaled,
                                         Family::IllConditioned),
                         test::named);

TEST(Lcp, FinishesExactlyWhenTheProblemHasASolution) {
    // What Lemke's method guarantees for semidefinite A: a solution, or proof that none exists.
    int with = 0;
    int without = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        RandomProblem random(seed);
        const Eigen::Index n = 1 + static_cast<Eigen::Index>(random.random() % 8);
        const Problem problem = random.integral(n);
        const bool solvable = by_enumeration(problem, 1e-12L).has_value();
        const Solution solution = solve(problem, random.guess(problem.size()), problem.size());
        EXPECT_EQ(solution.outcome.finished, solvable) << "seed " << seed;
        for (const double lambda : solution.lambda) {
            EXPECT_GE(lambda, 0);
            EXPECT_TRUE(std::isfinite(lambda));
        }
        (solvable ? with : without) += 1;
    }
    EXPECT_GT(with, 300);
    EXPECT_GT(without, 300);
}

TEST(Lcp, SolvesProblemsDoneByHand) {
    // One contact: lambda = -r/a.
    EXPECT_DOUBLE_EQ(
        solve({Eigen::MatrixXd::Constant(1, 1, 4.0), Eigen::VectorXd::Constant(1, -2.0)}).lambda[0], 0.5);
    EXPECT_EQ(solve({Eigen::MatrixXd::Constant(1, 1, 4.0), Eigen::VectorXd::Constant(1, 2.0)}).lambda[0], 0);
    // Two: the first's impulse opens the second.
    Problem two{Eigen::MatrixXd{{2, 1}, {1, 2}}, Eigen::VectorXd{{-4, -1}}};
    EXPECT_DOUBLE_EQ(solve(two).lambda[0], 2);
    EXPECT_EQ(solve(two).lambda[1], 0);
    // Two that press together: [2 1; 1 2] lambda = (4, 5).
    two.r = Eigen::VectorXd{{-4, -5}};
    EXPECT_NEAR(solve(two).lambda[0], 1, 1e-14);
    EXPECT_NEAR(solve(two).lambda[1], 2, 1e-14);
}

TEST(Lcp, OfCoincidentContactsTheHigherOneCarriesTheImpulse) {
    const Problem problem{Eigen::MatrixXd::Constant(3, 3, 2.0), Eigen::VectorXd{{-1, -3, -2}}};
    for (const std::vector<double>& guess : {std::vector<double>{0, 0, 0}, {5, 0, 0}, {1, 1, 1}, {0, 0, 9}}) {
        const Solution solution = solve(problem, guess, 3);
        ASSERT_TRUE(solution.outcome.finished);
        EXPECT_NEAR(solution.lambda[0], 0, 1e-15);
        EXPECT_NEAR(solution.lambda[1], 1.5, 1e-15);
        EXPECT_NEAR(solution.lambda[2], 0, 1e-15);
    }
}

TEST(Lcp, TouchesOnlyCandidates) {
    RandomProblem random(7);
    const Problem problem = random.feasible(Family::Definite, 9);
    std::vector<double> A(81);
    for (Eigen::Index i = 0; i < 9; ++i) {
        for (Eigen::Index j = 0; j < 9; ++j) A[static_cast<std::size_t>(9 * i + j)] = problem.A(i, j);
    }
    const std::vector<std::uint32_t> candidates{6, 1, 4};
    std::vector<double> r(9, std::nan(""));
    std::vector<double> lambda(9, 0.0);
    std::vector<double> residual(9, -7.0);
    Problem part{Eigen::MatrixXd(3, 3), Eigen::VectorXd{{-1, -2, 0.5}}};
    for (Eigen::Index i = 0; i < 3; ++i) {
        r[candidates[static_cast<std::size_t>(i)]] = part.r[i];
        for (Eigen::Index j = 0; j < 3; ++j) {
            part.A(i, j) =
                problem.A(candidates[static_cast<std::size_t>(i)], candidates[static_cast<std::size_t>(j)]);
        }
    }
    LcpWorkspace workspace = make_lcp_workspace(9);
    ASSERT_TRUE(solve_lcp({A.data(), 9}, r, candidates, lambda, residual, workspace).finished);
    const Solution expected = solve(part);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(lambda[candidates[i]], expected.lambda[i], 1e-12);
    for (const std::size_t other : {0U, 2U, 3U, 5U, 7U, 8U}) {
        EXPECT_EQ(lambda[other], 0);
        EXPECT_EQ(residual[other], -7);
    }
}

/// Memory is used again: what is kept of an operator must not serve another one at its address.
TEST(Lcp, AnOperatorInThePlaceOfAnotherIsSolvedAfresh) {
    const std::vector<std::uint32_t> candidates{0, 1};
    const std::vector<double> r{-1, -1};
    std::vector<double> A{2, 0, 0, 2}, lambda(2, 0.0), residual(2, 0.0);
    LcpWorkspace workspace = make_lcp_workspace(2);
    for (int solve = 0; solve < 20; ++solve)  // long enough for the active set's inverse
        ASSERT_TRUE(
            solve_lcp({A.data(), 2, nullptr, 7}, r, candidates, lambda, residual, workspace).finished);
    EXPECT_NEAR(lambda[0], 0.5, 1e-15);
    A = {8, 1, 1, 4};
    ASSERT_TRUE(solve_lcp({A.data(), 2, nullptr, 9}, r, candidates, lambda, residual, workspace).finished);
    EXPECT_NEAR(lambda[0], 3.0 / 31, 1e-15);
    EXPECT_NEAR(lambda[1], 7.0 / 31, 1e-15);
    A = {1, 0, 0, 1};
    ASSERT_TRUE(solve_lcp({A.data(), 2}, r, candidates, lambda, residual, workspace).finished);
    EXPECT_NEAR(lambda[0], 1, 1e-15);
    EXPECT_EQ(workspace.factored, 0U);
}

/// The Delassus operator of a string with contacts at the given places, all modes weighing the same, and gaps
/// that close the more the nearer the middle of the string.
Problem neck(std::size_t contacts, int modes, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto n = static_cast<Eigen::Index>(contacts);
    Eigen::MatrixXd S(n, modes);
    Eigen::VectorXd r(n);
    for (Eigen::Index c = 0; c < n; ++c) {
        const double x = (static_cast<double>(c) + 1) / (static_cast<double>(n) + 1);
        for (Eigen::Index k = 0; k < modes; ++k)
            S(c, k) = std::sin(std::numbers::pi * static_cast<double>(k + 1) * x);
        r[c] = 1e-6 * (uniform(random) - 0.6 * std::sin(std::numbers::pi * x));
    }
    return {S * S.transpose(), r};
}

TEST(Lcp, LargeNecksMeetTheOptimalityConditions) {
    // A necessary and sufficient certificate, in long double, where enumeration is out of reach.
    std::mt19937_64 random(4);
    std::size_t most_pressed = 0;
    for (const std::size_t contacts : {128UL, 200UL, 300UL, 400UL}) {
        for (const double coverage : {1.0, 1.5}) {
            const Problem problem =
                neck(contacts, static_cast<int>(coverage * static_cast<double>(contacts)), random);
            const Solution solution = solve(problem);
            ASSERT_TRUE(solution.outcome.finished) << contacts;
            const LongVector y = gaps_of(problem, solution.lambda);
            std::size_t pressed = 0;
            for (std::size_t c = 0; c < contacts; ++c) {
                const double gap = static_cast<double>(y[static_cast<Eigen::Index>(c)]);
                EXPECT_GE(gap, -1e-18) << contacts;
                EXPECT_GE(solution.lambda[c], 0);
                EXPECT_LE(solution.lambda[c] > 0 ? gap : 0, 1e-18) << contacts;
                pressed += solution.lambda[c] > 0 ? 1 : 0;
            }
            most_pressed = std::max(most_pressed, pressed);
        }
    }
    EXPECT_GT(most_pressed, 100U);
}

TEST(Lcp, AgreesWithManyProjectedGaussSeidelSweeps) {
    std::mt19937_64 random(5);
    const Problem problem = neck(150, 300, random);
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(150);
    for (int sweep = 0; sweep < 5000; ++sweep) {
        for (Eigen::Index c = 0; c < 150; ++c) {
            const double y = problem.r[c] + problem.A.row(c).dot(lambda);
            lambda[c] = std::max(0.0, lambda[c] - y / problem.A(c, c));
        }
    }
    const Solution solution = solve(problem);
    ASSERT_TRUE(solution.outcome.finished);
    for (Eigen::Index c = 0; c < 150; ++c) {
        EXPECT_NEAR(solution.lambda[static_cast<std::size_t>(c)], lambda[c], 1e-9 * lambda.maxCoeff()) << c;
    }
}

TEST(Lcp, AStoppedSolveIsFeasible) {
    // More active contacts than the factor has room for, and one round of projected gradients.
    std::mt19937_64 random(6);
    for (const std::size_t capacity : {0U, 1U, 3U, 20U}) {
        const Problem problem = neck(120, 200, random);
        RandomProblem guesses(capacity);
        for (const auto& guess : {std::vector<double>(120, 0.0), guesses.guess(120)}) {
            const Solution solution = solve(problem, guess, capacity, 0, 1);
            EXPECT_FALSE(solution.outcome.finished) << capacity;
            EXPECT_LE(solution.outcome.pivots, 1U);
            for (const double lambda : solution.lambda) ASSERT_TRUE(lambda >= 0 && std::isfinite(lambda));
        }
    }
}

/// Rows of sizes from 1 to 1e-6 that depend on one another: rounding decides which of them can still move.
void solve_hostile_problems() {
    for (std::uint64_t seed = 0; seed < 40000; ++seed) {
        RandomProblem random(seed);
        const auto n = static_cast<Eigen::Index>(1 + random.random() % 24);
        Problem problem = random.feasible(Family::RankDeficient, n);
        Eigen::VectorXd scale(n);
        for (Eigen::Index i = 0; i < n; ++i) scale[i] = std::pow(10, -6 * random.uniform(random.random));
        problem.A = scale.asDiagonal() * problem.A * scale.asDiagonal();
        problem.r = scale.asDiagonal() * problem.r;
        const Solution solution = solve(problem, random.guess(problem.size()), problem.size());
        EXPECT_LE(solution.outcome.pivots, 4 * problem.size() + 16);
        for (const double lambda : solution.lambda) EXPECT_TRUE(lambda >= 0 && std::isfinite(lambda));
    }
}

TEST(Lcp, EverySolveEnds) {
    // In a process of its own, so that a solver that pivots for ever fails the test instead of hanging it.
    EXPECT_EXIT(
        {
            alarm(600);
            solve_hostile_problems();
            std::exit(testing::Test::HasFailure() ? 1 : 0);
        },
        testing::ExitedWithCode(0), "");
}

TEST(Lcp, ContradictingObstaclesNeverFinishAndNeverSpreadNaN) {
    // The same point pressed from below and from above: y = r1 + a l1 - a l2 >= 0 and r2 - a l1 + a l2 >= 0.
    for (const double a : {1e-9, 1.0, 1e9}) {
        const Problem problem{Eigen::MatrixXd{{a, -a}, {-a, a}}, Eigen::VectorXd{{-1e-3, -1e-3}}};
        for (const auto& guess : {std::vector<double>{0, 0}, {1, 0}, {1, 1}, {1e300, 0}}) {
            const Solution solution = solve(problem, guess, 2);
            EXPECT_FALSE(solution.outcome.finished);
            for (const double lambda : solution.lambda) EXPECT_TRUE(lambda >= 0 && std::isfinite(lambda));
        }
    }
}

TEST(Lcp, WarmStartDoesNotChangeTheSolution) {
    std::mt19937_64 random(8);
    const Problem problem = neck(100, 160, random);
    const Solution cold = solve(problem);
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const Solution warm = solve(problem, RandomProblem(seed).guess(100), 100);
        ASSERT_TRUE(warm.outcome.finished);
        for (std::size_t c = 0; c < 100; ++c) EXPECT_NEAR(warm.lambda[c], cold.lambda[c], 1e-18);
    }
    // The solution itself as a guess needs no pivot.
    EXPECT_EQ(solve(problem, cold.lambda, 100).outcome.pivots, 0U);
}

TEST(Lcp, NothingToDoIsDone) {
    const Problem empty{Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)};
    EXPECT_TRUE(solve(empty).outcome.finished);
    const Solution open = solve({Eigen::MatrixXd::Identity(4, 4), Eigen::VectorXd::Constant(4, 1.0)});
    EXPECT_TRUE(open.outcome.finished);
    EXPECT_EQ(open.outcome.residual, 0);
    for (const double lambda : open.lambda) EXPECT_EQ(lambda, 0);
}

}  // namespace
}  // namespace jawari
