#include "devices/stream_health.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

constexpr double rate_hz = 48000;

/// Looks ten times a second at a stream of the given speed (1: as it should be).
StreamState run(StreamHealth& health, double& now_s, std::uint64_t& frames, double seconds, double speed,
                bool freewheels = false) {
    StreamState state = StreamState::Running;
    const double end_s = now_s + seconds;
    while (now_s < end_s && state != StreamState::Lost) {
        now_s += 0.1;
        frames += static_cast<std::uint64_t>(speed * 0.1 * rate_hz);
        state = look(health, true, frames, rate_hz, freewheels, now_s);
    }
    return state;
}

TEST(StreamHealth, AStreamThatRunsRuns) {
    StreamHealth health;
    double now_s = 1e6;
    std::uint64_t frames = 123;
    EXPECT_EQ(run(health, now_s, frames, 60, 1), StreamState::Running);
    EXPECT_EQ(run(health, now_s, frames, 60, 0.9), StreamState::Running);
}

TEST(StreamHealth, SilenceIsToldAfterASecondAndIsLossAfterFive) {
    StreamHealth health;
    double now_s = 5;
    std::uint64_t frames = 0;
    run(health, now_s, frames, 3, 1);
    const double stopped_s = now_s;
    EXPECT_EQ(run(health, now_s, frames, 0.8, 0), StreamState::Running);
    EXPECT_EQ(run(health, now_s, frames, 0.5, 0), StreamState::Silent);
    EXPECT_EQ(run(health, now_s, frames, 60, 0), StreamState::Lost);
    EXPECT_NEAR(now_s - stopped_s, lost_after_s, 0.15);
}

TEST(StreamHealth, AStreamThatSleptGoesOn) {
    StreamHealth health;
    double now_s = 0;
    std::uint64_t frames = 0;
    run(health, now_s, frames, 2, 1);
    EXPECT_EQ(run(health, now_s, frames, 4, 0), StreamState::Silent);
    EXPECT_EQ(run(health, now_s, frames, 2, 1), StreamState::Running);
}

TEST(StreamHealth, ADriverThatNeverStartsIsLost) {
    StreamHealth health;
    double now_s = 77;
    std::uint64_t frames = 0;
    EXPECT_EQ(run(health, now_s, frames, 60, 0), StreamState::Lost);
}

TEST(StreamHealth, ADriverThatRunsAwayIsLostUnlessItMay) {
    StreamHealth health;
    double now_s = 0;
    std::uint64_t frames = 0;
    EXPECT_EQ(run(health, now_s, frames, 10, 200), StreamState::Lost);
    EXPECT_LT(now_s, 1.3);
    StreamHealth free;
    EXPECT_EQ(run(free, now_s, frames, 10, 200, true), StreamState::Running);
}

TEST(StreamHealth, AClosedStreamIsLost) {
    StreamHealth health;
    EXPECT_EQ(look(health, false, 4800, rate_hz, false, 1), StreamState::Lost);
}

}  // namespace
}  // namespace jawari::host
