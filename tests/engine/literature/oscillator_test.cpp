// One mode against a stop: amplitude and phase in closed form.
#include <gtest/gtest.h>

#include "literature/cases.h"

namespace jawari::literature {
namespace {

TEST(OscillatorOnAStop, ReferenceReachesTheStopsDepth) {
    const OscillatorOnStop exact(1, 1, 0.3, 0.5, 1000);
    EXPECT_NEAR(exact.last_amplitude(), 0.3, 1e-12);
    EXPECT_DOUBLE_EQ(OscillatorOnStop(1, 1, 0.3, 1, 1000).last_amplitude(), 1);
}

TEST(OscillatorOnAStop, FollowsTheClosedFormForEveryRestitution) {
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Passive}) {
        for (const double e : {0.0, 0.3, 0.5, 0.9, 1.0}) {
            for (const double rate : {10000.0, 100000.0})
                EXPECT_LT(oscillator_error(law, e, rate, 20), 200 / rate) << name_of(law) << e;
        }
    }
}

TEST(OscillatorOnAStop, KeepsItsEnergyFor200SecondsIfElastic) {
    const EngineRun r = run(oscillator_scene(ImpactLaw::Newton, 1, 100000), 10001);
    EXPECT_NEAR(energy_kept(r), 1, 1e-9);
}

TEST(OscillatorOnAStop, EndsWithTheEnergyThatGrazesTheStop) {
    const EngineRun r = run(oscillator_scene(ImpactLaw::Newton, 0.5, 100000), 10001);
    EXPECT_NEAR(energy_kept(r), 0.09, 1e-4);
}

}  // namespace
}  // namespace jawari::literature
