// What happens when blocks take too long, with a clock that says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "player/governor.h"
#include "stage/stage.h"
#include "support/live_stage.h"

namespace jawari::host {
namespace {

using test::live_settings;
using test::LiveSound;

constexpr double rate_hz = 48000;
constexpr std::size_t block = 128;
constexpr double block_s = block / rate_hz;

// ---------------------------------------------------------------------------------------------- governor

/// Levels after each millisecond at the given loads.
std::vector<int> levels(Governor& governor, double load, int milliseconds) {
    std::vector<int> all;
    for (int n = 0; n < milliseconds; ++n) {
        govern(governor, load, 0.001);
        all.push_back(static_cast<int>(governor.level));
    }
    return all;
}

TEST(Governor, GivesUpOneLevelAfterTheOtherAndTakesThemBack) {
    Governor governor;
    const std::vector<int> down = levels(governor, 1.5, 100);
    EXPECT_TRUE(std::is_sorted(down.begin(), down.end()));
    EXPECT_EQ(down.back(), 5);
    for (int level = 0; level <= 5; ++level)
        EXPECT_EQ(std::count(down.begin(), down.end(), level) > 0, true) << level;
    EXPECT_GE(std::count(down.begin(), down.end(), 0), 2);  // a block alone is no overload
    EXPECT_LT(std::count(down.begin(), down.end(), 0), 8);  // but a few are
    const std::vector<int> steady = levels(governor, 0.5, 10000);
    EXPECT_EQ(steady.front(), steady.back());  // between the two thresholds nothing changes
    const std::vector<int> up = levels(governor, 0.1, 12000);
    EXPECT_TRUE(std::is_sorted(up.rbegin(), up.rend()));
    EXPECT_EQ(up.back(), 0);
    EXPECT_EQ(up[1900], 5);  // two seconds for each
    EXPECT_NEAR(static_cast<double>(std::count(up.begin(), up.end(), 3)), 2000, 20);
}

TEST(Governor, ASingleLateBlockIsForgiven) {
    Governor governor;
    levels(governor, 0.3, 100);
    EXPECT_EQ(levels(governor, 2, 1).back(), 0);
    EXPECT_EQ(levels(governor, 0.3, 1000).back(), 0);
}

TEST(Governor, WaitsLongerIfALevelHadToGoAgain) {
    Governor governor;
    int attempts[2] = {0, 0};
    for (int half = 0; half < 2; ++half) {
        // Full quality is too much, one level down is little: without patience it would change every two
        // seconds.
        int before = 0;
        for (int n = 0; n < 60000; ++n) {
            govern(governor, governor.level == OverloadLevel::Full ? 0.9 : 0.2, 0.001);
            const int level = static_cast<int>(governor.level);
            if (before == 1 && level == 0) ++attempts[half];
            before = level;
        }
    }
    EXPECT_GE(attempts[0], 3);
    EXPECT_LE(attempts[0], 6);
    EXPECT_LE(attempts[1], 3);  // half a minute each
    EXPECT_GE(attempts[1], 1);
}

TEST(Governor, CanBeSwitchedOff) {
    Governor governor;
    governor.settings.enabled = false;
    EXPECT_EQ(levels(governor, 3, 1000).back(), 0);
}

constexpr NoteWork chord_work{1e6, 4e5, 1e5, 1e5, 1e5, 1e5};

TEST(Governor, NotesThatDoNotFitBeginLower) {
    Governor governor;
    levels(governor, 0.3, 100);
    governor.note_s = 0.4e-9;  // the chord: 0.4 of a millisecond
    EXPECT_FALSE(foresee(governor, chord_work, 0.001));
    EXPECT_EQ(governor.level, OverloadLevel::Full);
    governor.note_s = 0.7e-9;  // 0.7 of it, or 0.28 one level down
    EXPECT_TRUE(foresee(governor, chord_work, 0.001));
    EXPECT_EQ(governor.level, OverloadLevel::ReleasedLower);
    governor.note_s = 2e-9;  // 0.8 there, 0.2 at the next
    EXPECT_TRUE(foresee(governor, chord_work, 0.001));
    EXPECT_EQ(governor.level, OverloadLevel::ReleasedLowest);
    governor.note_s = 20e-9;  // too much anywhere: further levels give nothing
    EXPECT_FALSE(foresee(governor, chord_work, 0.001));
    EXPECT_EQ(levels(governor, 0.1, 5000).back(), 0);  // and comes back as from any overload
}

TEST(Governor, TakesTwoLevelsAtOnceWhereOneIsTooLittle) {
    Governor governor;
    governor.note_s = 3e-9;
    EXPECT_TRUE(foresee(governor, chord_work, 0.001));
    EXPECT_EQ(governor.level, OverloadLevel::ReleasedLowest);
    Governor off;
    off.settings.enabled = false;
    off.note_s = 3e-9;
    EXPECT_FALSE(foresee(off, chord_work, 0.001));
}

TEST(Governor, LearnsWhatNotesCost) {
    Governor governor;
    levels(governor, 0.2, 100);
    // A block of a millisecond with a chord of a million multiply-adds takes half of its time.
    for (int n = 0; n < 40; ++n) learn_note_cost(governor, 1e6, 0.7, 0.001);
    EXPECT_NEAR(governor.note_s, 0.5e-9, 1e-12);
    const double known = governor.note_s;
    learn_note_cost(governor, 0, 0.9, 0.001);  // no notes: nothing is learned
    EXPECT_EQ(governor.note_s, known);
    learn_note_cost(governor, 1e3, 0.7, 0.001);  // a small note in a block that took longer for other reasons
    EXPECT_NEAR(governor.note_s, known, 1e-5 * known);
    learn_note_cost(governor, 1e6, 100, 0.001);  // held up by the scheduler
    EXPECT_LE(governor.note_s, 2.51 * known);
}

// ---------------------------------------------------------------------------------------------- player

std::int64_t fake_now = 0;
std::int64_t fake_step = 0;
/// Asked at a block's start and at its end.
std::int64_t fake_clock() noexcept {
    return fake_now += fake_step;
}

void set_load(double load) {
    fake_step = std::llround(1e9 * load * block_s);
}

SharedInstrument laddered(const std::string& name) {
    Preset preset = load_with(name, {}).value();
    preset.instrument.quality = {4 * rate_hz, 6000};
    preset.instrument.strings.resize(3);
    auto loaded = std::make_shared<LoadedInstrument>();
    loaded->model = compile_instrument(preset.instrument, rate_hz).value();
    const std::vector<QualityDescription> lower{{2 * rate_hz, 3000}, {rate_hz, 1500}};
    EXPECT_FALSE(add_qualities(loaded->model, preset.instrument, lower));
    loaded->preset = preset;
    return loaded;
}

LiveSettings overload_settings() {
    LiveSettings settings = live_settings();
    settings.clock = fake_clock;
    settings.overload.enabled = true;
    settings.overload.return_s = 0.1;
    return settings;
}

std::int64_t play(LivePlayer& player, LiveSound& sound, std::int64_t now, int blocks) {
    for (int n = 0; n < blocks; ++n) now = sound.add(player, block, now, rate_hz);
    return now;
}

double roughness(const std::vector<double>& x, std::size_t begin, std::size_t end) {
    double most = 0;
    for (std::size_t n = begin; n < end; ++n) most = std::max(most, std::abs(x[n + 1] - 2 * x[n] + x[n - 1]));
    return most;
}

TEST(LiveOverload, QualityDropsInOrderIsReportedAndReturns) {
    const SharedInstrument instrument = laddered("guitar-steel");
    set_load(0.1);
    LivePlayer player(overload_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    LiveSound sound;
    std::int64_t now = 1'000'000'000;
    for (std::size_t s = 0; s < 3; ++s)
        port.push({{0x90, static_cast<std::uint8_t>(instrument->model.strings[s].stopped[2].key), 110}, 0});
    now = play(player, sound, now, 40);
    port.push({{0x80, static_cast<std::uint8_t>(instrument->model.strings[0].stopped[2].key), 30}, 0});
    now = play(player, sound, now, 4);
    EXPECT_EQ(player.statistics().overload_level, 0);
    EXPECT_FALSE(player.notice());
    set_load(0.95);
    now = play(player, sound, now, 40);
    std::vector<double> told;
    while (const auto notice = player.notice()) {
        EXPECT_EQ(notice->kind, LiveNotice::Kind::OverloadLevel);
        told.push_back(notice->value);
    }
    EXPECT_EQ(told, (std::vector<double>{1, 2, 3, 4, 5}));
    LiveStatistics statistics = player.statistics();
    EXPECT_EQ(statistics.overload_level, 5);
    EXPECT_EQ(statistics.overload_changes, 5U);
    EXPECT_EQ(statistics.faded_voices, 1U);
    EXPECT_EQ(statistics.held_notes, 2U);  // what is held goes on
    EXPECT_GT(statistics.voices, 1U);
    EXPECT_EQ(statistics.nonfinite_resets, 0U);
    LiveSound lowest;
    now = play(player, lowest, now, 20);
    EXPECT_GT(*std::max_element(lowest.left.begin(), lowest.left.end()), 1e-4);  // never silence
    set_load(0.1);
    now = play(player, sound, now, 400);
    EXPECT_EQ(player.statistics().overload_level, 0);
    told.clear();
    while (const auto notice = player.notice()) told.push_back(notice->value);
    EXPECT_EQ(told, (std::vector<double>{4, 3, 2, 1, 0}));
}

TEST(LiveOverload, NoChangeOfQualityClicks) {
    for (const char* const name : {"guitar-steel", "bass-fretted", "sitar"}) {
        const SharedInstrument instrument = laddered(name);
        double rough[2] = {0, 0};
        for (const bool overloaded : {false, true}) {
            set_load(0.1);
            LivePlayer player(overload_settings());
            MidiPort& port = *player.add_port();
            ASSERT_TRUE(player.publish(instrument));
            for (std::size_t s = 0; s < 3; ++s)
                port.push(
                    {{0x90, static_cast<std::uint8_t>(instrument->model.strings[s].stopped.front().key), 100},
                     0});
            LiveSound sound;
            std::int64_t now = play(player, sound, 1'000'000'000, 40);
            const std::size_t at = sound.left.size();
            if (overloaded) set_load(0.95);
            now = play(player, sound, now, 15);  // down to the lowest quality level
            set_load(0.1);
            play(player, sound, now, 300);  // and back
            rough[overloaded ? 1 : 0] = roughness(sound.left, at - 64, sound.left.size() - 1);
            EXPECT_EQ(player.statistics().overload_changes > 7, overloaded) << name;
        }
        EXPECT_LE(rough[1], 2 * rough[0]) << name;
    }
}

TEST(LiveOverload, WithoutOverloadNotABitChanges) {
    const SharedInstrument instrument = laddered("guitar-steel");
    LiveSound sounds[2];
    for (const bool governed : {false, true}) {
        set_load(0.35);  // with a chord that takes as much again, 70 %
        LiveSettings settings = overload_settings();
        settings.overload.enabled = governed;
        LivePlayer player(settings);
        MidiPort& port = *player.add_port();
        ASSERT_TRUE(player.publish(instrument));
        Adversary adversary(instrument->model, 8);
        std::int64_t now = 1'000'000'000;
        for (int n = 0; n < 150; ++n) {
            for (const AdversaryMessage& message : adversary.next(block)) port.push({message.message, 0});
            now = play(player, sounds[governed], now, 1);
        }
    }
    EXPECT_EQ(sounds[0].left, sounds[1].left);
}

/// What the live player plays, on a stage without a governor: quality is changed by hand.
struct Reference {
    Reference(const SharedInstrument& instrument, const LiveSettings& live) : stage(settings_of(live)) {
        stage.call(make_staged(instrument, stage.settings()).release());
    }
    ~Reference() {
        stage.clear();
        while (StagedInstrument* const old = stage.next_retired()) delete old;
    }
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    static StageSettings settings_of(const LiveSettings& live) {
        StageSettings settings;
        settings.rate_hz = live.rate_hz;
        settings.most_frames = live.most_frames;
        settings.interpreter = live.interpreter;
        return settings;
    }
    std::vector<double> play(const std::vector<ChannelMessage>& messages) {
        stage.begin_block();
        stage.take_stage();
        for (const ChannelMessage& message : messages) stage.take(message, 0);
        std::vector<double> left(block), right(block);
        stage.render({left.data(), right.data(), {}}, 0, block);
        return left;
    }
    void lower(std::size_t string, std::size_t level) {
        StagedInstrument& instrument = *stage.sounding()[0];
        change_quality(instrument.loaded->model, instrument.state, string, level);
    }

    Stage stage;
};

TEST(LiveOverload, AChordThatWouldBeLateBeginsLowerInItsOwnBlock) {
    const SharedInstrument instrument = laddered("bass-fretted");
    const auto key_of = [&](std::size_t s) {
        return static_cast<std::uint8_t>(instrument->model.strings[s].stopped.front().key);
    };
    // Two keys again and again, while a third is held.
    const std::vector<ChannelMessage> chord{
        {0x80, key_of(0), 64}, {0x80, key_of(1), 64}, {0x90, key_of(0), 110}, {0x90, key_of(1), 110}};
    set_load(0.1);
    const LiveSettings settings = overload_settings();
    LivePlayer player(settings);
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    Reference full(instrument, settings);
    Reference lower(instrument, settings);
    std::int64_t now = 1'000'000'000;
    const auto play_all = [&](const std::vector<ChannelMessage>& messages) {
        LiveSound sound;
        for (const ChannelMessage& message : messages) port.push({message, 0});
        now = play(player, sound, now, 1);
        return sound.left;
    };
    const auto quiet_blocks = [&] {
        set_load(0.1);
        for (int n = 0; n < 20; ++n) {
            const std::vector<double> live = play_all({});
            EXPECT_EQ(live, full.play({}));
            lower.play({});
        }
    };
    const std::vector<ChannelMessage> held{{0x90, key_of(2), 110}};
    ASSERT_EQ(play_all(held), full.play(held));
    lower.play(held);
    quiet_blocks();
    int late_chords = 0;
    for (; late_chords < 20; ++late_chords) {
        // A chord takes 1.2 of its block, but a single block is no overload by itself.
        Reference& expected = full;
        set_load(1.2);
        const std::vector<double> live = play_all(chord);
        if (player.statistics().overload_level > 0) {
            const std::size_t level = player.statistics().overload_level == 1 ? 1 : 2;
            for (const std::size_t s : {0U, 1U}) lower.lower(s, level);
            EXPECT_EQ(live, lower.play(chord));  // the two strings, in this block, and not the held one
            EXPECT_NE(live, expected.play(chord));
            break;
        }
        EXPECT_EQ(live, expected.play(chord));
        lower.play(chord);
        quiet_blocks();
    }
    EXPECT_GE(late_chords, 1);  // what it costs had to be learned
    EXPECT_LE(late_chords, 4);
    EXPECT_EQ(player.statistics().held_notes, 3U);
    EXPECT_EQ(player.statistics().faded_voices, 0U);
    EXPECT_EQ(player.statistics().stolen_notes, 0U);
    set_load(0.1);
    LiveSound after;
    play(player, after, now, 200);
    EXPECT_EQ(player.statistics().overload_level, 0);  // and quality returns
    EXPECT_EQ(player.statistics().held_notes, 3U);
}

TEST(LiveOverload, StaysSoundUnderTheAdversary) {
    const SharedInstrument instrument = laddered("bass-fretted");
    set_load(0.1);
    LivePlayer player(overload_settings());
    MidiPort& port = *player.add_port();
    ASSERT_TRUE(player.publish(instrument));
    Adversary adversary(instrument->model, 8);
    LiveSound sound;
    std::int64_t now = 1'000'000'000;
    for (int n = 0; n < 700; ++n) {
        set_load(n % 120 < 40 ? 0.9 : 0.1);
        for (const AdversaryMessage& message : adversary.next(block)) port.push({message.message, 0});
        now = play(player, sound, now, 1);
    }
    const LiveStatistics statistics = player.statistics();
    EXPECT_GE(statistics.overload_changes, 10U);
    EXPECT_EQ(statistics.nonfinite_resets, 0U);
    for (const double sample : sound.left) ASSERT_LT(std::abs(sample), 10);
}

}  // namespace
}  // namespace jawari::host
