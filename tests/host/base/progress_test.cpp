#include "base/progress.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(Progress, ClockText) {
    EXPECT_EQ(clock_text(0), "0:00");
    EXPECT_EQ(clock_text(65.4), "1:05");
    EXPECT_EQ(clock_text(3723), "1:02:03");
    EXPECT_EQ(clock_text(-1), "0:00");
}

TEST(Progress, RemainingTimeFollowsFromTheElapsed) {
    // A quarter in 10 s leaves three quarters: 30 s.
    const std::string line = progress_line("simulating", 0.25, 10);
    EXPECT_NE(line.find(" 25 %"), std::string::npos) << line;
    EXPECT_NE(line.find("0:30 left"), std::string::npos) << line;
    EXPECT_EQ(progress_line("x", 0, 10).find("left"), std::string::npos);
}

TEST(Progress, FractionsOutsideAreClamped) {
    EXPECT_EQ(progress_line("x", 2, 1), progress_line("x", 1, 1));
    EXPECT_EQ(progress_line("x", -2, 1), progress_line("x", 0, 1));
}

}  // namespace
}  // namespace jawari::host
