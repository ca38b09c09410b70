// A subset of the seeds that scripts/stress.py plays by the hundred thousand.
#include <gtest/gtest.h>

#include "hostile_scene.h"
#include "run_seed.h"

namespace jawari::stress {
namespace {

/// Sanitizer and unoptimised builds look for memory faults: fewer seeds are enough there.
#if defined(JAWARI_SANITIZED) || !defined(__OPTIMIZE__)
constexpr std::uint64_t seeds_of_range = 4;
constexpr std::uint64_t blocks = 2;
#else
constexpr std::uint64_t seeds_of_range = 40;
constexpr std::uint64_t blocks = 6;
#endif

class Seeds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Seeds, KeepEveryInvariant) {
    const PresetShelf shelf = factory_presets();
    ASSERT_FALSE(shelf.presets.empty());
    std::uint64_t impulses = 0;
    for (std::uint64_t n = 0; n < seeds_of_range; ++n) {
        Budget budget;
        budget.blocks = blocks;
        const Report report = run_seed(shelf, 1000 * GetParam() + n, budget);
        EXPECT_TRUE(report.judge.violations().empty()) << violation_lines(report);
        impulses += report.impulses;
    }
    EXPECT_GT(impulses, 0U);
}

INSTANTIATE_TEST_SUITE_P(Ranges, Seeds, testing::Range<std::uint64_t>(0, 6),
                         [](const auto& range) { return "From" + std::to_string(1000 * range.param); });

// Not the first thousand: it begins with two strings at 8 MHz that lie on 42 points, a minute of work.
INSTANTIATE_TEST_SUITE_P(LaboratoryRanges, Seeds,
                         testing::Range<std::uint64_t>(first_laboratory_seed / 1000 + 1,
                                                       first_laboratory_seed / 1000 + 4),
                         [](const auto& range) { return "From" + std::to_string(1000 * range.param); });

TEST(Seeds, PlayTheSameWhenPlayedAgain) {
    const PresetShelf shelf = factory_presets();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Budget budget;
        budget.blocks = 3;
        const Report first = run_seed(shelf, seed, budget);
        const Report second = run_seed(shelf, seed, budget);
        EXPECT_EQ(first.frames, second.frames) << seed;
        EXPECT_EQ(first.impulses, second.impulses) << seed;
        EXPECT_EQ(first.blocks, second.blocks) << seed;
    }
}

}  // namespace
}  // namespace jawari::stress
