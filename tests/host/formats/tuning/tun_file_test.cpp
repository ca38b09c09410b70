#include "formats/tuning/tun_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formats/tuning/tuning.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

std::string refusal(const std::string& text) {
    const auto keys = parse_tun(text);
    return keys ? "" : keys.failure().line();
}

double equal_hz(std::size_t key, double cents = 0) {
    return 440 * std::exp2((static_cast<double>(key) - 69) / 12.0 + cents / 1200);
}

TEST(TunFile, Version0HasWholeCentsAboveTheLowestC) {
    std::string text = "; a comment\r\n[Tuning]\r\n";
    for (int key = 0; key < 128; ++key)
        text += "note " + std::to_string(key) + "=" + std::to_string(100 * key + 7) + "\r\n";
    const auto keys = parse_tun(text).value();
    for (std::size_t key = 0; key < 128; ++key) EXPECT_NEAR(keys[key] / equal_hz(key, 7), 1, 1e-9);
}

TEST(TunFile, Version1HasExactPitchesAndABaseFrequency) {
    const auto keys =
        parse_tun(
            "[Scale Begin]\nFormat= \"AnaMark-TUN\"\nFormatVersion= 100\n"
            "[Tuning]\nnote 69=1\n"
            "[Exact Tuning]\nbasefreq = 10\nnote 0=0\nnote 60= 4800.5\nNote 127 = 1.27e4 ; ends\n"
            "[Scale End]\n")
            .value();
    EXPECT_NEAR(keys[60], 160 * std::exp2(0.5 / 1200), 1e-9);
    EXPECT_NEAR(keys[127], 10 * std::exp2(12700.0 / 1200), 1e-6);
    EXPECT_NEAR(keys[69], 10 * std::exp2(6900.0 / 1200), 1e-9);  // not given: equal steps
}

TEST(TunFile, NotesAboveTheHighestRepeatIt) {
    const auto keys = parse_tun("[Exact Tuning]\nnote 0=0\nnote 1=150\nnote 2=350\nnote 3=500\n").value();
    const double base = equal_hz(0);
    EXPECT_NEAR(keys[4], base * std::exp2(650.0 / 1200), 1e-9);
    EXPECT_NEAR(keys[6], base * std::exp2(1000.0 / 1200), 1e-9);
    EXPECT_NEAR(keys[30], base * std::exp2(5000.0 / 1200), 1e-9);
    const auto alone = parse_tun("[Exact Tuning]\nnote 0=30\n").value();  // no period
    EXPECT_NEAR(alone[1], equal_hz(1), 1e-9);
    EXPECT_NEAR(alone[0], equal_hz(0, 30), 1e-9);
}

TEST(TunFile, Version2IsReadByItsExactPitches) {
    const auto keys = parse_tun(
                          "[Scale Begin]\nFormatVersion= 200\n[Info]\nDescription= \"note 5=1 [Tuning]\"\n"
                          "[Functional Tuning]\nInitEqual = (69, 440)\nnote 69=\"! 440\"\n"
                          "[Exact Tuning]\nnote 12=1200\nnote 128=99999999\n"
                          "[Mapping]\nLoopSize = 0\n[Scale End]\n")
                          .value();
    EXPECT_NEAR(keys[69], 440, 1e-9);
}

TEST(TunFile, FormulasAloneAreComputed) {
    // Scale Workshop's way of a scale that repeats: 12 just fifths down to an octave.
    const auto keys =
        parse_tun(
            "[Scale Begin]\nFormatVersion= 200\n[Functional Tuning]\n"
            "note 1=\"#=0 % 150\"\nnote 2=\"#=0 % 700\"\nnote 3=\"#>-3 % 1200.0 ~999\" ; repeats\n"
            "note 60=\"! 261.6\"\n[Scale End]\n")
            .value();
    for (std::size_t key = 51; key < 69; ++key) {
        const double octaves = std::floor((static_cast<double>(key) - 60) / 3);
        const double cents[] = {0, 150, 700};
        EXPECT_NEAR(keys[key], 261.6 * std::exp2(octaves + cents[key % 3] / 1200), 1e-9) << key;
    }
}

