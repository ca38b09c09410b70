// The energy balance of DESIGN: docs/engine/model.md, "Energy". H and its terms are recomputed here from the
// states themselves.
#include "jawari/scene/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

/// H from the definition, in long double, from the two displacements around the step.
long double energy_by_definition(const StringModel& model, const StringState& state) {
    long double sum = 0;
    const long double h = model.shape->step_s;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const long double omega = model.tuning.omega[k], sigma = model.shape->sigma[k];
        const long double q = state.displacement[k], v = state.velocity[k];
        const long double e = std::exp(-2 * sigma * h);
        const std::complex<long double> W =
            std::sqrt(std::complex<long double>(omega * omega - sigma * sigma));
        const long double A = (2 * std::exp(-sigma * h) * std::cos(W * h)).real();
        const long double w = (1 + e - A) / (omega * omega * h * h);
        sum += (1 + e) / (2 * w) * v * v + omega * omega * q * (q - h * v);
    }
    return static_cast<long double>(model.shape->linear_density_kg_per_m) * sum / 2;
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
                                         ImpactLaw::PaoliSchatzman),
                         test::named);

class PassiveLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(PassiveLaw, EnergyNeverRises) {
    for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
        test::RandomScene random(seed);
        const Balance balance = run(random.scene(GetParam(), 8000, 4e6), 1500);
        EXPECT_LE(balance.rise, 1e-13 * balance.initial) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, PassiveLaw, testing::Values(ImpactLaw::Passive, ImpactLaw::Signorini),
                         test::named);

TEST(Energy, PaoliSchatzmanChangesItByTheGapsReflected) {
    // y+ = -e y_before wherever there is an impulse: the work is -(1 + e) lambda y_before/(2h), and where
    // gaps were closed one step earlier it is positive.
    std::uint64_t rises = 0;
    for (std::uint64_t seed = 2000; seed < 2040; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::PaoliSchatzman, 8000, 4e6);
        std::get<PhysicalModes>(scene.strings[0].modes).damping = NoLoss{};
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const double initial = energy(model, state);
        std::vector<double> before(model.shape->contact_count);
        for (int n = 0; n < 1000; ++n) {
            const double energy_before = energy(model, state);
            for (std::size_t c = 0; c < before.size(); ++c) {
                before[c] = -model.shape->contact_height[c];
                for (std::size_t k = 0; k < model.shape->mode_count; ++k)
                    before[c] += model.shape->contact_rows[c * model.shape->stride + k] *
                                 (state.displacement[k] - model.shape->step_s * state.velocity[k]);
            }
            step(model, state);
            double work = 0;
            for (std::size_t c = 0; c < before.size(); ++c)
                work -= (1 + model.shape->contact_restitution[c]) * state.contact.impulse[c] * before[c] /
                        (2 * model.shape->step_s);
            const double largest = std::max(initial, energy_before);
            ASSERT_NEAR(energy(model, state) - energy_before, work, 1e-10 * largest) << "seed " << seed;
            if (work > 1e-9 * largest) rises += 1;
        }
    }
    EXPECT_GT(rises, 100U);
}

TEST(Energy, NewtonWithoutRestitutionLossKeepsItConstant) {
    // e = 1 and no damping: y+ = y_before wherever an impulse acts, so that no impulse works.
    std::uint64_t impulses = 0;
    for (std::uint64_t seed = 2000; seed < 2040; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::Newton, 8000, 4e6);
        std::get<PhysicalModes>(scene.strings[0].modes).damping = NoLoss{};
        for (auto& contact : scene.strings[0].contacts) contact.restitution = 1;
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model);
        const double initial = energy(model, state);
        double worst = 0;
        for (int n = 0; n < 5000; ++n) {
            step(model, state);
            worst = std::max(worst, std::abs(energy(model, state) - initial));
        }
        EXPECT_LE(worst, 1e-12 * initial) << "seed " << seed;
        impulses += state.counters.impulses;
    }
    EXPECT_GT(impulses, 2000U);
}

TEST(Energy, NewtonMayInjectEnergyWhereTheOthersMustNot) {
    // The caution for which `passive` exists: restitution of a contact that already separates. If this ever
    // stops failing to be passive, the law is no longer the source's.
    double worst = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::RandomScene random(seed);
        const Balance balance = run(random.scene(ImpactLaw::Newton, 8000, 48000), 1500);
        worst = std::max(worst, balance.rise / balance.initial);
    }
    EXPECT_GT(worst, 1e-9);
}

TEST(Energy, SignoriniNeverPenetrates) {
    for (std::uint64_t seed = 3000; seed < 3100; ++seed) {
        test::RandomScene random(seed);
        const Balance balance = run(random.scene(ImpactLaw::Signorini, 8000, 4e6), 1500);
        EXPECT_EQ(balance.counters.truncated_solves, 0U) << "seed " << seed;
        EXPECT_LE(balance.counters.worst_penetration_m, 1e-12) << "seed " << seed;
        EXPECT_LE(balance.counters.worst_residual_m, 1e-12) << "seed " << seed;
    }
}

class TruncatedLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(TruncatedLaw, TruncatedSolvesStayPassiveAndAreCounted) {
    std::uint64_t truncated = 0;
    for (const std::size_t capacity : {1U, 2U}) {
        for (std::uint64_t seed = 4000; seed < 4100; ++seed) {
            test::RandomScene random(seed);
            const SceneDescription scene = random.scene(GetParam(), 8000, 4e6);
            const StringModel model = test::compiled_string(scene);
            StringState state = make_string_state(model, Metering::Step);
            state.lcp = make_lcp_workspace(model.shape->contact_count, {capacity, capacity, 1});
            for (int n = 0; n < 1500; ++n) step(model, state);
            EXPECT_LE(state.energy.worst_rise, 1e-13 * state.energy.initial) << "seed " << seed;
            EXPECT_LE(state.energy.worst_imbalance, 1e-13 * state.energy.initial) << "seed " << seed;
            EXPECT_LE(state.energy.highest, state.energy.initial * (1 + 1e-12)) << "seed " << seed;
            truncated += state.counters.truncated_solves;
        }
    }
    EXPECT_GT(truncated, 500U);
}

INSTANTIATE_TEST_SUITE_P(Laws, TruncatedLaw, testing::Values(ImpactLaw::Passive, ImpactLaw::Signorini),
                         test::named);

TEST(Energy, MetersAddUpToTheChangeOfEnergy) {
    test::RandomScene random(5);
    const StringModel model = test::compiled_string(random.scene(ImpactLaw::Passive, 48000, 48001));
    StringState state = make_string_state(model, Metering::Step);
    double highest = energy(model, state);
    for (int n = 0; n < 3000; ++n) {
        step(model, state);
        highest = std::max(highest, energy(model, state));
    }
    const EnergyMeter& meter = state.energy;
    EXPECT_GT(meter.dissipated, 0);
    EXPECT_LT(meter.contact_work, 0);
    EXPECT_EQ(meter.player_work, 0);
    EXPECT_EQ(meter.highest, highest);
    EXPECT_NEAR(energy(model, state), meter.initial + meter.contact_work - meter.dissipated,
                1e-12 * meter.initial);
}

}  // namespace
}  // namespace jawari
