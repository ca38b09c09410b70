#include <gtest/gtest.h>

#include "commands/play/options.h"

namespace jawari::host {
namespace {

std::string refusal_of(const std::string& keys) {
    const auto options = read_play_config(R"({"schema": "jawari.play-config/1", )" + keys + "}", "play.json");
    return options ? "accepted" : options.error().message;
}

TEST(PlayConfig, ReadsEveryKey) {
    const auto options =
        read_play_config(R"({"schema": "jawari.play-config/1", "comment": "mine", "preset": "sitar",
        "audio": "jack", "audio_device": "USB", "midi": "alsa", "midi_in": "virtual", "rate_hz": 44100, "frames": 64,
        "quality": "studio", "fixed_quality": true, "gain_db": -3, "limiter_dbfs": -1, "tuning": "a.scl", "keyboard_map": "a.kbm",
        "move_frets": true, "midi_map": "m.json", "guitar_channel": 2, "parameters": {"pan": 0.5, "palm_mute": 1},
        "osc_port": 7770, "osc_host": "0.0.0.0", "shell": false, "monitor": true, "retry": false,
        "lock_memory": true})",
                         "play.json");
    ASSERT_TRUE(options.ok()) << options.error().message;
    const PlayOptions& all = options.value();
    EXPECT_EQ(all.preset, "sitar");
    EXPECT_EQ(all.audio, "jack");
    EXPECT_EQ(all.audio_device, "USB");
    EXPECT_EQ(all.midi, "alsa");
    EXPECT_EQ(all.midi_in, "virtual");
    EXPECT_EQ(all.rate_hz, 44100U);
    EXPECT_EQ(all.frames, 64U);
    EXPECT_EQ(all.instrument.quality, Quality::Studio);
    EXPECT_EQ(all.fixed_quality, true);
    EXPECT_EQ(all.instrument.gain_db, -3);
    EXPECT_EQ(all.instrument.limiter_dbfs, -1);
    EXPECT_EQ(all.instrument.tuning, "a.scl");
    EXPECT_EQ(all.instrument.keyboard_map, "a.kbm");
    EXPECT_EQ(all.instrument.move_frets, true);
    EXPECT_EQ(all.instrument.midi_map, "m.json");
    EXPECT_EQ(all.instrument.guitar_channel, 2);
    EXPECT_EQ(all.instrument.parameters, (std::vector<std::pair<ParameterId, double>>{
                                             {ParameterId::Pan, 0.5}, {ParameterId::PalmMute, 1}}));
    EXPECT_EQ(all.osc_port, 7770);
    EXPECT_EQ(all.osc_host, "0.0.0.0");
    EXPECT_EQ(all.shell, false);
    EXPECT_EQ(all.monitor, true);
    EXPECT_EQ(all.retry, false);
    EXPECT_EQ(all.lock_memory, true);
}

TEST(PlayConfig, NamesWhatIsWrong) {
    EXPECT_EQ(refusal_of(R"("preset": "x")"), "accepted");
    EXPECT_EQ(refusal_of(R"("frames": 8)"), "play.json: frames: 8 (allowed: a whole number from 16 to 8192)");
    EXPECT_EQ(refusal_of(R"("shell": 1)"), "play.json: shell: 1 (allowed: true or false)");
    EXPECT_EQ(refusal_of(R"("parameters": {"pan": 2})"),
              "play.json: parameters.pan: 2 (allowed: a number from -1 to 1)");
    EXPECT_TRUE(
        refusal_of(R"("parameters": {"pam": 0})").starts_with("play.json: parameters.pam: unknown key"));
    EXPECT_TRUE(
        refusal_of(R"("audio": "tape")").starts_with("play.json: audio: \"tape\" (allowed: auto, jack,"));
    EXPECT_TRUE(refusal_of(R"("presett": "x")").starts_with("play.json: presett: unknown key"));
    EXPECT_EQ(refusal_of(R"("preset": "")"), "play.json: preset: \"\" (allowed: a name)");
    EXPECT_FALSE(read_play_config(R"({"preset": "x"})", "play.json").ok());
    EXPECT_FALSE(read_play_config("", "play.json").ok());
}

TEST(PlayConfig, TheCommandLineHasTheLastWord) {
    PlayOptions own;
    own.preset = "biwa";
    own.retry = true;
    own.instrument.parameters = {{ParameterId::Pan, 1}};
    PlayOptions file;
    file.preset = "sitar";
    file.frames = 64;
    file.retry = false;
    file.instrument.parameters = {{ParameterId::Pan, -1}, {ParameterId::Volume, 0.5}};
    const PlayOptions merged = merge(own, file);
    EXPECT_EQ(merged.preset, "biwa");
    EXPECT_EQ(merged.frames, 64U);
    EXPECT_EQ(merged.retry, true);
    EXPECT_EQ(merged.instrument.parameters.back(), (std::pair{ParameterId::Pan, 1.0}));  // the last one wins
    EXPECT_EQ(merged.instrument.parameters.size(), 3U);
}

}  // namespace
}  // namespace jawari::host
