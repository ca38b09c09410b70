#include "midi/guitar_mode.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

TEST(GuitarMode, TheFirstChannelPlaysTheLastCourse) {
    InstrumentDescription instrument;
    instrument.strings.resize(5);
    instrument.strings[0].course = 7;
    instrument.strings[1].course = 7;
    instrument.strings[3].course = 2;
    instrument.strings[4].course = 2;
    InterpreterSettings settings;
    ASSERT_FALSE(set_guitar_mode(instrument, 13, settings));
    EXPECT_EQ(settings.guitar_channel, 13);
    EXPECT_EQ(settings.guitar_strings, 3);
    EXPECT_EQ(settings.guitar_string[0], 3);
    EXPECT_EQ(settings.guitar_string[1], 2);
    EXPECT_EQ(settings.guitar_string[2], 0);
}

TEST(GuitarMode, ChannelsMustSuffice) {
    InstrumentDescription instrument;
    instrument.strings.resize(6);
    InterpreterSettings settings;
    EXPECT_FALSE(set_guitar_mode(instrument, 10, settings));
    const auto refused = set_guitar_mode(instrument, 11, settings);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->kind, ErrorKind::Usage);
    EXPECT_NE(refused->message.find("--guitar-mode: 12 (allowed: 1 to 11 for this preset's 6"),
              std::string::npos);
    instrument.strings.resize(20);
    EXPECT_NE(set_guitar_mode(instrument, 0, settings)->message.find("at most 16"), std::string::npos);
}

}  // namespace
}  // namespace jawari::host
