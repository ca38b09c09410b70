// Forces f(t) and heights h(t) against d'Alembert's solutions.
#include <cmath>
#include <numbers>

#include "laboratory/laboratory.h"

namespace jawari::laboratory {
namespace {

constexpr double rate_hz = 2000;

/// sin^2 over a quarter of a second.
double pulse(double t) {
    if (t <= 0 || t >= 0.25) return 0;
    return std::pow(std::sin(4 * std::numbers::pi * t), 2);
}

/// Its integral.
double swept(double t) {
    t = std::clamp(t, 0.0, 0.25);
    return t / 2 - std::sin(8 * std::numbers::pi * t) / (16 * std::numbers::pi);
}

TEST(DrivenForce, SendsOutHalfItsIntegral) {
    // A force F at x0 on a string of T = mu = 1: u = 1/2 the integral of F up to t - |x - x0|, and minus the
    // same from the images behind the ends.
    StringDescription string = unit_string(400);
    std::vector<double> force;
    for (int n = 0; n <= 500; ++n) force.push_back(pulse(n / rate_hz));
    string.forces.push_back({0.3, 0, force});
    for (const double x : {0.1, 0.3, 0.5, 0.9}) string.probes.push_back({Quantity::Displacement, x});
    const Signals signals = simulate(scene_of(string, rate_hz, 32000), 2000, Metering::Step);
    for (std::size_t p = 0; p < 4; ++p) {
        const double x = string.probes[p].position_m;
        for (std::size_t n = 0; n < 2000; n += 3) {
            const double t = static_cast<double>(n) / rate_hz;
            double exact = 0;
            for (int image = -3; image <= 3; ++image) {
                exact += swept(t - std::abs(x - (0.3 + 2 * image))) / 2;
                exact -= swept(t - std::abs(x - (-0.3 + 2 * image))) / 2;
            }
            // Modes beyond the 400 are missing where the string has a corner: F/(pi^2 400).
            EXPECT_NEAR(signals.probes[p][n], exact, x == 0.3 ? 2.6e-4 : 1e-5) << x << ' ' << t;
        }
    }
    const EnergyMeter& meter = signals.last.energy;
    EXPECT_GT(meter.player_work, 1e-3);
    EXPECT_LT(meter.worst_imbalance, 1e-13 * meter.highest);
}

TEST(DrivenForce, BlocksAndSkippingChangeNothing) {
    StringDescription string = unit_string(100);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 3}, {20, 1}}}};
    std::vector<double> force(1500, 0.0);
    for (int n = 0; n < 100; ++n) force[static_cast<std::size_t>(1200 + n)] = 0.2 * pulse(n / 400.0);
    for (int n = 0; n < 60; ++n) force[static_cast<std::size_t>(300 + n)] = -1.5 * pulse(n / 240.0);
    string.forces.push_back({0.3, 0, force});
    string.contacts.push_back({0.6, -0.002, 0});
    string.probes = {{Quantity::Displacement, 0.4}, {Quantity::Velocity, 0.7}};
    const SceneDescription scene = scene_of(string, rate_hz, 32000);
    const Signals all = simulate(scene, 4000);
    const Signals nothing = simulate(scene, 4000, Metering::Off, skip_nothing);
    EXPECT_EQ(all.last.counters.impulses, nothing.last.counters.impulses);
    EXPECT_GT(all.last.counters.impulses, 0U);
    EXPECT_GT(all.last.counters.flown_frames, 1500U);
    for (std::size_t p = 0; p < 2; ++p)
        EXPECT_LT(largest_difference(all.probes[p], nothing.probes[p]), 1e-12) << p;

    const auto model = compile(scene);
    SceneState state = make_state(model.value());
    std::vector<double> values;
    for (std::size_t done = 0, block = 1; done < 4000; done += block, block = block % 37 + 1) {
        block = std::min(block, 4000 - done);
        std::vector<double> a(block), b(block);
        std::vector<double*> outputs{a.data(), b.data()};
        render(model.value(), state, outputs, block);
        values.insert(values.end(), a.begin(), a.end());
    }
    EXPECT_EQ(values, all.probes[0]);
}

