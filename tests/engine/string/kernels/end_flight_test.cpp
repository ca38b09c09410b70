#include "string/kernels/end_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace jawari {
namespace {

/// Not a multiple of the vectors that the loops keep in registers.
constexpr std::size_t run_modes = 56;

AlignedVector<double> modes_of_run() {
    return AlignedVector<double>(run_modes);
}

EndCoefficients room_for_coefficients() {
    EndCoefficients of;
    for (auto* array : {&of.trace, &of.determinant, &of.qq, &of.qv, &of.vq, &of.vv, &of.q_last, &of.v_last,
                        &of.q_before, &of.v_before})
        *array = modes_of_run();
    return of;
}

/// Modes from 20 Hz to beyond the output's Nyquist rate, the last overdamped, and their state.
struct RunOfModes {
    FlightModel flight;
    AlignedVector<double> q = modes_of_run(), v = modes_of_run(), end = modes_of_run(),
                          other = modes_of_run();
    std::vector<double> zeta;
    EndCoefficients coefficients = room_for_coefficients();

    RunOfModes() {
        std::mt19937 random(4);
        std::uniform_real_distribution<double> value(-1, 1);
        for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held})
            *array = modes_of_run();
        for (std::size_t k = 0; k < run_modes; ++k) {
            const double turn = 0.0026 + 0.07 * static_cast<double>(k);  // of the phase in a frame
            const double decay = k + 1 == run_modes ? 0.1 : std::exp(-1e-4 * static_cast<double>(k));
            flight.qq[k] = decay * std::cos(turn) - 1;
            flight.qv[k] = k + 1 == run_modes ? 0.0 : decay * std::sin(turn);
            flight.vq[k] = k + 1 == run_modes ? 0.0 : -decay * std::sin(turn);
            flight.vv[k] = decay * std::cos(turn) - 1;
            for (auto* array : {&flight.q_held, &flight.v_held, &q, &v, &end, &other})
                (*array)[k] = value(random);
        }
        for (std::size_t n = 0; n < longest_end_run; ++n) zeta.push_back(value(random));
        kernels::set_end_coefficients(run_modes, flight, end.data(), coefficients);
    }
};

/// Frame by frame in long double.
struct SlowModes {
    std::vector<long double> q, v;

    explicit SlowModes(const RunOfModes& run)
        : q(run.q.begin(), run.q.end()), v(run.v.begin(), run.v.end()) {}

    void pass(const RunOfModes& run, long double zeta) {
        const FlightModel& flight = run.flight;
        for (std::size_t k = 0; k < run_modes; ++k) {
            const long double held = zeta * run.end[k], x = q[k], u = v[k];
            q[k] = x + flight.qq[k] * x + flight.qv[k] * u + flight.q_held[k] * held;
            v[k] = u + flight.vq[k] * x + flight.vv[k] * u + flight.v_held[k] * held;
        }
    }
    [[nodiscard]] double read(const AlignedVector<double>& row, long double of_q, long double of_v) const {
        long double sum = 0;
        for (std::size_t k = 0; k < run_modes; ++k) sum += row[k] * (of_q * q[k] + of_v * v[k]);
        return static_cast<double>(sum);
    }
};

TEST(EndFlight, ReadsFreeMotionFrameByFrame) {
    const RunOfModes run;
    for (const std::size_t frames : {2U, 5U, 31U, 32U}) {
        std::vector<double> first(frames + 1), second(frames + 1);
        kernels::EndReading reading;
        reading.modes = run_modes;
        reading.frames = frames;
        reading.flight = &run.flight;
        reading.coefficients = &run.coefficients;
        reading.q = run.q.data();
        reading.v = run.v.data();
        reading.of_v = -0.3;
        reading.rows = 2;
        reading.row = {run.end.data(), run.other.data()};
        reading.out = {first.data(), second.data()};
        kernels::read_end_run(reading);
        SlowModes slow(run);
        for (std::size_t n = 0; n <= frames; ++n) {
            ASSERT_NEAR(first[n], slow.read(run.end, 1, -0.3L), 1e-11) << frames << " " << n;
            ASSERT_NEAR(second[n], slow.read(run.other, 1, -0.3L), 1e-11) << frames << " " << n;
            slow.pass(run, 0);
        }
    }
}

TEST(EndFlight, EndsWhereTheFramesUnderTheEndLead) {
    const RunOfModes run;
    SlowModes slow(run);
    AlignedVector<double> q_out(run_modes), v_out(run_modes), q = run.q, v = run.v;
    for (std::size_t frames = 1; frames <= longest_end_run; ++frames) {
        slow.pass(run, run.zeta[frames - 1]);
        ASSERT_TRUE(kernels::end_short_run(run_modes, frames, run.flight, run.coefficients, run.zeta.data(),
                                           run.q.data(), run.v.data(), q_out.data(), v_out.data()));
        for (std::size_t k = 0; k < run_modes; ++k) {
            ASSERT_NEAR(q_out[k], static_cast<double>(slow.q[k]), 1e-13) << frames << " " << k;
            ASSERT_NEAR(v_out[k], static_cast<double>(slow.v[k]), 1e-13) << frames << " " << k;
        }
    }
    ASSERT_TRUE(kernels::end_long_run(run_modes, run.coefficients, run.zeta.data(), q.data(), v.data()));
    for (std::size_t k = 0; k < run_modes; ++k) {
        EXPECT_NEAR(q[k], static_cast<double>(slow.q[k]), 1e-11) << k;
        EXPECT_NEAR(v[k], static_cast<double>(slow.v[k]), 1e-11) << k;
    }
    q[3] = std::nan("");
    EXPECT_FALSE(kernels::end_long_run(run_modes, run.coefficients, run.zeta.data(), q.data(), v.data()));
}

}  // namespace
}  // namespace jawari
