#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "player/block_clock.h"
#include "player/midi_inlet.h"

namespace jawari::host {
namespace {

constexpr std::int64_t origin = 5'000'000'000;

/// Blocks of 128 frames on a sound card of the given true rate, called with up to `jitter_s` delay.
TEST(BlockClock, LatencyIsOneBlockWhateverTheJitter) {
    for (const double true_rate : {48000.0, 48010.0, 47900.0}) {
        BlockClock clock = make_block_clock(48000);
        std::mt19937 random(2);
        std::uniform_real_distribution<double> delay_s(0, 0.001);
        const auto time_of = [&](double frame) { return origin + std::llround(1e9 * frame / true_rate); };
        double worst = 0;
        for (int block = 0; block < 4000; ++block) {
            const double begin = 128.0 * block;
            begin_block(clock, time_of(begin) + std::llround(1e9 * delay_s(random)), 128);
            // A message that came in 50 frames after the block before had been due.
            const auto offset = static_cast<double>(offset_of(clock, time_of(begin - 78)));
            if (block > 1500) worst = std::max(worst, std::abs(offset - 50));  // the loop has settled
        }
        // The mean delay of half a millisecond is 24 frames; jitter itself would be 48.
        EXPECT_NEAR(worst, 24, 6) << true_rate;
    }
}

TEST(BlockClock, StartsAnewAfterAGap) {
    BlockClock clock = make_block_clock(48000);
    begin_block(clock, origin, 480);
    begin_block(clock, origin + 10'000'000, 480);
    EXPECT_EQ(offset_of(clock, origin + 5'000'000), 240U);
    begin_block(clock, origin + 3'000'000'000, 480);
    EXPECT_EQ(offset_of(clock, origin + 3'000'000'000 - 2'500'000), 360U);
    EXPECT_EQ(offset_of(clock, origin), 0U);                    // long ago: at once
    EXPECT_EQ(offset_of(clock, origin + 90'000'000'000), 0U);   // nonsense: at once
    EXPECT_EQ(offset_of(clock, origin + 3'000'000'000), 480U);  // now: with the next block
    EXPECT_EQ(offset_of(clock, 0), 0U);
}

TEST(MidiInlet, MergesByTimeAndKeepsEachPortsOrder) {
    MidiInlet inlet;
    MidiPort& a = *inlet.add_port();
    MidiPort& b = *inlet.add_port();
    BlockClock clock = make_block_clock(48000);
    begin_block(clock, origin, 100);
    const auto at = [](int frame) { return origin + std::llround((frame - 100 + 0.5) * 1e9 / 48000); };
    a.push({{0x90, 1, 1}, at(10)});
    a.push({{0x90, 2, 1}, at(5)});  // behind the one before, whatever its time says
    a.push({{0x90, 3, 1}, at(90)});
    b.push({{0x90, 4, 1}, at(9)});
    b.push({{0x90, 5, 1}, at(10)});
    b.push({{0x90, 6, 1}, 0});
    b.push({{0x90, 7, 1}, at(100)});  // not in this block
    std::vector<std::pair<int, std::size_t>> got;
    ArrivedMessage arrived;
    inlet.begin_block();
    while (inlet.next(clock, 100, arrived)) got.emplace_back(arrived.message.data1, arrived.offset);
    const std::vector<std::pair<int, std::size_t>> expected{{4, 9},  {1, 10}, {2, 10},
                                                            {5, 10}, {6, 10}, {3, 90}};
    EXPECT_EQ(got, expected);
    begin_block(clock, origin + std::llround(100e9 / 48000), 100);
    inlet.begin_block();
    ASSERT_TRUE(inlet.next(clock, 100, arrived));
    EXPECT_EQ(arrived.offset, 0U);
    EXPECT_FALSE(inlet.next(clock, 100, arrived));
}

}  // namespace
}  // namespace jawari::host
