#include "live/player.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "live_stage.h"
#include "render/ensemble.h"
#include "render/score.h"

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
        file.events.push_back({captured.frame, captured.frame, 0, captured.message.status,
                               captured.message.data1, captured.message.data2});
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
                         testing::Values("guitar-steel", "bass-fretted", "sitar", "clavichord"));

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

TEST(LivePlayer, AMessageSoundsOneBlockAfterItCameIn) {
    const SharedInstrument instrument = small_live_instrument("bass-fretted");
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    LiveSound sound;
    std::int64_t now = start_ns;
    for (int n = 0; n < 10; ++n) now = sound.add(player, 128, now, rate_hz);
    // 37.5 frames before the next block: between its frames 90 and 91.
    port.push({{0x90, 33, 100}, now - static_cast<std::int64_t>(37.5e9 / rate_hz)});
    now = sound.add(player, 128, now, rate_hz);
    const auto first = std::find_if(sound.left.begin(), sound.left.end(), [](double x) { return x != 0; });
    EXPECT_EQ(first - sound.left.begin(), 10 * 128 + 90);
}

TEST(LivePlayer, OldInstrumentsAreFreedByTheControlThread) {
    struct Watch {
        std::thread::id freed_by;
    };
    const auto watch = std::make_shared<Watch>();
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    LiveSound sound;
    std::int64_t now = start_ns;
    std::weak_ptr<const LoadedInstrument> old;
    {
        const SharedInstrument plain = small_live_instrument("bass-fretted");
        const SharedInstrument watched(new LoadedInstrument(*plain),
                                       [watch](const LoadedInstrument* instrument) {
                                           watch->freed_by = std::this_thread::get_id();
                                           delete instrument;
                                       });
        old = watched;
        ASSERT_TRUE(player.publish(watched));
    }
    port.push({{0x90, 33, 100}, 0});
    now = sound.add(player, 256, now, rate_hz);
    EXPECT_EQ(player.statistics().held_notes, 1U);
    ASSERT_TRUE(player.publish(small_live_instrument("sitar")));
    port.push({{0x80, 33, 64}, 0});
    std::thread audio([&] {
        for (int n = 0; n < 400 && player.statistics().instruments != 1; ++n)
            now = sound.add(player, 256, now, rate_hz);
        for (int n = 0; n < 400; ++n) now = sound.add(player, 256, now, rate_hz);
    });
    audio.join();
    EXPECT_EQ(player.statistics().instruments, 1U);
    EXPECT_FALSE(old.expired());
    player.collect();
    EXPECT_TRUE(old.expired());
    EXPECT_EQ(watch->freed_by, std::this_thread::get_id());
}

TEST(LivePlayer, ManyChangesWaitTheirTurnAndAllComeBack) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    const SharedInstrument a = small_live_instrument("bass-fretted");
    LiveSound sound;
    std::int64_t now = start_ns;
    int published = 0;
    for (int n = 0; n < 1200; ++n) {
        if (published < 24 && player.publish(a)) ++published;
        port.push({{0x90, static_cast<std::uint8_t>(28 + n % 12), 100}, 0});
        now = sound.add(player, 64, now, rate_hz);
        ASSERT_LE(player.statistics().instruments, 4U);
        player.collect();
    }
    EXPECT_EQ(published, 24);
    EXPECT_EQ(a.use_count(), 2 + static_cast<long>(player.statistics().instruments));
}

/// Largest second difference: what a click has much of.
double roughness(const std::vector<double>& x, std::size_t begin, std::size_t end) {
    double most = 0;
    for (std::size_t n = begin; n < end; ++n) most = std::max(most, std::abs(x[n + 1] - 2 * x[n] + x[n - 1]));
    return most;
}

