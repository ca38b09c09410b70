// The product of the Delassus operator and a vector against its sum, entry by entry in long double.
#include "string/kernels/response_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace jawari {
namespace {

struct Case {
    AlignedVector<double> values;
    std::vector<std::uint32_t> node;
    ContactOperator A;
};

Case dense(std::size_t n, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    Case made;
    made.A.stride = n + 3;
    made.values.assign(n * made.A.stride, std::nan(""));  // what lies between the rows must not be read
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            made.values[i * made.A.stride + j] = made.values[j * made.A.stride + i] = normal(random);
    }
    made.A.values = made.values.data();
    return made;
}

/// Nodes of a grid of 2 n intervals: long runs of neighbours, and gaps between them.
Case grid(std::size_t n, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    Case made;
    made.A.period = 4 * n;
    made.values.assign(made.A.period + grid_repeats, 0.0);
    for (std::size_t d = 0; d <= made.A.period / 2; ++d)
        made.values[d] = made.values[(made.A.period - d) % made.A.period] = normal(random);
    std::copy_n(made.values.begin(), grid_repeats,
                made.values.begin() + static_cast<std::ptrdiff_t>(made.A.period));
    std::uint32_t node = 1;
    for (std::size_t c = 0; c < n; ++c) {
        made.node.push_back(node);
        node += random() % 40 == 0 ? 2 : 1;
    }
    made.A.values = made.values.data();
    made.A.node = made.node.data();
    return made;
}

std::vector<std::uint32_t> some_of(std::size_t n, double share, std::mt19937_64& random) {
    std::bernoulli_distribution taken(share);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t c = 0; c < n; ++c) {
        if (taken(random)) indices.push_back(c);
    }
    return indices;
}

void compare(const Case& made, std::size_t n, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const auto sources = some_of(n, 0.5, random);
    auto targets = some_of(n, 0.95, random);
    if (random() % 3 == 0) std::shuffle(targets.begin(), targets.end(), random);
    std::vector<double> x(n, std::nan("")), out(n, 7.0);
    for (const auto c : sources) x[c] = normal(random);
    std::vector<long double> expected(out.begin(), out.end());
    for (const auto t : targets) {
        for (const auto s : sources) expected[t] += static_cast<long double>(made.A(t, s)) * x[s];
    }
    kernels::add_responses(made.A, sources, x.data(), targets, out.data());
    for (std::size_t c = 0; c < n; ++c)
        ASSERT_NEAR(out[c], static_cast<double>(expected[c]), 1e-13 * static_cast<double>(n)) << c;
}

TEST(ResponseSums, AreThoseOfTheMatrix) {
    std::mt19937_64 random(1);
    for (const std::size_t n : {1U, 2U, 7U, 16U, 33U, 150U, 301U}) {
        for (int trial = 0; trial < 20; ++trial) compare(dense(n, random), n, random);
    }
}

TEST(ResponseSums, AreThoseOfTheTableByDistance) {
    std::mt19937_64 random(2);
    for (const std::size_t n : {1U, 2U, 7U, 16U, 33U, 150U, 301U}) {
        for (int trial = 0; trial < 20; ++trial) compare(grid(n, random), n, random);
    }
}

}  // namespace
}  // namespace jawari
