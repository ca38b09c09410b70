#include "plugin/vst3/text16.h"

#include <gtest/gtest.h>

#include <array>

namespace jawari::host::vst3 {
namespace {

std::array<std::int16_t, text_room> written(std::string_view text) {
    std::array<std::int16_t, text_room> units{};
    units.fill(-1);
    write_text(text, units.data());
    return units;
}

TEST(Text16, CharactersOfOneToFourBytesAreTheUnitsOfUnicode) {
    const auto units = written("a\xC3\xA9\xE2\x82\xAC\xF0\x9D\x84\x9E");  // a, e acute, euro, G clef
    const std::array<std::uint16_t, 6> right{0x61, 0xE9, 0x20AC, 0xD834, 0xDD1E, 0};
    for (std::size_t i = 0; i < right.size(); ++i)
        EXPECT_EQ(static_cast<std::uint16_t>(units[i]), right[i]) << i;
}

TEST(Text16, GoesRound) {
    const std::string text = "Biwa (\xE7\x90\xB5\xE7\x90\xB6), 1/3 \xF0\x9D\x84\x9E";
    EXPECT_EQ(read_text(written(text).data()), text);
}

TEST(Text16, WhatHasNoRoomIsLeftOutByWholeCharacters) {
    std::string text(126, 'x');
    text += "\xF0\x9D\x84\x9E";  // two units, one place
    EXPECT_EQ(read_text(written(text).data()), std::string(126, 'x'));
    std::int16_t one = 5;
    write_text("abc", &one, 1);
    EXPECT_EQ(one, 0);
}

/// Overlong forms, halves of pairs, bytes past U+10FFFF, and texts that end in the middle (RFC 3629, section
/// 3).
TEST(Text16, WhatIsNoUtf8IsReplaced) {
    const std::string mark = "\xEF\xBF\xBD";
    for (const char* bytes :
         {"\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82", "\xFF"}) {
        const std::string read = read_text(written(bytes).data());
        EXPECT_EQ(read.substr(0, 3), mark) << bytes;
    }
    std::array<std::int16_t, 3> half{static_cast<std::int16_t>(0xD834), 0x61, 0};
    EXPECT_EQ(read_text(half.data(), half.size()), mark + "a");
}

}  // namespace
}  // namespace jawari::host::vst3
