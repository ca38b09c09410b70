// A million steps of the run that scripts make a thousand times as long.
#include "phase_drift.h"

#include <gtest/gtest.h>

namespace jawari::soak {
namespace {

constexpr auto forever = [](std::uint64_t) { return true; };

TEST(PhaseDrift, AMillionStepsKeepPhaseAndAmplitude) {
    for (const Advance advance : {Advance::Steps, Advance::Frames}) {
        const PhaseDrift drift = run_phase_drift(1000000, advance, forever);
        EXPECT_EQ(drift.steps, 1000000 / 42 * 42U);
        ASSERT_EQ(drift.modes.size(), 16U);
        EXPECT_LE(drift.worst_phase_rad(), 2e-10);
        EXPECT_LE(drift.worst_amplitude(), 2e-10);
        EXPECT_GT(drift.worst_phase_rad(), 0);  // something has been measured
    }
}

TEST(PhaseDrift, EndsWhenTold) {
    const PhaseDrift drift =
        run_phase_drift(10000000000, Advance::Frames, [](std::uint64_t done) { return done < 1000000; });
    EXPECT_LT(drift.steps, 3000000U);
}

}  // namespace
}  // namespace jawari::soak
