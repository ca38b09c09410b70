#include "player/player.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "support/live_stage.h"

namespace jawari::host {
namespace {

using test::live_settings;
using test::LiveSound;
using test::small_live_instrument;

constexpr double rate_hz = 48000;
constexpr std::int64_t start_ns = 1'000'000'000;

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

TEST(LivePlayer, IgnoredMessagesAreCountedByKind) {
    const SharedInstrument instrument = small_live_instrument("bass-fretted");
    LivePlayer player(live_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    for (const ChannelMessage& message :
         {ChannelMessage{0xB0, 91, 40}, ChannelMessage{0xB3, 91, 41}, ChannelMessage{0xB0, 7, 100},
          ChannelMessage{0xB0, 84, 50}, ChannelMessage{0xB0, 99, 1}, ChannelMessage{0xB0, 98, 8},
          ChannelMessage{0xB0, 6, 64}, ChannelMessage{0xB1, 101, 0}, ChannelMessage{0xB1, 100, 2},
          ChannelMessage{0xB1, 6, 127}, ChannelMessage{0x91, 127, 64}})
        port.push({message, 0});
    LiveSound sound;
    sound.add(player, 256, start_ns, rate_hz);
    const LiveIgnored ignored = player.statistics().ignored;
    EXPECT_EQ(ignored.controllers[91], 2U);
    EXPECT_EQ(ignored.controllers[84], 1U);
    EXPECT_EQ(ignored.controllers[7], 0U);
    EXPECT_EQ(ignored.data, 1U);
    EXPECT_EQ(ignored.moved_notes, 1U);
    EXPECT_EQ(ignored.unplayed_notes, 0U);
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
