#include "commands/render/ensemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "jawari/instrument/compile.h"

namespace jawari::host {
namespace {

/// A cheap bass.
SharedInstrument bass() {
    InstrumentSettings settings;
    Preset preset = load_with("bass-fretted", settings).value();
    preset.instrument.quality = {96000, 2000};
    preset.instrument.strings.resize(2);
    auto loaded = std::make_shared<LoadedInstrument>();
    loaded->model = compile_instrument(preset.instrument, 48000).value();
    loaded->preset = preset;
    return loaded;
}

Score two_parts() {
    Score score;
    score.parts.resize(2);
    score.parts[0].events = {{100, note_on(0, 28, 0.5)}};
    score.parts[1].events = {{1500, note_on(0, 33, 0.8, 3)}};
    return score;
}

struct Sound {
    std::vector<double> left, right;
};

Sound play(const Score& score, const std::vector<SharedInstrument>& instruments, std::size_t block,
           double gain) {
    Ensemble ensemble = make_ensemble(score, instruments, false, gain);
    Sound sound;
    for (std::uint64_t frame = 0; frame < 6000; frame += block) {
        const std::size_t count = std::min<std::size_t>(block, 6000 - frame);
        render_block(ensemble, frame, count);
        sound.left.insert(sound.left.end(), ensemble.left.begin(), ensemble.left.end());
        sound.right.insert(sound.right.end(), ensemble.right.begin(), ensemble.right.end());
    }
    return sound;
}

TEST(Ensemble, PartsAddUpSampleBySample) {
    const SharedInstrument instrument = bass();
    const Score both = two_parts();
    Score first, second;
    first.parts = {both.parts[0]};
    second.parts = {both.parts[1]};
    const Sound sum = play(both, {instrument, instrument}, 1024, 1);
    const Sound a = play(first, {instrument}, 1024, 1);
    const Sound b = play(second, {instrument}, 1024, 1);
    double loudest = 0;
    for (std::size_t n = 0; n < sum.left.size(); ++n) {
        ASSERT_EQ(sum.left[n], a.left[n] + b.left[n]) << n;
        ASSERT_EQ(sum.right[n], a.right[n] + b.right[n]) << n;
        ASSERT_TRUE(n >= 100 || a.left[n] == 0);
        ASSERT_TRUE(n >= 1500 || b.left[n] == 0);
        loudest = std::max(loudest, std::abs(b.left[n]));
    }
    EXPECT_GT(loudest, 0);
}

TEST(Ensemble, BlocksDoNotChangeABit) {
    const SharedInstrument instrument = bass();
    const Score score = two_parts();
    const Sound whole = play(score, {instrument, instrument}, 6000, 0.5);
    for (const std::size_t block : {1UL, 7UL, 512UL}) {
        const Sound cut = play(score, {instrument, instrument}, block, 0.5);
        EXPECT_EQ(cut.left, whole.left) << block;
        EXPECT_EQ(cut.right, whole.right) << block;
    }
}

TEST(Ensemble, StemsAreNamedByPartPresetAndString) {
    const SharedInstrument instrument = bass();
    const Score score = two_parts();
    const Ensemble ensemble = make_ensemble(score, {instrument, instrument}, true, 1);
    EXPECT_EQ(ensemble.stem_names, (std::vector<std::string>{"1 bass-fretted E", "1 bass-fretted A",
                                                             "2 bass-fretted E", "2 bass-fretted A"}));
    EXPECT_EQ(ensemble.stems.size(), 4U);
}

}  // namespace
}  // namespace jawari::host
