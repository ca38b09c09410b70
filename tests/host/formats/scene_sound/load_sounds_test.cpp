#include "formats/scene_sound/load_sounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene/read_scene.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

/// 16 bits, 8000 Hz, one channel.
std::string wav_of(const std::vector<int>& samples) {
    const auto number = [](std::size_t value, int bytes) {
        std::string text;
        for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
        return text;
    };
    std::string data;
    for (const int sample : samples) data += number(static_cast<std::size_t>(sample) & 65535, 2);
    return "RIFF" + number(36 + data.size(), 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
           number(8000, 4) + number(16000, 4) + number(2, 2) + number(16, 2) + "data" +
           number(data.size(), 4) + data;
}

std::string scene_with_force(const std::string& force) {
    return R"({"schema": "jawari.scene/1", "duration_s": 0.01, "output_rate_hz": 16000, "contact_rate_hz": 16000,
 "strings": [{"length_m": 1, "linear_density_kg_per_m": 1, "modes": {"count": 4, "tension_N": 100},
 "forces": [{"position_m": 0.3, )" +
           force + "}], \"probes\": [{\"quantity\": \"energy\"}]}]}";
}

TEST(LoadSounds, ASoundIsAForceAtTheOutputRate) {
    const test::TemporaryFolder folder;
    folder.write("push.wav", wav_of({0, 16384, -8192, 0}));
    auto scene = load_scene(folder.write("s.json", scene_with_force(R"("sound": "push.wav", "scale_N": 4)")));
    ASSERT_TRUE(scene);
    const auto error = load_sounds(scene.value());
    ASSERT_FALSE(error) << error->message;
    const std::vector<double>& force = scene.value().description.strings[0].forces[0].force_N;
    const std::vector<double> expected{0, 1, 2, 0.5, -1, -0.5, 0, 0};
    ASSERT_GE(force.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(force[n], expected[n], 1e-12) << n;
}

TEST(LoadSounds, WhatCannotBeReadIsRefused) {
    const test::TemporaryFolder folder;
    auto missing = load_scene(folder.write("s.json", scene_with_force(R"("sound": "none.wav")")));
    const auto error = load_sounds(missing.value());
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("strings[0].forces[0].sound"), std::string::npos) << error->message;
    folder.write("push.wav", wav_of({1}));
    auto channel =
        load_scene(folder.write("s.json", scene_with_force(R"("sound": "push.wav", "channel": 1)")));
    const auto second = load_sounds(channel.value());
    ASSERT_TRUE(second);
    EXPECT_NE(second->message.find("strings[0].forces[0].channel: 1"), std::string::npos) << second->message;
}

TEST(LoadSounds, NoOutputReplacesASound) {
    const test::TemporaryFolder folder;
    const std::string sound = folder.write("push.wav", wav_of({0, 1000, 0}));
    const std::string scene = folder.write("s.json", scene_with_force(R"("sound": "push.wav")"));
    const auto run = test::jawari({"simulate", scene, "--out", sound, "--overwrite"});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(test::read_text(sound), wav_of({0, 1000, 0}));
}

}  // namespace
}  // namespace jawari::host
