#include "string/kernels/touched_flight.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace jawari {
namespace {

constexpr std::size_t flown_modes = 56;

AlignedVector<double> random_modes(std::mt19937& random) {
    std::uniform_real_distribution<double> value(-1, 1);
    AlignedVector<double> modes(flown_modes);
    for (double& x : modes) x = value(random);
    return modes;
}

/// Mode by mode in long double, for every number of forces.
TEST(TouchedFlight, MovesReadsAndLooksAheadAsItsFormulasSay) {
    std::mt19937 random(6);
    FlightModel flight;
    for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held})
        *array = random_modes(random);
    const auto q = random_modes(random), v = random_modes(random), read = random_modes(random);
    for (std::size_t count = 1; count <= kernels::most_flight_forces; ++count) {
        std::vector<AlignedVector<double>> row;
        for (std::size_t i = 0; i < count; ++i) row.push_back(random_modes(random));
        AlignedVector<double> q_out(flown_modes), v_out(flown_modes);
        kernels::TouchedFlight run;
        run.modes = flown_modes;
        run.lag = 0.37;
        run.flight = &flight;
        run.q = q.data();
        run.v = v.data();
        run.q_out = q_out.data();
        run.v_out = v_out.data();
        run.count = count;
        run.read_row = read.data();
        run.looks_ahead = true;
        for (std::size_t i = 0; i < count; ++i) {
            run.row[i] = row[i].data();
            run.force_N[i] = 0.5 - static_cast<double>(i);
        }
        ASSERT_TRUE(kernels::fly_touched(run));
        long double reading = 0;
        std::vector<long double> middle(count), rise(count);
        for (std::size_t k = 0; k < flown_modes; ++k) {
            long double held = 0;
            for (std::size_t i = 0; i < count; ++i)
                held += run.force_N[i] * static_cast<long double>(row[i][k]);
            const long double x = q[k], u = v[k];
            const long double x_end = x + flight.qq[k] * x + flight.qv[k] * u + flight.q_held[k] * held;
            const long double u_end = u + flight.vq[k] * x + flight.vv[k] * u + flight.v_held[k] * held;
            ASSERT_NEAR(q_out[k], static_cast<double>(x_end), 1e-14) << count << " " << k;
            ASSERT_NEAR(v_out[k], static_cast<double>(u_end), 1e-14) << count << " " << k;
            reading += read[k] * x_end;
            for (std::size_t i = 0; i < count; ++i) {
                middle[i] += row[i][k] * (x_end - run.lag * u_end);
                rise[i] += row[i][k] * (flight.qq[k] * x_end + flight.qv[k] * u_end -
                                        run.lag * (flight.vq[k] * x_end + flight.vv[k] * u_end));
            }
        }
        EXPECT_NEAR(run.reading, static_cast<double>(reading), 1e-13);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(run.middle[i], static_cast<double>(middle[i]), 1e-13) << count << " " << i;
            EXPECT_NEAR(run.rise[i], static_cast<double>(rise[i]), 1e-13) << count << " " << i;
        }
        AlignedVector<double> lost = q;
        lost[flown_modes - 1] = std::numeric_limits<double>::infinity();
        run.q = lost.data();
        EXPECT_FALSE(kernels::fly_touched(run));
    }
}

}  // namespace
}  // namespace jawari
