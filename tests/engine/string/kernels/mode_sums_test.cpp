// Every kernel on every instruction set of this processor against plain long double loops.
#include "string/kernels/mode_sums.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "jawari/detail/aligned.h"

namespace jawari {
namespace {

using Values = AlignedVector<double>;

struct RandomValues {
    std::mt19937_64 random{42};
    Values operator()(std::size_t n) {
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> exponent(-8, 2);
        Values values(n);
        for (double& x : values) x = normal(random) * std::pow(10, exponent(random));
        return values;
    }
};

/// Instruction sets of which the kernels do not distinguish (by name) are visited once each.
void on_each_instruction_set(const std::function<void()>& test) {
    std::set<std::string> visited;
    const std::int64_t supported = hwy::SupportedTargets();
    for (std::int64_t targets = supported; targets != 0; targets &= targets - 1) {
        const std::int64_t target = targets & -targets;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(kernels::instruction_set());
        visited.insert(kernels::instruction_set());
        test();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    testing::Test::RecordProperty("instruction_sets", static_cast<int>(visited.size()));
    EXPECT_GE(visited.size(), 1U);
}

const std::vector<std::size_t> sizes{0, 8, 16, 24, 64, 104, 864};
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A sum of n terms in any order is right to n epsilon of the sum of their magnitudes.
void expect_sum(double sum, long double truth, long double magnitude, std::size_t n) {
    EXPECT_LE(std::abs(static_cast<double>(static_cast<long double>(sum) - truth)),
              static_cast<double>(magnitude) * epsilon * static_cast<double>(n + 2));
}

TEST(Kernels, FreeVelocity) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            const Values carry = random(n), change = random(n), restoring = random(n), q = random(n),
                         v = random(n);
            Values result(n);
            kernels::free_velocity(n, carry.data(), change.data(), restoring.data(), q.data(), v.data(),
                                   result.data());
            for (std::size_t k = 0; k < n; ++k) {
                const long double a = static_cast<long double>(carry[k]) * v[k];
                const long double b = static_cast<long double>(change[k]) * v[k];
                const long double c = static_cast<long double>(restoring[k]) * q[k];
                expect_sum(result[k], a + b + c, std::abs(a) + std::abs(b) + std::abs(c), 1);
            }
        }
    });
}

TEST(Kernels, FreeVelocityRoundsASmallChangeOnlyOnceAtFullSize) {
    // v + delta with |delta| << |v|: the result is the double nearest to the exact sum (to the rounding of
    // delta).
    on_each_instruction_set([] {
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> uniform(0.5, 1);
        const std::size_t n = 64;
        Values carry(n, 1.0), change(n), restoring(n), q(n), v(n);
        for (std::size_t k = 0; k < n; ++k) {
            change[k] = -1e-7 * uniform(random);
            restoring[k] = -1e-2 * uniform(random);
            q[k] = 1e-6 * uniform(random);
            v[k] = uniform(random);
        }
        Values result(n);
        kernels::free_velocity(n, carry.data(), change.data(), restoring.data(), q.data(), v.data(),
                               result.data());
        for (std::size_t k = 0; k < n; ++k) {
            const long double truth = static_cast<long double>(v[k]) +
                                      static_cast<long double>(change[k]) * v[k] +
                                      static_cast<long double>(restoring[k]) * q[k];
            EXPECT_LE(std::abs(static_cast<double>(result[k] - truth)), 0.5000001 * epsilon / 2);
        }
    });
}

TEST(Kernels, RowProducts) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            for (const std::size_t rows : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 8U, 21U}) {
                const std::size_t stride = n + 8;  // only the first n of each row take part
                Values matrix = random(rows * stride);
                const Values x = random(n);
                std::vector<std::uint32_t> indices;
                for (std::size_t c = 0; c < rows; c += 1 + c % 3)
                    indices.push_back(static_cast<std::uint32_t>(c));
                Values all(rows + 1, -3.0);
                Values some(rows + 1, -3.0);
                for (std::size_t c = 0; c < rows; ++c) matrix[c * stride + n] = std::nan("");
                kernels::row_products(rows, n, stride, matrix.data(), x.data(), all.data());
                kernels::indexed_row_products(indices.data(), indices.size(), n, stride, matrix.data(),
                                              x.data(), some.data());
                std::size_t named = 0;
                for (std::size_t c = 0; c < rows; ++c) {
                    long double sum = 0;
                    long double magnitude = 0;
                    for (std::size_t k = 0; k < n; ++k) {
                        const long double term = static_cast<long double>(matrix[c * stride + k]) * x[k];
                        sum += term;
                        magnitude += std::abs(term);
                    }
                    expect_sum(all[c], sum, magnitude, n);
                    if (named < indices.size() && indices[named] == c) {
                        expect_sum(some[c], sum, magnitude, n);
                        named += 1;
                    } else {
                        EXPECT_EQ(some[c], -3);
                    }
                }
                EXPECT_EQ(all[rows], -3);
                EXPECT_EQ(some[rows], -3);
            }
        }
    });
}

