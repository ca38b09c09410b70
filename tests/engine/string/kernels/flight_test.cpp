#include "string/kernels/flight.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace jawari {
namespace {

constexpr std::size_t n = 48;

AlignedVector<double> random_row(std::mt19937& random) {
    std::uniform_real_distribution<double> value(-1, 1);
    AlignedVector<double> row(n);
    for (double& x : row) x = value(random);
    return row;
}

/// The frame's end by the definition of FlightModel, in long double, with forces on the first modes only.
TEST(FlightKernels, ForcedFlightIsFlightAndResponse) {
    std::mt19937 random(5);
    FlightModel flight;
    for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held})
        *array = random_row(random);
    const auto q = random_row(random), v = random_row(random), held = random_row(random);
    AlignedVector<double> q_end(n), v_end(n);
    for (const std::size_t forced : {std::size_t{0}, std::size_t{8}, std::size_t{24}, n}) {
        ASSERT_TRUE(kernels::fly_forced(n, forced, flight, held.data(), q.data(), v.data(), q_end.data(),
                                        v_end.data()));
        for (std::size_t k = 0; k < n; ++k) {
            const long double force = k < forced ? held[k] : 0.0;
            const long double to_q = q[k] + flight.qq[k] * static_cast<long double>(q[k]) +
                                     flight.qv[k] * static_cast<long double>(v[k]) + force * flight.q_held[k];
            const long double to_v = v[k] + flight.vq[k] * static_cast<long double>(q[k]) +
                                     flight.vv[k] * static_cast<long double>(v[k]) + force * flight.v_held[k];
            EXPECT_NEAR(q_end[k], static_cast<double>(to_q), 1e-15);
            EXPECT_NEAR(v_end[k], static_cast<double>(to_v), 1e-15);
        }
    }
}

TEST(FlightKernels, ForcesThatAreNotFiniteAreNoticed) {
    std::mt19937 random(6);
    FlightModel flight;
    for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held})
        *array = random_row(random);
    const auto q = random_row(random), v = random_row(random);
    auto held = random_row(random);
    held[3] = std::numeric_limits<double>::infinity();
    AlignedVector<double> q_end(n), v_end(n);
    EXPECT_FALSE(
        kernels::fly_forced(n, n, flight, held.data(), q.data(), v.data(), q_end.data(), v_end.data()));
}

}  // namespace
}  // namespace jawari
