// What docs/engine/stability.md says of the laws, on strings that nobody touches.
#include "compare_laws.h"

#include <gtest/gtest.h>

#include "string/contact/impact_law.h"

namespace jawari::stress {
namespace {

#if defined(JAWARI_SANITIZED) || !defined(__OPTIMIZE__)
constexpr std::uint64_t seeds = 60;
#else
constexpr std::uint64_t seeds = 600;
#endif

class Laws : public testing::TestWithParam<bool> {};

TEST_P(Laws, OnlyThoseThatAreNotPassiveGainEnergyFromTheirImpacts) {
    for (const LawRecord& record : compare_laws(seeds, GetParam())) {
        EXPECT_GT(record.scenes, 0U);
        EXPECT_GT(record.impulses, 0U);
        if (!is_passive(record.law)) continue;
        EXPECT_EQ(record.rose, 0U) << name_of(record.law);
        EXPECT_EQ(record.exploded, 0U) << name_of(record.law);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Laws, testing::Bool(), [](const auto& of_tables) {
    return of_tables.param ? "FromTables" : "FromPhysics";
});

#if defined(__OPTIMIZE__) && !defined(JAWARI_SANITIZED)
TEST(NewtonsLaw, GainsEnergyOnSomeStrings) {
    // The reason for `passive`. If this fails, the law is no longer the published one.
    const LawRecord newton = compare_laws(seeds, true).front();
    EXPECT_GT(newton.rose, 0U);
    EXPECT_GT(newton.largest_gain, 1.01);
}

TEST(PaoliSchatzmansLaw, GainsEnergyOnSomeStrings) {
    const LawRecord record = compare_laws(seeds, false).back();
    EXPECT_EQ(record.law, ImpactLaw::PaoliSchatzman);
    EXPECT_GT(record.rose, 0U);
}
#endif

}  // namespace
}  // namespace jawari::stress
