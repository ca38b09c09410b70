// Minutes of the run that scripts make a day long.
#include "long_play.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jawari::soak {
namespace {

TEST(LongPlay, MinutesResembleOneAnother) {
    const auto instrument = host::load_and_compile("bass-fretless", {.output_rate_hz = 48000, .tuning = {}});
    ASSERT_TRUE(instrument.ok()) << instrument.error().message;
    const LongPlay played = play_long(instrument.value(), 48000, 4, [](const LongPlay&) { return true; });
    ASSERT_EQ(played.minutes.size(), 4U);
    EXPECT_EQ(played.notes, 4U * 8U);
    EXPECT_EQ(played.nonfinite_resets, 0U);
    EXPECT_EQ(played.dropped_messages, 0U);
    const double nominal_hz = instrument.value()->model.strings.back().stopped[0].frequency_hz;
    for (const Minute& minute : played.minutes) {
        EXPECT_NEAR(1200 * std::log2(minute.pitch_hz / nominal_hz), 0, 1);
        EXPECT_GT(minute.level, 1e-4);
        EXPECT_GT(minute.energy_J, 0);
        EXPECT_GT(minute.resident_kib, 1000);
    }
}

TEST(LongPlay, ADriftIsSeen) {
    std::vector<Minute> minutes(6, {.pitch_hz = 100, .level = 0.1, .energy_J = 1e-6, .resident_kib = 5000});
    EXPECT_EQ(drift_of(minutes, 2).pitch_cents, 0);
    EXPECT_EQ(drift_of(minutes, 2).resident_kib, 0);
    minutes[4] = minutes[5] = {.pitch_hz = 200, .level = 1, .energy_J = 1e-5, .resident_kib = 5100};
    const Drift drift = drift_of(minutes, 2);
    EXPECT_NEAR(drift.pitch_cents, 1200, 1e-9);
    EXPECT_NEAR(drift.level_db, 20, 1e-9);
    EXPECT_NEAR(drift.energy_db, 10, 1e-9);
    EXPECT_NEAR(drift.resident_kib, 100, 1e-9);
    minutes[0] = {};  // starts from rest: not counted
    EXPECT_NEAR(drift_of(minutes, 2).pitch_cents, 1200, 1e-9);
}

}  // namespace
}  // namespace jawari::soak
