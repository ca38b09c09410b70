// 16-bit files are dithered: what is smaller than a step is there on the mean, and silence is silent.
#include "commands/render/audio_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "support/read_wav.h"

namespace jawari::host {
namespace {

std::vector<double> written(double sample, std::size_t frames) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("a.wav");
    auto file = AudioFile::create(path, 1, {48000, SampleFormat::Pcm16, frames, {"t", "c"}});
    EXPECT_TRUE(file.ok());
    const std::vector<double> sound(frames, sample);
    const std::span<const double> channel(sound);
    EXPECT_FALSE(file.value().write({&channel, 1}));
    EXPECT_FALSE(file.value().commit());
    const std::string data = test::read_wav(path).data;
    std::vector<double> steps;
    for (std::size_t i = 0; i + 2 <= data.size(); i += 2) {
        std::int16_t value = 0;
        std::memcpy(&value, data.data() + i, 2);
        steps.push_back(value);
    }
    return steps;
}

/// Triangular noise of two steps: the mean of the rounded samples is the sample, and the error's power is 1/4
/// of a step squared, whatever the sample is.
TEST(AudioFile, SixteenBitsAreDithered) {
    const std::size_t frames = 100000;
    for (const double step : {0.3, 0.5, 1000.8}) {
        const std::vector<double> steps = written(step / 32767, frames);
        ASSERT_EQ(steps.size(), frames);
        double mean = 0, power = 0;
        for (const double value : steps) {
            mean += (value - step) / frames;
            power += (value - step) * (value - step) / frames;
        }
        EXPECT_NEAR(mean, 0, 0.01) << step;
        EXPECT_NEAR(power, 0.25, 0.01) << step;
    }
}

TEST(AudioFile, SilenceIsNotDithered) {
    for (const double value : written(0, 1000)) ASSERT_EQ(value, 0);
}

TEST(AudioFile, TheNoiseIsTheSameEachTime) {
    EXPECT_EQ(written(0.1, 5000), written(0.1, 5000));
}

}  // namespace
}  // namespace jawari::host
