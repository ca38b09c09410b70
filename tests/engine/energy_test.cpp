// The energy balance of DESIGN: docs/model.md, "Energy". H and its terms are recomputed here from the states themselves.
#include "jawari/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "scenes.h"

namespace jawari {
namespace {

/// H from the definition, in long double, from the two displacements around the step.
long double energy_by_definition(const StringModel& model, const StringState& state) {
    long double sum = 0;
    const long double h = model.step_s;
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        const long double omega = model.omega[k], sigma = model.sigma[k];
        const long double q = state.displacement[k], v = state.velocity[k];
        const long double e = std::exp(-2 * sigma * h);
        const std::complex<long double> W = std::sqrt(std::complex<long double>(omega * omega - sigma * sigma));
        const long double A = (2 * std::exp(-sigma * h) * std::cos(W * h)).real();
        const long double w = (1 + e - A) / (omega * omega * h * h);
        sum += (1 + e) / (2 * w) * v * v + omega * omega * q * (q - h * v);
    }
    return static_cast<long double>(model.linear_density_kg_per_m) * sum / 2;
}

TEST(Energy, MatchesItsDefinition) {
    SceneDescription scene;
    scene.contact_rate_hz = 96000;
    scene.strings.push_back(test::bass_string(40));
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    for (int n = 0; n < 200; ++n) step(model, state);
    const long double expected = energy_by_definition(model, state);
    EXPECT_NEAR(energy(model, state), static_cast<double>(expected), 1e-9 * static_cast<double>(expected));
}

struct Balance {
    double imbalance = 0;
    double rise = 0;
    double initial = 0;
    Counters counters;
};

Balance run(const SceneDescription& scene, std::size_t steps) {
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model, Metering::Step);
    for (std::size_t n = 0; n < steps; ++n) step(model, state);
    return {state.energy.worst_imbalance, state.energy.worst_rise, state.energy.initial, state.counters};
}

class EnergyOfLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(EnergyOfLaw, BalanceClosesAtEveryStepOfRandomScenes) {
    std::uint64_t impulses = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        test::RandomScene random(seed);
        const Balance balance = run(random.scene(GetParam(), 8000, 4e6), 1500);
        EXPECT_LE(balance.imbalance, 1e-13 * balance.initial) << "seed " << seed;
        impulses += balance.counters.impulses;
    }
    EXPECT_GT(impulses, 10000U);
}

INSTANTIATE_TEST_SUITE_P(Laws, EnergyOfLaw,
                         testing::Values(ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::PaoliSchatzman));

class PassiveLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(PassiveLaw, EnergyNeverRises) {
    for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
        test::RandomScene random(seed);
        const Balance balance = run(random.scene(GetParam(), 8000, 4e6), 1500);
        EXPECT_LE(balance.rise, 1e-13 * balance.initial) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, PassiveLaw,
                         testing::Values(ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman));

}  // namespace
}  // namespace jawari
