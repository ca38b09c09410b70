// A result is a value or an error, whatever their types.
#include "jawari/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace jawari {
namespace {

enum class Reason { Missing, Broken };

Result<std::unique_ptr<int>, Reason> made(bool succeeds) {
    if (!succeeds) return Reason::Broken;
    return std::make_unique<int>(7);
}

TEST(Result, HoldsAValueThatCanOnlyBeMoved) {
    auto result = made(true);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result.ok());
    EXPECT_EQ(**result, 7);
    const std::unique_ptr<int> taken = std::move(result).value();
    EXPECT_EQ(*taken, 7);
    EXPECT_EQ(*made(true).value(), 7);
}

TEST(Result, HoldsAnErrorOfAnyType) {
    const auto result = made(false);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error(), Reason::Broken);
    const Result<int> failed = Failure{"strings[0].length_m", "-1", "0.001 to 100"};
    EXPECT_EQ(failed.failure().line(), "strings[0].length_m: -1 (allowed: 0.001 to 100)");
    EXPECT_EQ(&failed.failure(), &failed.error());
}

TEST(Result, ReachesMembersOfTheValue) {
    Result<std::vector<int>> result = std::vector<int>{1, 2, 3};
    EXPECT_EQ(result->size(), 3U);
    result->push_back(4);
    const auto& same = result;
    EXPECT_EQ(same->back(), 4);
    EXPECT_EQ((*same)[0], 1);
    // A value of a temporary is handed out, not referred to.
    static_assert(std::is_same_v<decltype(std::move(result).value()), std::vector<int>>);
    static_assert(std::is_same_v<decltype(result.value()), std::vector<int>&>);
}

#ifndef NDEBUG
TEST(ResultDeathTest, ReadingWhatIsNotThereIsAssertedInDebugBuilds) {
    const Result<int> failed = Failure{};
    EXPECT_DEATH((void)failed.value(), "holds_alternative");
}
#endif

}  // namespace
}  // namespace jawari