TEST(LivePlayer, AChangeOfPresetMakesNoClick) {
    for (const bool replaced : {true, false}) {
        for (const char* const name : {"guitar-steel", "bass-fretted"}) {
            const SharedInstrument instrument = small_live_instrument(name);
            double rough[2] = {0, 0};
            for (const bool change : {false, true}) {
                LivePlayer player(live_settings());
                MidiPort& port = *player.add_port();
                ASSERT_TRUE(player.publish(instrument));
                for (const auto& keys : instrument->model.strings)
                    port.push({{0x90, static_cast<std::uint8_t>(keys.stopped[2].key), 120}, 0});
                LiveSound sound;
                std::int64_t now = start_ns;
                for (int n = 0; n < 30; ++n) now = sound.add(player, 256, now, rate_hz);
                const std::size_t at = sound.left.size();
                // Five times: the first ones fade to make room.
                for (int n = 0; change && n < (replaced ? 5 : 1); ++n)
                    ASSERT_TRUE(player.publish(small_live_instrument(n % 2 == 0 ? "sitar" : name)));
                for (int n = 0; n < 30; ++n) now = sound.add(player, 256, now, rate_hz);
                rough[change ? 1 : 0] = roughness(sound.left, at - 100, at + 7000);
            }
            EXPECT_LE(rough[1], 2 * rough[0]) << name;
            EXPECT_GT(rough[0], 0) << name;
        }
    }
}

TEST(LivePlayer, ControllersCarryOverToTheNextInstrument) {
    const LiveSettings settings = live_settings();
    LivePlayer player(settings);
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(small_live_instrument("bass-fretted")));
    ASSERT_TRUE(player.send(
        {.kind = LiveCommand::Kind::SetParameter, .parameter = ParameterId::PalmMute, .value = 0.5}));
    port.push({{0xE0, 0, 100}, 0});
    LiveSound sound;
    std::int64_t now = sound.add(player, 64, start_ns, rate_hz);
    EXPECT_EQ(player.parameter(ParameterId::PalmMute, 0), 0.5);
    EXPECT_EQ(player.parameter(ParameterId::PalmMute, 15), 0.5);
    const SharedInstrument sitar = small_live_instrument("guitar-steel");
    ASSERT_TRUE(player.publish(sitar));
    now = sound.add(player, 64, now, rate_hz);
    // The same from its own start, told by messages.
    LivePlayer other(settings);
    MidiPort& other_port = *other.add_port();
    ASSERT_TRUE(other.publish(sitar));
    ASSERT_TRUE(other.send(
        {.kind = LiveCommand::Kind::SetParameter, .parameter = ParameterId::PalmMute, .value = 0.5}));
    other_port.push({{0xE0, 0, 100}, 0});
    LiveSound same;
    std::int64_t other_now = same.add(other, 128, start_ns, rate_hz);
    for (int n = 0; n < 20; ++n) {
        if (n == 0) port.push({{0x90, 50, 100}, 0});
        if (n == 0) other_port.push({{0x90, 50, 100}, 0});
        now = sound.add(player, 128, now, rate_hz);
        other_now = same.add(other, 128, other_now, rate_hz);
    }
    EXPECT_EQ(sound.left, same.left);
}

TEST(LivePlayer, PanicSilencesWithinAFade) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(small_live_instrument("bass-fretted")));
    for (std::uint8_t channel = 0; channel < 16; ++channel)
        port.push(
            {{static_cast<std::uint8_t>(0x90 + channel), static_cast<std::uint8_t>(28 + channel), 120}, 0});
    LiveSound sound;
    std::int64_t now = start_ns;
    for (int n = 0; n < 10; ++n) now = sound.add(player, 256, now, rate_hz);
    EXPECT_GT(player.statistics().held_notes, 0U);
    EXPECT_GT(player.statistics().energy_J, 0);
    ASSERT_TRUE(player.send({.kind = LiveCommand::Kind::Panic}));
    now = sound.add(player, 256, now, rate_hz);
    LiveSound after;
    for (int n = 0; n < 4; ++n) now = after.add(player, 256, now, rate_hz);
    EXPECT_EQ(*std::max_element(after.left.begin(), after.left.end()), 0);
    EXPECT_EQ(player.statistics().held_notes, 0U);
    EXPECT_EQ(player.statistics().voices, 0U);
}

