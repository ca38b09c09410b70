// What is played live is what `jawari render` makes of the same messages, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "commands/render/ensemble.h"
#include "commands/render/score.h"
#include "player/player.h"
#include "support/live_stage.h"
#include "support/test_names.h"

namespace jawari::host {
namespace {

using test::live_settings;
using test::LiveSound;
using test::small_live_instrument;

constexpr double rate_hz = 48000;
constexpr std::int64_t start_ns = 1'000'000'000;

std::vector<CapturedMessage> messages_of(CaptureRing& ring) {
    std::vector<CapturedMessage> messages;
    ring.messages.consume_all([&](const CapturedMessage& message) { messages.push_back(message); });
    return messages;
}

/// What `jawari render` makes of the messages, in blocks of its own.
LiveSound rendered_offline(const std::vector<CapturedMessage>& messages, const SharedInstrument& instrument,
                           const LiveSettings& settings, std::size_t frames) {
    MidiFile file;
    file.time_units_per_s = static_cast<std::uint64_t>(settings.rate_hz);
    for (const CapturedMessage& captured : messages)
        file.events.push_back({.tick = captured.frame,
                               .time = captured.frame,
                               .status = captured.message.status,
                               .data1 = captured.message.data1,
                               .data2 = captured.message.data2});
    file.end_time = frames;
    ScoreRules rules;
    rules.interpreter = settings.interpreter;
    rules.preset = "the one";
    const Score score = make_score(file, static_cast<std::uint32_t>(settings.rate_hz), rules);
    Ensemble ensemble = make_ensemble(score, {instrument}, false, settings.gain);
    LiveSound sound;
    for (std::size_t begin = 0; begin < frames; begin += 1024) {
        render_block(ensemble, begin, std::min<std::size_t>(1024, frames - begin));
        sound.left.insert(sound.left.end(), ensemble.left.begin(), ensemble.left.end());
        sound.right.insert(sound.right.end(), ensemble.right.begin(), ensemble.right.end());
    }
    return sound;
}

class LiveEqualsOffline : public testing::TestWithParam<const char*> {};

TEST_P(LiveEqualsOffline, BitForBitAtRandomBlockSizes) {
    const SharedInstrument instrument = small_live_instrument(GetParam());
    LiveSettings settings = live_settings();
    settings.most_frames = 200;
    settings.gain = 0.7;
    LivePlayer player(settings);
    MidiPort& first = *player.add_port();
    MidiPort& second = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    const auto ring = std::make_shared<CaptureRing>(100000, 20000);
    ASSERT_TRUE(player.start_capture(ring));
    Adversary adversary(instrument->model, 7);
    std::mt19937 random(3);
    LiveSound live;
    std::int64_t now = start_ns;
    std::uint64_t pushed = 0;
    while (live.left.size() < 72000) {
        const std::size_t frames = 1 + random() % 700;
        // What comes in before this block begins, to the nanosecond; one port has its clock, the other none.
        for (const AdversaryMessage& message : adversary.next(frames)) {
            const auto time = now - 1 - static_cast<std::int64_t>(random() % 5'000'000);
            const bool timed = pushed % 3 != 0;
            ASSERT_TRUE((timed ? first : second).push({message.message, timed ? time : 0}));
            ++pushed;
        }
        now = live.add(player, frames, now, rate_hz);
    }
    const std::vector<CapturedMessage> messages = messages_of(*ring);
    EXPECT_GT(messages.size(), 900U);
    const LiveSound offline = rendered_offline(messages, instrument, settings, live.left.size());
    EXPECT_EQ(live.left, offline.left);
    EXPECT_EQ(live.right, offline.right);
    EXPECT_GT(*std::max_element(live.left.begin(), live.left.end()), 1e-3);
    // The recording has every frame of it.
    std::vector<StereoFrame> recorded(ring->sound.read_available());
    ring->sound.pop(recorded.data(), recorded.size());
    ASSERT_EQ(recorded.size(), live.left.size());
    for (std::size_t n = 0; n < recorded.size(); ++n) ASSERT_EQ(recorded[n].left, live.left[n]) << n;
    const LiveStatistics statistics = player.statistics();
    EXPECT_EQ(statistics.dropped_messages, 0U);
    EXPECT_EQ(statistics.nonfinite_resets, 0U);
    EXPECT_GT(statistics.notes, 100U);
}

INSTANTIATE_TEST_SUITE_P(Presets, LiveEqualsOffline,
                         testing::Values("guitar-steel", "bass-fretted", "sitar", "clavichord"), test::named);

TEST(LivePlayer, ARecordingBegunLaterReproducesToo) {
    const SharedInstrument instrument = small_live_instrument("guitar-steel");
    const LiveSettings settings = live_settings();
    LivePlayer player(settings);
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    LiveSound before;
    for (const ChannelMessage& message :
         {ChannelMessage{0xB0, 101, 0}, ChannelMessage{0xB0, 100, 0}, ChannelMessage{0xB0, 6, 7},
          ChannelMessage{0xE0, 3, 80}, ChannelMessage{0xB0, 10, 20}, ChannelMessage{0xB0, 64, 127}})
        port.push({message, 0});
    std::int64_t now = before.add(player, 1001, start_ns, rate_hz);  // no multiple of the control rate
    const auto ring = std::make_shared<CaptureRing>(100000, 1000);
    ASSERT_TRUE(player.start_capture(ring));
    LiveSound take;
    now = take.add(player, 77, now, rate_hz);
    port.push({{0xB0, 1, 100}, 0});  // vibrato: its phase counts from the recording's start
    port.push({{0x90, 50, 100}, 0});
    for (int n = 0; n < 40; ++n) now = take.add(player, 256, now, rate_hz);
    const LiveSound offline = rendered_offline(messages_of(*ring), instrument, settings, take.left.size());
    EXPECT_EQ(take.left, offline.left);
}

TEST(LivePlayer, TheLimiterDelaysTheSoundAndTheRecordingDoesNot) {
    const SharedInstrument instrument = small_live_instrument("bass-fretted");
    LiveSettings settings = live_settings();
    settings.limiter_dbfs = -1;
    LivePlayer player(settings);
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    const auto ring = std::make_shared<CaptureRing>(100000, 1000);
    ASSERT_TRUE(player.start_capture(ring));
    port.push({{0x90, 33, 100}, 0});
    LiveSound sound;
    std::int64_t now = sound.add(player, 4096, start_ns, rate_hz);
    ASSERT_TRUE(player.stop_capture());
    now = sound.add(player, 64, now, rate_hz);
    EXPECT_FALSE(ring->ended);
    now = sound.add(player, 64, now, rate_hz);
    EXPECT_TRUE(ring->ended);
    EXPECT_EQ(player.latency_frames(), 96U);
    std::vector<StereoFrame> recorded(ring->sound.read_available());
    ring->sound.pop(recorded.data(), recorded.size());
    ASSERT_EQ(recorded.size(), 4096U);
    const LiveSound offline = rendered_offline(messages_of(*ring), instrument, settings, 4096);
    for (std::size_t n = 0; n < 4096; ++n) ASSERT_EQ(recorded[n].left, offline.left[n]) << n;
    EXPECT_EQ(sound.left[96], offline.left[0]);
}

}  // namespace
}  // namespace jawari::host
