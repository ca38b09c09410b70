#include "devices/audio_devices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace jawari::host {
namespace {

const std::vector<std::string> cards{"hw:USB Audio", "hw:HDA Intel", "hw:HDA NVidia", "7"};

TEST(MatchName, TakesNumbersWholeNamesAndParts) {
    EXPECT_EQ(match_name(cards, "1", "audio device").value(), 1U);
    EXPECT_EQ(match_name(cards, "usb", "audio device").value(), 0U);
    EXPECT_EQ(match_name(cards, "NVIDIA", "audio device").value(), 2U);
    EXPECT_EQ(match_name(cards, "HW:hda intel", "audio device").value(), 1U);
    EXPECT_EQ(match_name(cards, "7", "audio device").value(), 3U);  // no such number, but a name
}

TEST(MatchName, RefusesUnknownAndAmbiguousOnesInOneLine) {
    const auto unknown = match_name(cards, "Focusrite\n", "audio device");
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().kind, ErrorKind::Device);
    EXPECT_EQ(unknown.error().message,
              "\"Focusrite\\x0a\": no audio device has that number or name (0 \"hw:USB Audio\", 1 \"hw:HDA "
              "Intel\", "
              "2 \"hw:HDA NVidia\", 3 \"7\")");
    const auto ambiguous = match_name(cards, "hda", "audio device");
    ASSERT_FALSE(ambiguous.ok());
    EXPECT_NE(ambiguous.error().message.find("more than one audio device"), std::string::npos);
    EXPECT_NE(match_name({}, "0", "MIDI input").error().message.find("none is there"), std::string::npos);
}

TEST(MatchName, AWholeNameWinsOverParts) {
    EXPECT_EQ(match_name({"Piano 2", "Piano"}, "piano", "MIDI input").value(), 1U);
}

AudioDevice with_rates(std::vector<unsigned int> rates_hz, unsigned int preferred_hz = 0) {
    AudioDevice device;
    device.rates_hz = std::move(rates_hz);
    device.preferred_rate_hz = preferred_hz;
    return device;
}

TEST(ChooseRate, KeepsWhatTheDeviceHas) {
    EXPECT_EQ(choose_rate(with_rates({44100, 48000, 96000}, 96000), 48000), 48000U);
    EXPECT_EQ(choose_rate(with_rates({}), 48000), 48000U);  // says nothing
}

TEST(ChooseRate, FollowsTheDeviceElse) {
    EXPECT_EQ(choose_rate(with_rates({44100, 96000}, 96000), 48000), 96000U);
    EXPECT_EQ(choose_rate(with_rates({22050, 44100, 96000}), 48000), 44100U);
}

TEST(AudioSystems, AreTriedServersFirst) {
    const auto& words = audio_system_words();
    EXPECT_EQ(std::vector<std::string>(words.begin(), words.begin() + 3),
              (std::vector<std::string>{"jack", "pulse", "alsa"}));
    for (const std::string& system : audio_systems())
        EXPECT_NE(std::find(words.begin(), words.end(), system), words.end());
}

}  // namespace
}  // namespace jawari::host
