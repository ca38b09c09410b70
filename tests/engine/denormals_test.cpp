#include "jawari/denormals.h"

#include <gtest/gtest.h>

#include <limits>

namespace jawari {
namespace {

/// Half of the smallest normal number, as the processor has it at run time.
double half_of_the_smallest() {
    volatile double smallest = std::numeric_limits<double>::min();
    return smallest / 2;
}

TEST(Denormals, AreZeroWhileAGuardLivesAndBackAfterwards) {
    ASSERT_GT(half_of_the_smallest(), 0);
    {
        const NoDenormals guard;
        EXPECT_EQ(half_of_the_smallest(), 0);
        {
            const NoDenormals inner;
            EXPECT_EQ(half_of_the_smallest(), 0);
        }
        EXPECT_EQ(half_of_the_smallest(), 0);
    }
    EXPECT_GT(half_of_the_smallest(), 0);
}

TEST(Denormals, AreTakenForZeroToo) {
    volatile double denormal = std::numeric_limits<double>::min() / 1024;
    const NoDenormals guard;
    EXPECT_EQ(denormal * 1e300, 0);
}

}  // namespace
}  // namespace jawari
