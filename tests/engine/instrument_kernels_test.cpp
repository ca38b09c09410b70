#include "instrument_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "instrument_touch.h"
#include "jawari/modes.h"

namespace jawari {
namespace {

constexpr std::size_t n = 48;

AlignedVector<double> random_row(std::mt19937& random, std::size_t size = n) {
    std::uniform_real_distribution<double> value(-1, 1);
    AlignedVector<double> row(size);
    for (double& x : row) x = value(random);
    return row;
}

FlightModel random_flight(std::mt19937& random) {
    FlightModel flight;
    for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held,
                        &flight.q_ramp, &flight.v_ramp})
        *array = random_row(random);
    return flight;
}

TEST(InstrumentKernels, PathsAreWhatTheirFormulasSay) {
    std::mt19937 random(3);
    const FlightModel flight = random_flight(random);
    const auto q = random_row(random), v = random_row(random), row = random_row(random);
    AlignedVector<double> middle(n), rise(n), path(n), moved(n);
    const double lag = 0.37;
    kernels::free_path(n, lag, flight, q.data(), v.data(), middle.data(), rise.data());
    const auto other = random_row(random);
    kernels::path_since(n, lag, q.data(), v.data(), other.data(), path.data());
    kernels::moved_by_held(n, lag, flight, row.data(), moved.data());
    for (std::size_t k = 0; k < n; ++k) {
        // Where the frame ends, less where it began.
        const long double end_q = static_cast<long double>(flight.qq[k]) * q[k] + flight.qv[k] * v[k];
        const long double end_v = static_cast<long double>(flight.vq[k]) * q[k] + flight.vv[k] * v[k];
        EXPECT_NEAR(middle[k], q[k] - lag * v[k], 1e-15);
        // FlightModel holds the change of q and v over the frame.
        EXPECT_NEAR(rise[k], static_cast<double>(end_q - lag * end_v), 1e-14);
        EXPECT_NEAR(path[k], q[k] - lag * v[k] - other[k], 1e-15);
        EXPECT_NEAR(moved[k], row[k] * (flight.q_held[k] - lag * flight.v_held[k]), 1e-15);
    }
}

/// Against the sine itself, for rows as long as instruments have them.
TEST(InstrumentKernels, PointRowsAreMeansOfSines) {
    constexpr std::size_t modes = 2048;
    for (const double x : {0.001, 0.13, 0.6499}) {
        for (const double width : {0.0, 0.002, 0.1}) {
            constexpr double L = 0.65;
            const kernels::PointShape shape{std::sqrt(2 / L), std::numbers::pi * x / L,
                                            std::numbers::pi * width / (2 * L)};
            AlignedVector<double> row(modes);
            kernels::point_row(modes, shape, row.data());
            for (std::size_t k = 0; k < modes; ++k) {
                const long double number = static_cast<long double>(k + 1);
                const long double z = number * shape.b;
                const long double share = z > 0 ? std::sin(z) / z : 1.0L;
                ASSERT_NEAR(row[k], static_cast<double>(shape.scale * std::sin(number * shape.a) * share),
                            3e-13)
                    << k << " " << x << " " << width;
            }
        }
    }
}

TEST(InstrumentKernels, BodyIsItsModesOneByOne) {
    std::mt19937 random(8);
    BodyModel body;
    body.count = n;
    for (auto* array : {&body.yy, &body.yv, &body.vy, &body.vv, &body.y_held, &body.v_held, &body.y_ramp,
                        &body.v_ramp, &body.gain_left, &body.gain_right})
        *array = random_row(random);
    auto y = random_row(random), v = random_row(random);
    const auto y0 = y, v0 = v;
    const double before = 0.7, change = -0.2;
    const kernels::BodyFrame frame = kernels::advance_body(n, body, before, change, y.data(), v.data());
    double left = 0, right = 0, largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double y1 =
            body.yy[i] * y0[i] + body.yv[i] * v0[i] + body.y_held[i] * before + body.y_ramp[i] * change;
        const double v1 =
            body.vy[i] * y0[i] + body.vv[i] * v0[i] + body.v_held[i] * before + body.v_ramp[i] * change;
        EXPECT_NEAR(y[i], y1, 1e-14);
        EXPECT_NEAR(v[i], v1, 1e-14);
        left += body.gain_left[i] * v1;
        right += body.gain_right[i] * v1;
        const double gain = std::max(std::abs(body.gain_left[i]), std::abs(body.gain_right[i]));
        largest = std::max(largest, gain * (std::abs(v1) + std::abs(v0[i])));
    }
    EXPECT_NEAR(frame.left, left, 1e-13);
    EXPECT_NEAR(frame.right, right, 1e-13);
    EXPECT_NEAR(frame.largest, largest, 1e-14);
}

}  // namespace
}  // namespace jawari
