// The complementarity solver where rounding is felt: contacts that nearly coincide, solved again and again
// with the same active set, and violations near the smallest numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "jawari/detail/lcp.h"

namespace jawari {
namespace {

/// Gram matrix of smooth shapes at the places: the nearer two places, the more alike their rows.
std::vector<double> delassus(const std::vector<double>& places) {
    const std::size_t n = places.size();
    std::vector<double> A(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            long double sum = 0;
            for (int k = 1; k <= 60; ++k) sum += std::sin(k * places[i]) * std::sin(k * places[j]);
            A[i * n + j] = static_cast<double>(sum);
        }
    }
    return A;
}

/// max_c |min(r + A lambda, A_cc lambda)| in long double.
double residual_of(const std::vector<double>& A, const std::vector<double>& r,
                   const std::vector<double>& lambda) {
    const std::size_t n = r.size();
    long double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        long double gap = r[i];
        for (std::size_t j = 0; j < n; ++j) gap += static_cast<long double>(A[i * n + j]) * lambda[j];
        worst = std::max(worst, std::abs(std::min(gap, static_cast<long double>(A[i * n + i]) * lambda[i])));
    }
    return static_cast<double>(worst);
}

/// One operator, solved again and again, each time from the last solution.
struct RepeatedSolves {
    std::vector<double> A;
    std::vector<std::uint32_t> candidates;
    std::vector<double> lambda, residual;
    LcpWorkspace workspace;

    explicit RepeatedSolves(std::vector<double> op, std::size_t contacts)
        : A(std::move(op)),
          candidates(contacts),
          lambda(contacts, 0.0),
          residual(contacts, 0.0),
          workspace(make_lcp_workspace(contacts)) {
        std::iota(candidates.begin(), candidates.end(), 0U);
    }

    /// The problem that impulses of the first contacts solve with all gaps closed; returns the pivots it
    /// took.
    std::size_t expect_solved(const std::vector<double>& impulses) {
        const std::size_t n = candidates.size();
        std::vector<double> r(n, 0.0);
        for (std::size_t j = 0; j < impulses.size(); ++j) {
            for (std::size_t i = 0; i < n; ++i) r[i] -= A[i * n + j] * impulses[j];
        }
        const double violation = -*std::min_element(r.begin(), r.end());
        const LcpOutcome outcome =
            solve_lcp({A.data(), n, nullptr, 1}, r, candidates, lambda, residual, workspace);
        EXPECT_TRUE(outcome.finished);
        EXPECT_LE(residual_of(A, r, lambda), 1e-9 * violation);
        return outcome.pivots;
    }
};

/// The inverse that a lasting active set gets loses more than its factor does.
TEST(LcpRounding, SetsOfNearlyCoincidentContactsLast) {
    for (const double distance : {1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8}) {
        const std::vector<double> places{0.5, 0.5 + distance, 1.3, 1.3 + distance, 1.3 + 2 * distance, 2.2};
        RepeatedSolves solves(delassus(places), places.size());
        std::mt19937 random(7);
        std::uniform_real_distribution<double> impulse(0.5, 1);
        std::vector<double> impulses(places.size());
        for (int solve = 0; solve < 40; ++solve) {
            SCOPED_TRACE(testing::Message() << distance << " solve " << solve);
            for (double& x : impulses) x = impulse(random);
            solves.expect_solved(impulses);
        }
    }
}

/// A string pinched between obstacles that lie close together: impulses that nearly cancel, so that no gap is
/// known better than to the rounding of their products; and each contact has a twin at the same place.
TEST(LcpRounding, TwinsOfPinchingContactsAreNoViolations) {
    const std::vector<double> sides{1, -1, 1, 1, -1, 1};
    const std::size_t n = sides.size();
    for (const double distance : {2e-3, 1e-3, 5e-4, 2e-4}) {
        std::vector<double> A =
            delassus({0.5, 0.5 + distance, 0.5 + 2 * distance, 0.5, 0.5 + distance, 0.5 + 2 * distance});
        for (std::size_t i = 0; i < n * n; ++i) A[i] *= sides[i / n] * sides[i % n];
        RepeatedSolves solves(std::move(A), n);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> strength(0.5, 2);
        std::size_t pivots = 0;
        for (int solve = 0; solve < 200; ++solve) {
            SCOPED_TRACE(testing::Message() << distance << " solve " << solve);
            const double impulse = strength(random);
            pivots += solves.expect_solved({impulse, 2 * impulse, impulse});  // nearly a second difference
        }
        EXPECT_LE(pivots, 200U) << distance;
    }
}

/// Whatever the size of the numbers, a solve is the same problem, until its tolerance would underflow: then
/// there is nothing to do.
TEST(LcpRounding, ScalesDownToTheSmallestNumbers) {
    const std::vector<double> A = delassus({0.5, 0.9, 1.6, 2.2});
    const std::vector<std::uint32_t> candidates{0, 1, 2, 3};
    const std::vector<double> large{-1, 0.2, -0.5, -0.1};
    std::vector<double> expected(4, 0.0), residual(4, 0.0);
    LcpWorkspace workspace = make_lcp_workspace(4);
    ASSERT_TRUE(solve_lcp({A.data(), 4}, large, candidates, expected, residual, workspace).finished);
    for (int exponent = 15; exponent <= 315; exponent += 15) {
        const double scale = std::pow(10.0, -exponent);
        std::vector<double> r(4);
        for (std::size_t i = 0; i < 4; ++i) r[i] = scale * large[i];
        std::vector<double> lambda(4, 0.0);
        LcpWorkspace fresh = make_lcp_workspace(4);
        const LcpOutcome outcome = solve_lcp({A.data(), 4}, r, candidates, lambda, residual, fresh);
        EXPECT_TRUE(outcome.finished) << exponent;
        EXPECT_LE(outcome.pivots, 8U) << exponent;
        for (std::size_t i = 0; i < 4; ++i) {
            const double wanted = exponent < 280 ? expected[i] * scale : 0.0;
            EXPECT_NEAR(lambda[i], wanted, 1e-12 * scale) << exponent << " " << i;
        }
    }
}

}  // namespace
}  // namespace jawari
