// The inequalities of docs/certificate.md on random modes, against free stepping in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "jawari/step_coefficients.h"
#include "scenes.h"
#include "skipping_kernels.h"

namespace jawari {
namespace {

/// One mode as a string model, at any frequency, loss and rate.
StringModel one_mode(double frequency_hz, double decay_per_s, double rate_hz, std::size_t steps_per_frame) {
    SceneDescription scene;
    scene.contact_rate_hz = rate_hz;
    scene.output_rate_hz = rate_hz / static_cast<double>(steps_per_frame);
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 0.01;
    string.modes = ModeTable{{frequency_hz}, {decay_per_s}};
    scene.strings.push_back(string);
    return test::compiled_string(scene);
}

using Digits50 = boost::multiprecision::cpp_bin_float_50;

/// q+ = A q - e q_before, from the definitions of A and e. Slow modes cancel in it: they need the 50 digits.
template <class Number>
struct FreeMotion {
    Number A, e, h;
    Number q, v;

    FreeMotion(const StringModel& model, double q0, double v0) : h(model.step_s), q(q0), v(v0) {
        const Number omega = model.omega[0], sigma = model.sigma[0];
        e = exp(Number(-2 * sigma * h));
        if (sigma <= omega) {
            A = 2 * exp(Number(-sigma * h)) *
                cos(Number(sqrt(Number((omega - sigma) * (omega + sigma))) * h));
        } else {
            const Number r = sqrt(Number((sigma - omega) * (sigma + omega)));
            A = exp(Number(-(sigma - r) * h)) + exp(Number(-(sigma + r) * h));
        }
    }
    void step() {
        const Number before = q - h * v;
        const Number next = A * q - e * before;
        v = (next - q) / h;
        q = next;
    }
};

struct RandomMode {
    StringModel model;
    double q, v;
};

RandomMode random_mode(test::RandomScene& random) {
    const double rate = random.logarithmic(8e3, 64e6);
    const double f = rate * random.logarithmic(1e-5, 2.3);
    const double sigma = random.count(0, 5) == 0 ? 0 : 2 * 3.14159 * f * random.logarithmic(1e-6, 30);
    return {one_mode(f, sigma, rate, random.count(1, 60)), random.uniform(-1, 1),
            random.uniform(-1, 1) * 2 * 3.14159 * std::min(f, rate)};
}

TEST(Certificate, SpeedAndExtentBoundFreeMotion) {
    test::RandomScene random(1);
    double tightest_speed = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomMode mode = random_mode(random);
        const std::size_t n = mode.model.stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, mode.model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        FreeMotion<long double> motion(mode.model, q[0], v[0]);
        for (int step = 0; step < 60; ++step) {
            ASSERT_LE(std::abs(motion.v), static_cast<long double>(speed[0]) * (1 + 1e-9L))
                << "trial " << trial;
            ASSERT_LE(std::abs(motion.q), static_cast<long double>(extent[0]) * (1 + 1e-9L))
                << "trial " << trial;
            tightest_speed = std::max(tightest_speed, static_cast<double>(std::abs(motion.v)) / speed[0]);
            motion.step();
        }
    }
    EXPECT_GT(tightest_speed, 0.999);  // the bound is reached, so a smaller one would fail
}

TEST(Certificate, DetourBoundsTheDistanceFromTheChord) {
    test::RandomScene random(2);
    double tightest = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomMode mode = random_mode(random);
        const std::size_t n = mode.model.stride;
        const std::size_t m = mode.model.steps_per_frame;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, mode.model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        FreeMotion<long double> motion(mode.model, q[0], v[0]);
        std::vector<long double> path{motion.q};
        for (std::size_t step = 0; step < m; ++step) {
            motion.step();
            path.push_back(motion.q);
        }
        for (std::size_t i = 0; i <= m; ++i) {
            const long double lowest_end = std::min(path.front(), path.back());
            ASSERT_GE(path[i], lowest_end - static_cast<long double>(detour[0]) * (1 + 1e-9L))
                << "trial " << trial;
            if (detour[0] > 0) {
                tightest = std::max(tightest, static_cast<double>((lowest_end - path[i]) / detour[0]));
            }
        }
    }
    EXPECT_GT(tightest, 0.9);
}

TEST(Certificate, AKickRaisesTheSpeedBoundByItsShare) {
    test::RandomScene random(3);
    for (int trial = 0; trial < 5000; ++trial) {
        const RandomMode mode = random_mode(random);
        const StringModel& model = mode.model;
        const std::size_t n = model.stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), before(n), after(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, model, q.data(), v.data(), before.data(), extent.data(), detour.data());
        const double impulse = random.uniform(-1, 1) * std::abs(mode.v);
        v[0] += model.mobility[0] * impulse;
        q[0] += model.step_s * model.mobility[0] * impulse;
        kernels::mode_bounds(n, model, q.data(), v.data(), after.data(), extent.data(), detour.data());
        ASSERT_LE(after[0], (before[0] + model.certificate.kick[0] * std::abs(impulse)) * (1 + 1e-9))
            << "trial " << trial;
    }
}

TEST(Certificate, FlightIsTheStepsTaken) {
    test::RandomScene random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        const RandomMode mode = random_mode(random);
        const StringModel& model = mode.model;
        const std::size_t n = model.stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), q_end(n), v_end(n), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        ASSERT_TRUE(kernels::fly(n, model.flight, q.data(), v.data(), q_end.data(), v_end.data()));
        FreeMotion<Digits50> motion(model, q[0], v[0]);
        for (std::size_t step = 0; step < model.steps_per_frame; ++step) motion.step();
        // The phase is right to rounding of omega times the frame's length.
        const double phase = model.omega[0] * model.step_s * static_cast<double>(model.steps_per_frame);
        const double tolerance = 1e-15 * (10 + 10 * phase);
        EXPECT_NEAR(q_end[0], static_cast<double>(motion.q), tolerance * (extent[0] + std::abs(q[0])))
            << "trial " << trial;
        EXPECT_NEAR(v_end[0], static_cast<double>(motion.v), tolerance * (speed[0] + std::abs(v[0])))
            << "trial " << trial;
    }
}

}  // namespace
}  // namespace jawari