TEST(TunFile, OfWhatEachKeyPlaysTheMappingIsAPart) {
    const std::string mapping = "[Mapping]\nLoopSize = 2\nKeyboard 0 = 1\nKeyboard 1 = 0\n";
    const auto mapped = parse_tun("[Functional Tuning]\nInitEqual=(69,440)\n" + mapping).value();
    EXPECT_NEAR(mapped[68], equal_hz(69), 1e-9);
    EXPECT_NEAR(mapped[69], equal_hz(68), 1e-9);
    const auto exact = parse_tun("[Exact Tuning]\nnote 127=12700\n" + mapping).value();
    EXPECT_NEAR(exact[68], equal_hz(68), 1e-9);
}

TEST(TunFile, WhatCannotBeReadIsRefusedWithItsLine) {
    const std::pair<std::string, std::string> wrong[] = {
        {"",
         "end of file: no notes (allowed: notes in a section [Exact Tuning], [Tuning] or [Functional "
         "Tuning])"},
        {"[Tuning]\n", "end of file: no notes"},
        {"note 5=500\n", "end of file: no notes"},
        {"[Functional Tuning]\nnote 12=\"#>-13 % 1200\"\n",
         "line 2: \"note 12=\"#>-13 % 1200\"\" (allowed: a formula of ! # * / % + ~"},
        {"[Functional Tuning]\nInitEqual=(128, 440)\n", "line 2: \"InitEqual=(128, 440)\" (allowed: (note, "},
        {"[Tuning]\nnote 1=x\n", "line 2: \"note 1=x\" (allowed: cents, -120000 to 120000)"},
        {"[Tuning]\nnote 1=nan\n", "line 2: "},
        {"[Exact Tuning]\nnote 1=1e300\n", "line 2: "},
        {"[Exact Tuning]\nbasefreq=0\nnote 1=1\n", "line 2: \"basefreq=0\" (allowed: 0.001 to 20000 Hz)"},
        {"[Scale Begin]\n[Scale End]\n[Scale Begin]\n",
         "line 3: \"[Scale Begin]\" (allowed: one scale in a file)"},
        {"[Mapping]\nKeyboard 1 = 128\n[Tuning]\nnote 1=100\n",
         "line 2: \"Keyboard 1 = 128\" (allowed: 0 to 127)"},
        {"[Mapping]\nLoopSize = -1\n", "line 2: \"LoopSize = -1\" (allowed: 0 to 128)"}};
    for (const auto& [text, message] : wrong) EXPECT_EQ(refusal(text).find(message), 0U) << refusal(text);
}

TEST(TunFile, PitchesThatNobodyHearsAreSilent) {
    const auto keys = parse_tun("[Exact Tuning]\nnote 0=-100000\nnote 1=100000\nnote 127=12700\n").value();
    EXPECT_TRUE(std::isnan(keys[0]));
    EXPECT_TRUE(std::isnan(keys[1]));
    EXPECT_FALSE(std::isnan(keys[2]));
}

TEST(TunFile, IsKnownByItsNameAndTakesNoKeyboardMap) {
    const test::TemporaryFolder folder;
    const std::string tun = folder.write("scale.TUN", "[Exact Tuning]\nnote 69=6950\nnote 127=12700\n");
    EXPECT_NEAR(load_tuning(tun, "").value()[69], equal_hz(69, 50), 1e-9);
    const auto refused = load_tuning(tun, folder.write("a.kbm", ""));
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_NE(refused.error().message.find("--keyboard-map"), std::string::npos);
    const auto bad = load_tuning(folder.write("bad.tun", "[Tuning]\nnote 1=\n"), "");
    EXPECT_EQ(bad.error().kind, ErrorKind::InvalidInput);
    EXPECT_NE(bad.error().message.find("bad.tun: line 2: "), std::string::npos);
}

TEST(TunFile, AScaleWithAReferenceIsTunedToItUnlessAMapSaysOtherwise) {
    const test::TemporaryFolder folder;
    const std::string scale = folder.write("a.ascl", "x\n1\n100.0\n! @ABL REFERENCE_PITCH 4 0 262\n");
    EXPECT_EQ(load_tuning(scale, "").value()[60], 262);
    EXPECT_EQ(load_tuning(scale, folder.write("a.kbm", "0\n0\n127\n60\n60\n270.0\n0\n")).value()[60], 270);
}

}  // namespace
}  // namespace jawari::host
