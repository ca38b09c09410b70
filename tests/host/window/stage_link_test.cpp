// What passes between a window and the audio thread.
#include "stage/stage_link.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "jawari/instrument/events.h"
#include "plugin/core/plugin_core.h"
#include "stage/stage_watch.h"
#include "support/small_preset.h"
#include "window/model/hand.h"

namespace jawari::host {
namespace {

TEST(LatestValue, TheReaderSeesWholeValuesInOrder) {
    struct Value {
        std::array<std::uint64_t, 64> copies{};
    };
    constexpr std::uint64_t last = 20000;
    LatestValue<Value> latest;
    std::atomic<bool> ready{false};
    std::thread writer([&] {
        while (!ready) {
        }
        for (std::uint64_t n = 1; n <= last; ++n) {
            latest.back().copies.fill(n);
            latest.publish();
        }
    });
    ready = true;
    std::uint64_t seen = 0;
    while (seen < last) {
        const Value* const value = latest.take();
        if (value == nullptr) continue;
        ASSERT_GT(value->copies[0], seen);
        seen = value->copies[0];
        for (const std::uint64_t copy : value->copies) ASSERT_EQ(copy, seen);
    }
    writer.join();
    EXPECT_EQ(latest.take(), nullptr);
}

/// Between looks the string makes whole periods and a part of one; the parts are a motion of stroboscope_hz.
TEST(Stroboscope, EveryPitchSeemsToMoveAlike) {
    for (const double frequency_hz : {27.5, 41.2, 110.0, 440.0, 1318.5, 4186.0}) {
        for (const std::size_t moving : {std::size_t{1}, std::size_t{6}, std::size_t{74}}) {
            const double interval_s = look_interval_s(frequency_hz, moving);
            const double turns = frequency_hz * interval_s;
            const double seen = turns - std::round(turns - stroboscope_hz * interval_s);
            EXPECT_NEAR(seen / interval_s, stroboscope_hz, 1e-6) << frequency_hz;
            EXPECT_LE(static_cast<double>(moving) / interval_s, most_looks_per_s * 1.5) << frequency_hz;
        }
    }
}

/// An instance that plays in blocks, with a window that looks or without.
class Played {
  public:
    Played() {
        EXPECT_FALSE(core_.load(test::small_state()));
        EXPECT_FALSE(core_.activate(48000));
    }

    PluginCore& core() { return core_; }

    void block(std::size_t frames, int key = -1, double velocity = 1) {
        std::vector<float> left(frames);
        std::vector<float> right(frames);
        PluginOutput output;
        output.main = {left.data(), right.data()};
        core_.begin_block(output, frames, 0);
        if (key >= 0) core_.note_on({-1, 0, 0, static_cast<std::int16_t>(key)}, velocity, frames / 3);
        core_.end_block();
        sound.insert(sound.end(), left.begin(), left.end());
        sound.insert(sound.end(), right.begin(), right.end());
    }

    std::vector<float> sound;

  private:
    PluginCore core_;
};

std::vector<float> piece(bool looked_at) {
    Played played;
    played.core().link().set_open(looked_at);
    constexpr std::array<int, 4> keys{28, 40, 45, 52};
    for (std::size_t n = 0; n < 200; ++n) played.block(100 + 37 * (n % 7), n % 50 == 0 ? keys[n / 50] : -1);
    return played.sound;
}

TEST(StageLink, AnOpenWindowChangesNoBitOfTheSound) {
    const std::vector<float> closed = piece(false);
    ASSERT_GT(*std::max_element(closed.begin(), closed.end()), 0.001F);
    EXPECT_EQ(closed, piece(true));
}

TEST(StageLink, ThereAreNoPicturesWithoutAWindow) {
    Played played;
    played.block(4800, 40);
    EXPECT_EQ(played.core().link().picture(), nullptr);
    Impact impact;
    EXPECT_FALSE(played.core().link().next_impact(impact));
}

TEST(StageLink, PicturesShowWhatSounds) {
    Played played;
    StageLink& link = played.core().link();
    link.set_open(true);
    played.block(480, 40);
    std::size_t pictures = 0;
    float highest = 0;
    for (std::size_t n = 0; n < 100; ++n) {
        played.block(480);
        const StagePicture* const picture = link.picture();
        if (picture == nullptr) continue;
        pictures += 1;
        EXPECT_EQ(picture->model, &played.core().instrument()->model);
        EXPECT_EQ(picture->string_count, 4U);
        if (picture->moving == 0) continue;
        EXPECT_EQ(picture->note_count, 1U);
        EXPECT_EQ(picture->notes[0].key, 40);
        for (std::size_t s = 0; s < 4; ++s) {
            if (!picture->strings[s].moves) continue;
            EXPECT_EQ(picture->strings[s].key, 40);
            EXPECT_NEAR(picture->strings[s].frequency_hz, 440 * std::exp2((40 - 69) / 12.0), 0.01);
            for (const float height_m : picture->strings[s].height_m)
                highest = std::max(highest, std::abs(height_m));
        }
        EXPECT_GE(picture->worst_load, picture->load * 0.99F);
    }
    EXPECT_GT(pictures, 50U);  // one second, 60 pictures
    EXPECT_LT(pictures, 65U);
    EXPECT_GT(highest, 1e-4F);
    EXPECT_LT(highest, 0.01F);
    Impact impact;
    float impulses = 0;
    while (link.next_impact(impact)) impulses += impact.impulse_Ns;
    EXPECT_GT(impulses, 0);  // a hard note on this bass strikes frets
}

TEST(StageLink, AWindowsEventWakesAnInstanceThatRests) {
    Played played;
    played.block(480);
    ASSERT_TRUE(played.core().rests());
    played.core().link().send(note_on_string(0, 2, 45, 0.8, window::hand_channel));
    EXPECT_FALSE(played.core().rests());
    const std::size_t before = played.sound.size();
    for (int n = 0; n < 20; ++n) played.block(480);
    EXPECT_GT(
        *std::max_element(played.sound.begin() + static_cast<std::ptrdiff_t>(before), played.sound.end()),
        1e-4F);
}

TEST(StageLink, AStateIsTheSameBeforeAndAfterAWindow) {
    Played played;
    const std::string before = played.core().save();
    played.core().link().set_open(true);
    played.block(4800, 40);
    played.core().link().set_open(false);
    played.block(4800);
    EXPECT_EQ(played.core().save(), before);
}

}  // namespace
}  // namespace jawari::host
