// The core of playing: what is rendered depends on events and their frames alone.
#include "stage/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "support/live_stage.h"

namespace jawari::host {
namespace {

using test::small_live_instrument;

struct Timed {
    std::size_t frame = 0;
    ChannelMessage message;
};

/// A stage with its instruments, and everything it has rendered.
struct Played {
    explicit Played(const char* preset, std::size_t most_frames = 128)
        : settings(make_settings(most_frames)), stage(settings) {
        enter(preset);
    }
    ~Played() {
        stage.clear();
        collect();
    }
    Played(const Played&) = delete;
    Played& operator=(const Played&) = delete;

    static StageSettings make_settings(std::size_t most_frames) {
        StageSettings settings;
        settings.most_frames = most_frames;
        settings.string_outputs = true;
        return settings;
    }
    void enter(const char* preset) {
        stage.call(make_staged(small_live_instrument(preset), settings).release());
    }
    std::size_t collect() {
        std::size_t count = 0;
        for (; StagedInstrument* const old = stage.next_retired(); ++count) delete old;
        return count;
    }
    /// One block: the events of its frames, in parts of at most most_frames.
    void block(std::size_t frames, const std::vector<Timed>& events) {
        stage.begin_block();
        stage.take_stage();
        const std::size_t begin = left.size();
        for (const Timed& event : events)
            if (event.frame >= begin && event.frame < begin + frames)
                stage.take(event.message, event.frame - begin);
        left.resize(begin + frames);
        right.resize(begin + frames);
        for (std::size_t done = 0; done < frames;) {
            const std::size_t count = std::min(settings.most_frames, frames - done);
            stage.render({left.data() + begin + done, right.data() + begin + done, {}}, done, count);
            done += count;
        }
        stage.retire_silent();
    }