TEST(LivePlayer, GainFollowsInAStraightLine) {
    const SharedInstrument instrument = small_live_instrument("bass-fretted");
    LiveSound sounds[2];
    for (const bool moved : {false, true}) {
        LivePlayer player(live_settings());
        MidiPort& port = *player.add_port();
        ASSERT_TRUE(player.publish(instrument));
        port.push({{0x90, 33, 100}, 0});
        std::int64_t now = sounds[moved].add(player, 1000, start_ns, rate_hz);
        if (moved) {
            EXPECT_TRUE(player.send({.kind = LiveCommand::Kind::SetGain, .value = 0.25}));
        }
        for (int n = 0; n < 8; ++n) now = sounds[moved].add(player, 100, now, rate_hz);
    }
    for (std::size_t n = 0; n < 1800; ++n) {
        const double gone = std::clamp((static_cast<double>(n) - 999) / (0.01 * rate_hz), 0.0, 1.0);
        ASSERT_NEAR(sounds[1].left[n], sounds[0].left[n] * (1 - 0.75 * gone), 1e-12) << n;
    }
    EXPECT_EQ(sounds[1].left[1799], 0.25 * sounds[0].left[1799]);
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

TEST(LivePlayer, TellsOfProgramChanges) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(small_live_instrument("bass-fretted")));
    EXPECT_FALSE(player.program_request());
    port.push({{0xC3, 24, 0}, 0});
    port.push({{0xB4, 0, 127}, 0});
    port.push({{0xB4, 32, 126}, 0});
    port.push({{0xC4, 127, 0}, 0});
    LiveSound sound;
    sound.add(player, 64, start_ns, rate_hz);
    const auto request = player.program_request();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->channel, 4);
    EXPECT_EQ(request->bank, 127 * 128 + 126);
    EXPECT_EQ(request->program, 127);
    EXPECT_FALSE(player.program_request());
}

TEST(LivePlayer, MonitorsAppliedMessagesWithTheirFrames) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(small_live_instrument("bass-fretted")));
    LiveSound sound;
    std::int64_t now = sound.add(player, 64, start_ns, rate_hz);
    port.push({{0x90, 33, 100}, 0});
    now = sound.add(player, 64, now, rate_hz);
    EXPECT_FALSE(player.applied());
    player.set_monitor(true);
    port.push({{0x80, 33, 1}, 0});
    now = sound.add(player, 64, now, rate_hz);
    const auto applied = player.applied();
    ASSERT_TRUE(applied);
    EXPECT_EQ(applied->frame, 128U);
    EXPECT_EQ(applied->message.data2, 1);
    EXPECT_FALSE(player.applied());
}

TEST(LivePlayer, FullQueuesAreCounted) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    for (std::size_t n = 0; n < midi_port_capacity; ++n) ASSERT_TRUE(port.push({{0xD0, 5, 0}, 0}));
    EXPECT_FALSE(port.push({{0xD0, 5, 0}, 0}));
    EXPECT_EQ(player.statistics().dropped_messages, 1U);
    ASSERT_TRUE(player.publish(small_live_instrument("bass-fretted")));
    LiveSound sound;
    std::int64_t now = start_ns;
    for (int n = 0; n < 5; ++n) now = sound.add(player, 64, now, rate_hz);  // 1024 a block
    EXPECT_EQ(player.statistics().messages, midi_port_capacity);
    EXPECT_TRUE(port.push({{0xD0, 5, 0}, 0}));
    std::size_t ports = 1;
    while (player.add_port() != nullptr) ++ports;
    EXPECT_EQ(ports, 16U);
    while (player.send({.kind = LiveCommand::Kind::SetGain, .value = 1})) {
    }
    EXPECT_FALSE(player.stop_capture());
}

TEST(LivePlayer, RefusesCommandsOutOfRange) {
    LivePlayer player(live_settings());
    using Kind = LiveCommand::Kind;
    for (const double value : {-0.1, 1.1, std::nan("")})
        EXPECT_FALSE(
            player.send({.kind = Kind::SetParameter, .parameter = ParameterId::PalmMute, .value = value}));
    EXPECT_FALSE(player.send(
        {.kind = Kind::SetParameter, .parameter = ParameterId::PalmMute, .channel = 16, .value = 0.5}));
    for (const double value : {-1.0, 1e7, std::nan("")})
        EXPECT_FALSE(player.send({.kind = Kind::SetGain, .value = value}));
    EXPECT_FALSE(player.send({.kind = Kind::Publish}));
    EXPECT_FALSE(player.send({.kind = Kind::StartCapture}));
    EXPECT_TRUE(player.send({.kind = Kind::SetParameter, .parameter = ParameterId::PalmMute, .value = 0.5}));
}

TEST(LivePlayer, PlaysWithoutAnInstrument) {
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    port.push({{0x90, 33, 100}, 0});
    LiveSound sound;
    sound.add(player, 5000, start_ns, rate_hz);
    EXPECT_EQ(*std::max_element(sound.left.begin(), sound.left.end()), 0);
    EXPECT_EQ(player.statistics().frames, 5000U);
}

}  // namespace
}  // namespace jawari::host