TEST(Kernels, AddImpulseAndAddScaled) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            const Values mobility = random(n), row = random(n), v = random(n);
            Values kicked = v;
            Values moved = v;
            kernels::add_impulse(n, -0.37, mobility.data(), row.data(), kicked.data());
            kernels::add_scaled(n, 2.7, row.data(), moved.data());
            for (std::size_t k = 0; k < n; ++k) {
                const long double kick = -0.37L * mobility[k] * row[k];
                expect_sum(kicked[k], v[k] + kick, std::abs(v[k]) + std::abs(kick), 1);
                const long double move = 2.7L * row[k];
                expect_sum(moved[k], v[k] + move, std::abs(v[k]) + std::abs(move), 1);
            }
        }
    });
}

TEST(Kernels, ManyImpulsesGiveTheBitsOfOneAfterTheOther) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            constexpr std::size_t contacts = 9;
            const Values mobility = random(n), rows = random(contacts * n), start = random(n);
            const std::vector<std::uint32_t> indices{8, 2, 5, 0, 7, 3, 1};
            for (std::size_t count = 0; count <= indices.size(); ++count) {
                Values impulses = random(contacts);
                for (double& impulse : impulses) impulse = std::abs(impulse);
                impulses[5] = 0;
                Values together = start, one_by_one = start;
                kernels::add_impulses(indices.data(), count, impulses.data(), n, n, mobility.data(),
                                      rows.data(), together.data());
                for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t c = indices[i];
                    if (impulses[c] > 0)
                        kernels::add_impulse(n, impulses[c], mobility.data(), rows.data() + c * n,
                                             one_by_one.data());
                }
                EXPECT_EQ(together, one_by_one) << n << " modes, " << count << " contacts";
            }
        }
    });
}

TEST(Kernels, Energy) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            const Values kinetic = random(n), potential = random(n), q = random(n), v = random(n);
            for (const double lag : {0.0, 0.25}) {
                long double sum = 0;
                long double magnitude = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    const long double middle = q[k] - static_cast<long double>(lag) * v[k];
                    const long double size = std::abs(q[k]) + static_cast<long double>(lag) * std::abs(v[k]);
                    const long double motion = static_cast<long double>(kinetic[k]) * v[k] * v[k];
                    sum += motion + potential[k] * middle * middle;
                    magnitude += std::abs(motion) + std::abs(potential[k]) * size * size;
                }
                expect_sum(kernels::energy(n, kinetic.data(), potential.data(), lag, q.data(), v.data()), sum,
                           magnitude, n + 2);
            }
        }
    });
}

TEST(Kernels, WeightedSquare) {
    on_each_instruction_set([] {
        RandomValues random;
        for (const std::size_t n : sizes) {
            const Values weight = random(n), now = random(n), before = random(n);
            long double sum = 0;
            long double magnitude = 0;
            for (std::size_t k = 0; k < n; ++k) {
                const long double x = 1.25L * now[k] - 0.5L * before[k];
                const long double size = 1.25L * std::abs(now[k]) + 0.5L * std::abs(before[k]);
                sum += weight[k] * x * x;
                magnitude += std::abs(weight[k]) * size * size;
            }
            expect_sum(kernels::weighted_square(n, weight.data(), 1.25, now.data(), -0.5, before.data()), sum,
                       magnitude, n + 2);
        }
    });
}

TEST(Kernels, AllFiniteSeesAnyOneValue) {
    on_each_instruction_set([] {
        for (const std::size_t n : {std::size_t{8}, std::size_t{24}, std::size_t{104}}) {
            Values x(n, 1e308);  // finite values whose sum is not
            EXPECT_TRUE(kernels::all_finite(n, x.data()));
            std::fill(x.begin(), x.end(), -5e-324);
            EXPECT_TRUE(kernels::all_finite(n, x.data()));
            for (std::size_t k = 0; k < n; ++k) {
                for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
                    const double kept = x[k];
                    x[k] = bad;
                    EXPECT_FALSE(kernels::all_finite(n, x.data())) << k;
                    x[k] = kept;
                }
            }
        }
        EXPECT_TRUE(kernels::all_finite(0, nullptr));
    });
}

TEST(Kernels, TheInstructionSetHasAName) {
    EXPECT_STRNE(kernels::instruction_set(), "");
}

}  // namespace
}  // namespace jawari
