#include "instrument/touch/touch_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "instrument/touch/touches.h"
#include "jawari/scene/modes.h"
#include "string/kernels/mode_sums.h"

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

/// Where the frame ends, less where it began, summed in long double.
TEST(InstrumentKernels, FreePathsAreWhatTheirFormulasSay) {
    std::mt19937 random(3);
    const FlightModel flight = random_flight(random);
    const auto q = random_row(random), v = random_row(random);
    const double lag = 0.37;
    std::vector<AlignedVector<double>> row;
    for (std::size_t i = 0; i < touch_slots + 1; ++i) row.push_back(random_row(random));
    for (std::size_t count = 1; count <= row.size(); ++count) {
        kernels::TouchedRows rows, beyond;
        rows.count = beyond.count = count;
        for (std::size_t i = 0; i < count; ++i) rows.row[i] = beyond.row[i] = row[i].data();
        kernels::free_paths(0, 16, lag, flight, q.data(), v.data(), rows);
        kernels::free_paths(16, n, lag, flight, q.data(), v.data(), beyond);
        for (std::size_t i = 0; i < count; ++i) {
            long double middle = 0, rise = 0;
            for (std::size_t k = 0; k < n; ++k) {
                // FlightModel holds the change of q and v over the frame.
                const long double to_q = static_cast<long double>(flight.qq[k]) * q[k] + flight.qv[k] * v[k];
                const long double to_v = static_cast<long double>(flight.vq[k]) * q[k] + flight.vv[k] * v[k];
                middle += row[i][k] * (q[k] - static_cast<long double>(lag) * v[k]);
                rise += row[i][k] * (to_q - lag * to_v);
            }
            EXPECT_NEAR(rows.middle[i] + beyond.middle[i], static_cast<double>(middle), 1e-13)
                << count << " " << i;
            EXPECT_NEAR(rows.rise[i] + beyond.rise[i], static_cast<double>(rise), 1e-13) << count << " " << i;
        }
    }
}

TEST(InstrumentKernels, HeldForcesMoveRowsAndAddUp) {
    std::mt19937 random(4);
    const FlightModel flight = random_flight(random);
    const double lag = 0.37;
    std::vector<AlignedVector<double>> row;
    std::vector<const double*> rows;
    for (std::size_t i = 0; i < touch_slots + 1; ++i) row.push_back(random_row(random));
    for (const auto& one : row) rows.push_back(one.data());
    const auto scales = random_row(random);
    AlignedVector<double> sum(n);
    for (std::size_t count = 1; count <= kernels::most_compliant_rows; ++count) {
        std::vector<double> compliance(count * count);
        kernels::compliances_of(n, count, lag, flight, rows.data(), compliance.data());
        for (std::size_t i = 0; i < count * count; ++i) {
            long double moved = 0;
            for (std::size_t k = 0; k < n; ++k)
                moved += row[i / count][k] *
                         (flight.q_held[k] - static_cast<long double>(lag) * flight.v_held[k]) *
                         row[i % count][k];
            EXPECT_NEAR(compliance[i], static_cast<double>(moved), 1e-13) << count << " " << i;
        }
    }
    for (std::size_t count = 1; count <= rows.size(); ++count) {
        kernels::sum_rows(n, count, scales.data(), rows.data(), sum.data());
        for (std::size_t k = 0; k < n; ++k) {
            long double expected = 0;
            for (std::size_t i = 0; i < count; ++i)
                expected += static_cast<long double>(scales[i]) * row[i][k];
            EXPECT_NEAR(sum[k], static_cast<double>(expected), 1e-14) << count;
        }
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