    const StageSettings settings;
    Stage stage;
    std::vector<double> left, right;
};

std::vector<Timed> music() {
    std::mt19937 random(4);
    std::vector<Timed> events;
    for (std::size_t frame = 0; frame < 12000; frame += random() % 300) {
        const auto key = static_cast<std::uint8_t>(40 + random() % 20);
        const auto value = static_cast<std::uint8_t>(random() % 128);
        const std::array<ChannelMessage, 5> choice{
            {{0x90, key, 100}, {0x80, key, 64}, {0xE0, 0, value}, {0xB0, 1, value}, {0xB0, 64, value}}};
        events.push_back({frame, choice[random() % choice.size()]});
    }
    return events;
}

TEST(Stage, TheSameEventsGiveTheSameBitsInBlocksOfAnySize) {
    const std::vector<Timed> events = music();
    Played whole("guitar-steel");
    whole.block(12000, events);
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        Played parts("guitar-steel", 32 * seed + 1);
        std::mt19937 random(seed);
        while (parts.left.size() < 12000)
            parts.block(std::min<std::size_t>(random() % 500, 12000 - parts.left.size()), events);
        EXPECT_EQ(parts.left, whole.left);
        EXPECT_EQ(parts.right, whole.right);
    }
    EXPECT_GT(*std::max_element(whole.left.begin(), whole.left.end()), 1e-3);
}

TEST(Stage, ResetGivesTheBitsOfANewStage) {
    const std::vector<Timed> events = music();
    Played fresh("guitar-steel"), used("sitar");
    used.block(3000, events);
    used.enter("guitar-steel");
    used.block(3000, events);  // both sound
    used.stage.reset();
    used.left.clear();
    used.right.clear();
    fresh.block(12000, events);
    used.block(12000, events);
    EXPECT_EQ(used.left, fresh.left);
    EXPECT_EQ(used.collect(), 1U);
    EXPECT_EQ(used.stage.frame(), 12000U);
}

TEST(Stage, ResetLetsInWhoWaits) {
    Played one("sitar");
    one.block(100, {});
    one.enter("guitar-steel");
    one.stage.reset();
    ASSERT_EQ(one.stage.sounding().size(), 1U);
    EXPECT_EQ(one.stage.sounding()[0]->loaded->preset.file, "guitar-steel");
    EXPECT_EQ(one.collect(), 1U);
}

TEST(Stage, TimeThatIsSkippedAtRestChangesNoBit) {
    const ChannelMessage vibrato{0xB0, 1, 127}, note{0x90, 50, 100};
    Played skipped("guitar-steel"), rendered("guitar-steel");
    for (Played* each : {&skipped, &rendered}) each->block(10, {{0, vibrato}});
    EXPECT_TRUE(skipped.stage.rests());
    skipped.stage.skip_silence(4321);
    rendered.block(4321, {});
    for (Played* each : {&skipped, &rendered}) {
        each->left.clear();
        each->right.clear();
        each->block(4000, {{0, note}});
        EXPECT_FALSE(each->stage.rests());
    }
    EXPECT_EQ(skipped.left, rendered.left);
    skipped.stage.skip_silence(4321);  // it does not rest: nothing is left out
    for (Played* each : {&skipped, &rendered}) each->block(1000, {});
    EXPECT_EQ(skipped.left, rendered.left);
}

TEST(Stage, EventsAppliedWithoutSoundCountForTheNextFrame) {
    Played before("guitar-steel"), within("guitar-steel");
    before.stage.begin_block();
    before.stage.take_stage();
    before.stage.take({0x90, 50, 100}, 0);
    before.stage.apply_without_sound(0);
    before.block(2000, {});
    within.block(2000, {{0, {0x90, 50, 100}}});
    EXPECT_EQ(before.left, within.left);
}

TEST(Stage, StringsBeyondTheChannelsAreOnTheLast) {
    Played one("bass-fretted");  // three strings here
    one.stage.begin_block();
    one.stage.take_stage();
    for (std::size_t s = 0; s < 3; ++s) {
        const InstrumentStringModel& string = one.stage.sounding()[0]->loaded->model.strings[s];
        one.stage.take({0x90, static_cast<std::uint8_t>(string.stopped[0].key), 100}, 0);
    }
    std::array<std::vector<double>, 4> sound;
    for (auto& each : sound) each.assign(128, 0.0);
    const std::array<double*, 2> two{sound[2].data(), sound[3].data()};
    one.stage.render({sound[0].data(), sound[1].data(), two}, 0, 128);
    Played all("bass-fretted");
    all.stage.begin_block();
    all.stage.take_stage();
    for (const InstrumentEvent& event : one.stage.events()) all.stage.add(event, 0);
    std::array<std::vector<double>, 5> apart;
    for (auto& each : apart) each.assign(128, 0.0);
    const std::array<double*, 3> three{apart[2].data(), apart[3].data(), apart[4].data()};
    all.stage.render({apart[0].data(), apart[1].data(), three}, 0, 128);
    EXPECT_EQ(sound[0], apart[0]);
    EXPECT_EQ(sound[2], apart[2]);
    for (std::size_t n = 0; n < 128; ++n) EXPECT_EQ(sound[3][n], apart[3][n] + apart[4][n]);
    EXPECT_NE(apart[4], std::vector<double>(128, 0.0));
}

TEST(Stage, ParametersThatTheHostSetsCountFromTheirFrame) {
    Played set("guitar-steel"), plain("guitar-steel");
    for (Played* each : {&set, &plain}) {
        each->stage.begin_block();
        each->stage.take_stage();
        each->stage.take({0x90, 50, 100}, 0);
        if (each == &set) each->stage.set_parameter(ParameterId::Volume, 0.5, 96);
        each->left.resize(128);
        each->right.resize(128);
        each->stage.render({each->left.data(), each->right.data(), {}}, 0, 128);
    }
    EXPECT_TRUE(std::equal(set.left.begin(), set.left.begin() + 96, plain.left.begin()));
    EXPECT_NE(set.left, plain.left);
}

}  // namespace
}  // namespace jawari::host
