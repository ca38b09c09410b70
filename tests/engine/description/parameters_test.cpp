// The table of parameters: frozen ids and keys, ranges, and curves there and back.
#include "jawari/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jawari {
namespace {

TEST(Parameters, AreFrozenAndTravelBackAndForth) {
    EXPECT_EQ(parameter_count, 20U);
    EXPECT_EQ(declaration_of(ParameterId::Volume).key, "volume");
    EXPECT_EQ(declaration_of(ParameterId::Action).key, "action");
    for (const ParameterDeclaration& parameter : parameter_table()) {
        EXPECT_EQ(&declaration_of(parameter.id), &parameter);
        EXPECT_LE(parameter.low, parameter.neutral);
        EXPECT_LE(parameter.neutral, parameter.high);
        EXPECT_EQ(parameter_value(parameter, 0), parameter.low);
        EXPECT_NEAR(parameter_value(parameter, 1), parameter.high, 1e-12 * std::abs(parameter.high));
        if (parameter.curve == Curve::Stepped) continue;
        for (const double t : {0.1, 0.5, 0.77})
            EXPECT_NEAR(parameter_travel(parameter, parameter_value(parameter, t)), t, 1e-12);
    }
}

}  // namespace
}  // namespace jawari
