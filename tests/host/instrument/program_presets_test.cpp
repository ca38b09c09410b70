#include "instrument/program_presets.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace jawari::host {
namespace {

TEST(ProgramPresets, GeneralMidiPrograms) {
    EXPECT_EQ(program_preset(0, 33), "bass-fretted");  // electric bass (finger), 34 counted from 1
    EXPECT_EQ(program_preset(0, 36), "bass-slap");
    EXPECT_EQ(program_preset(0, 24), "guitar-nylon");
    EXPECT_EQ(program_preset(0, 6), "harpsichord");
    EXPECT_EQ(program_preset(0, 104), "sitar");
    EXPECT_EQ(program_preset(8 * 128, 24), "guitar-nylon");  // a variation bank
    EXPECT_FALSE(program_preset(0, 40));                     // violin: bowed
    EXPECT_FALSE(program_preset(0, 73));                     // flute
    EXPECT_FALSE(program_preset(0, 128));
}

TEST(ProgramPresets, ABankOfAllPresets) {
    const auto all = numbered_presets();
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(program_preset(numbered_bank, static_cast<int>(i)), all[i]);
    EXPECT_FALSE(program_preset(numbered_bank, static_cast<int>(all.size())));
}

TEST(ProgramPresets, EveryPitchedProgramHasOnePresetAndEffectsHaveNone) {
    const auto all = numbered_presets();
    for (int program = 0; program < 128; ++program) {
        const bool unpitched = program == 113 || program >= 115;
        const auto own = program_preset(0, program), nearest = nearest_preset(program);
        EXPECT_EQ(own.has_value() + nearest.has_value(), unpitched ? 0 : 1) << program;
        if (nearest) {
            EXPECT_TRUE(std::find(all.begin(), all.end(), *nearest) != all.end()) << program;
        }
    }
}

TEST(ProgramPresets, EveryProgramNamesANumberedPreset) {
    const auto all = numbered_presets();
    for (int program = 0; program < 128; ++program) {
        const auto preset = program_preset(0, program);
        EXPECT_TRUE(!preset || std::find(all.begin(), all.end(), *preset) != all.end()) << program;
    }
}

}  // namespace
}  // namespace jawari::host
