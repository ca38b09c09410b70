// The statistics that chaotic laws are judged by: its probabilities counted out, and how often it raises an
// alarm.
#include "support/two_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace jawari::test {
namespace {

TEST(TwoSamples, ChancesAreThoseOfAllOrders) {
    for (std::size_t n = 1; n <= 6; ++n) {
        std::vector<std::size_t> orders(n + 1, 0);  // with a lead of at least the index
        std::size_t all = 0;
        std::vector<int> from_a(2 * n, 0);
        std::fill(from_a.begin() + static_cast<std::ptrdiff_t>(n), from_a.end(), 1);
        do {
            std::vector<double> a, b;
            for (std::size_t i = 0; i < 2 * n; ++i)
                (from_a[i] == 1 ? a : b).push_back(static_cast<double>(i));
            for (std::size_t lead = lead_of_larger(a, b) + 1; lead-- > 0;) ++orders[lead];
            ++all;
        } while (std::next_permutation(from_a.begin(), from_a.end()));
        for (std::size_t lead = 0; lead <= n; ++lead) {
            const double counted = static_cast<double>(orders[lead]) / static_cast<double>(all);
            EXPECT_NEAR(chance_of_lead(n, lead), counted, 1e-14) << lead << " of " << n;
        }
    }
}

TEST(TwoSamples, SeesAShiftAndRaisesFewAlarms) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    const auto sample = [&](double shift) {
        std::vector<double> values(32);
        for (double& value : values) value = std::exp(10 * (normal(random) + shift));
        return values;
    };
    int alarms = 0, seen = 0;
    for (int trial = 0; trial < 10000; ++trial) {
        alarms += is_larger(sample(0), sample(0), 1e-2) ? 1 : 0;
        seen += is_larger(sample(3), sample(0), 1e-9) ? 1 : 0;
    }
    EXPECT_LE(alarms, 150);  // 100 and five standard deviations
    EXPECT_GE(seen, 8000);
}

TEST(TwoSamples, EqualValuesAreNotLarger) {
    EXPECT_FALSE(is_larger({1, 1, 1, 1}, {1, 1, 1, 1}, 1));
    EXPECT_FALSE(is_larger({1, 1, 1, 1}, {2, 2, 2, 2}, 1));
    EXPECT_TRUE(is_larger({2, 2, 2, 2}, {1, 1, 1, 1}, 0.02));
}

}  // namespace
}  // namespace jawari::test