TEST(DrivenForce, WakesASleepingString) {
    StringDescription string = unit_string(20);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 2.5}, {5, 2.5}}}};
    string.initial.shape = Pluck{0.5, 0.01};
    std::vector<double> force(10000, 0.0);
    for (std::size_t n = 9000; n < 9100; ++n) force[n] = 1;
    string.forces.push_back({0.3, 0, force});
    string.probes = {{Quantity::Displacement, 0.3}, {Quantity::Energy}};
    for (std::size_t keep = 1; keep <= 2; ++keep) {
        string.probes.resize(keep);
        const Signals signals = simulate(scene_of(string, 200, 1600), 12000);
        EXPECT_GT(signals.last.counters.asleep_frames, 3000U);
        EXPECT_EQ(signals.probes[0][8999], 0);
        EXPECT_GT(signals.probes[0][9100], 0.001);
    }
}

TEST(DrivenForce, AccelerationIsThatOfTheForceOverTheMass) {
    StringDescription body = mass(2, 0, 0, 0);
    body.forces.push_back({0, 0, {0, 1, 3, 3, 0}});
    body.probes = {{Quantity::Acceleration}, {Quantity::Velocity}};
    const Signals signals = simulate(scene_of(body, 1000, 1000), 8);
    const std::vector<double> expected{0, 0.5, 1.5, 1.5, 0, 0, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) EXPECT_NEAR(signals.probes[0][n], expected[n], 1e-12) << n;
}

TEST(DrivenHeight, CarriesTheStringAlong) {
    // An obstacle in the middle that rises at constant speed makes u = h(t - |x - x0|) until waves return.
    StringDescription string = unit_string(799);
    string.contacts.push_back({0.5, 0, 0});
    std::vector<double> height;
    for (int n = 0; n <= 2000; ++n) height.push_back(0.02 * n / rate_hz);
    string.motions.push_back({0, height});
    for (const double x : {0.2, 0.5, 0.75}) string.probes.push_back({Quantity::Displacement, x});
    const Signals signals = simulate(scene_of(string, rate_hz, 4 * rate_hz), 1400, Metering::Step);
    for (std::size_t p = 0; p < 3; ++p) {
        const double x = string.probes[p].position_m;
        for (std::size_t n = 0; n < 1200; n += 7) {
            const double t = static_cast<double>(n) / rate_hz;
            const double exact = 0.02 * (std::max(0.0, t - std::abs(x - 0.5)) - std::max(0.0, t - (1.5 - x)) -
                                         std::max(0.0, t - (0.5 + x)));
            if (t + std::abs(x - 0.5) > 1) continue;  // later the obstacle reflects
            EXPECT_NEAR(signals.probes[p][n], exact, 1e-4) << x << ' ' << t;
        }
    }
    EXPECT_LT(signals.last.energy.worst_imbalance, 1e-13 * signals.last.energy.highest);
}

TEST(DrivenHeight, AfterTheTableItStays) {
    StringDescription body = mass(1, 1, 1, 0);
    body.contacts.push_back({0, -0.5, 0});
    body.motions.push_back({0, {-0.5, -0.4, -0.3}});
    body.probes = {{Quantity::Displacement}};
    const Signals signals = simulate(scene_of(body, 100, 1000), 200);
    EXPECT_DOUBLE_EQ(signals.last.contact.height[0], -0.3);
}

TEST(Drives, AreRefusedWhereTheyAreWrong) {
    StringDescription string = unit_string(10);
    string.forces.push_back({1.5, 0, {0}});
    auto model = compile(scene_of(string, 100, 1000));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.failure().place, "strings[0].forces[0].position_m");
    string.forces.clear();
    string.motions.push_back({0, {0}});
    model = compile(scene_of(string, 100, 1000));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.failure().place, "strings[0].motions[0].contact");
}

}  // namespace
}  // namespace jawari::laboratory
