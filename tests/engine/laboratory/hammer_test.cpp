// Hammers and springs of scenes against closed forms.
#include <cmath>
#include <numbers>

#include "laboratory/laboratory.h"

namespace jawari::laboratory {
namespace {

FlyingHammer hammer_of(double mass_kg, double velocity_m_per_s, double time_s, Side side = Side::Below) {
    FlyingHammer hammer;
    hammer.mass_kg = mass_kg;
    hammer.velocity_m_per_s = velocity_m_per_s;
    hammer.time_s = time_s;
    hammer.side = side;
    hammer.compliance = {1e6, 1.5, 0, 0};
    return hammer;
}

TEST(Hammer, AndAFreeMassExchangeMomentumAndEnergy) {
    for (const Side side : {Side::Below, Side::Above}) {
        const double sign = side == Side::Below ? 1 : -1;
        StringDescription body = mass(0.3, 0, 0, 0);
        body.hammers.push_back(hammer_of(0.1, 2, 0.004, side));
        body.probes = {{Quantity::Velocity}, {Quantity::HammerForce}, {Quantity::HammerDisplacement}};
        const Signals signals = simulate(scene_of(body, 1e5, 4e6), 1500, Metering::Step);
        EXPECT_NEAR(signals.probes[0].back(), sign * 2 * 0.1 / 0.4 * 2, 1e-8);  // 2 m1/(m1 + m2) v
        EXPECT_NEAR(signals.probes[2][0], -sign * 0.008, 1e-15);
        double impulse = 0;
        std::size_t first = 0;
        for (std::size_t n = 0; n < 1500; ++n) {
            if (impulse == 0 && signals.probes[1][n] > 0) first = n;
            impulse += signals.probes[1][n] / 1e5;
        }
        EXPECT_NEAR(impulse, 0.3 * 1.0, 1e-8);
        EXPECT_NEAR(static_cast<double>(first) / 1e5, 0.004, 2e-5);
        EXPECT_LT(signals.last.energy.worst_imbalance, 1e-13 * signals.last.energy.initial);
    }
}

TEST(Hammer, PushesALongStringAsItsResistanceSays) {
    // Before waves return a string is a resistance 2 Z, Z = sqrt(T mu) = 1, and the stiff hammer with it a
    // mass on a dashpot: v = v0 exp(-2 Z t/m).
    StringDescription string = unit_string(2000);
    FlyingHammer hammer = hammer_of(0.5, 1, 0);
    hammer.position_m = 0.5;
    hammer.compliance = {1e5, 1, 0, 0};
    string.hammers.push_back(hammer);
    string.probes = {{Quantity::HammerDisplacement}};
    const Signals signals = simulate(scene_of(string, 1000, 32000), 900, Metering::Step);
    for (const std::size_t n : {200U, 500U, 800U}) {
        const double t = static_cast<double>(n) / 1000;
        EXPECT_NEAR(signals.probes[0][n], 0.25 * (1 - std::exp(-4 * t)), 1e-3) << t;
    }
    EXPECT_LT(signals.last.energy.worst_imbalance, 1e-12 * signals.last.energy.initial);
}

TEST(Hammer, SkippingChangesNothingThoughItFliesInAndOff) {
    StringDescription string = unit_string(80);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 8}, {20, 2}}}};
    for (const double time : {0.3, 1.0, 2.2}) {
        FlyingHammer hammer = hammer_of(0.05, 0.5, time);
        hammer.position_m = 0.2 + 0.1 * time;
        hammer.compliance = {3e4, 2.5, 0.2, 0};
        string.hammers.push_back(hammer);
    }
    string.contacts.push_back({0.6, -0.005, 0});
    string.probes = {{Quantity::Displacement, 0.3}};
    const SceneDescription scene = scene_of(string, 1000, 32000);
    const Signals all = simulate(scene, 5000);
    const Signals nothing = simulate(scene, 5000, Metering::Off, skip_nothing);
    EXPECT_EQ(all.last.counters.impulses, nothing.last.counters.impulses);
    EXPECT_LT(largest_difference(all.probes[0], nothing.probes[0]), 1e-11);
    EXPECT_GT(all.last.counters.flown_frames, 2000U);
}

TEST(Spring, OnAMassAddsToItsStiffness) {
    // 1 kg on 1 Hz, a spring of 200 N/m and a dashpot of 0.4 kg/s: a damped oscillation in closed form.
    StringDescription body = mass(1, 1, 0.01, 0);
    SpringDescription spring;
    spring.stiffness_N_per_m = 200;
    spring.resistance_kg_per_s = 0.4;
    body.springs.push_back(spring);
    body.probes = {{Quantity::Displacement}};
    const double omega2 = 4 * std::numbers::pi * std::numbers::pi + 200;
    const double W = std::sqrt(omega2 - 0.04);
    const Signals signals = simulate(scene_of(body, 1000, 64000), 3000, Metering::Step);
    for (std::size_t n = 0; n < 3000; n += 7) {
        const double t = static_cast<double>(n) / 1000;
        const double exact = 0.01 * std::exp(-0.2 * t) * (std::cos(W * t) + 0.2 / W * std::sin(W * t));
        EXPECT_NEAR(signals.probes[0][n], exact, 2e-6) << t;
    }
    EXPECT_LT(signals.last.energy.worst_imbalance, 1e-13 * signals.last.energy.initial);
}

TEST(Spring, HoldsAStringWhereStaticsSay) {
    // A strong spring and dashpot at height 1 cm in the middle lift a lossy string: the string hangs in a
    // triangle of height K h/(K + T L/(x (L - x))) = K h/(K + 4).
    StringDescription string = unit_string(199);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 1}, {90, 1}}}};
    SpringDescription spring;
    spring.position_m = 0.5;
    spring.height_m = 0.01;
    spring.stiffness_N_per_m = 40;
    spring.resistance_kg_per_s = 2;
    string.springs.push_back(spring);
    string.probes = {{Quantity::Displacement, 0.5},
                     {Quantity::Displacement, 0.25},
                     {Quantity::BridgeForce},
                     {Quantity::NutForce},
                     {Quantity::Slope, 0.2}};
    const Signals signals = simulate(scene_of(string, 400, 8000), 4000);
    const double top = 0.01 * 40 / 44;
    EXPECT_NEAR(signals.probes[0].back(), top, 1e-4 * top + 4e-5);  // 199 modes
    EXPECT_NEAR(signals.probes[1].back(), top / 2, 4e-5);
    EXPECT_NEAR(signals.probes[2].back(), 2 * top, 4e-4);  // T times the slope
    EXPECT_NEAR(signals.probes[3].back(), 2 * top, 4e-4);
    EXPECT_NEAR(signals.probes[4].back(), 2 * top, 1e-3);
}

}  // namespace
}  // namespace jawari::laboratory
