// Values as a host shows them, and back.
#include "plugin/core/parameter_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jawari::host {
namespace {

using enum ParameterId;

TEST(ParameterText, IsWhatPeopleSay) {
    EXPECT_EQ(parameter_text(Volume, 0.35), "35 %");
    EXPECT_EQ(parameter_text(Pan, 0), "centre");
    EXPECT_EQ(parameter_text(Pan, -0.5), "L 50");
    EXPECT_EQ(parameter_text(Pan, 1), "R 100");
    EXPECT_EQ(parameter_text(PluckPosition, 0.25), "0.25 x");
    EXPECT_EQ(parameter_text(Harmonic, 1), "off");
    EXPECT_EQ(parameter_text(Harmonic, 3), "1/3 of the string");
    EXPECT_EQ(parameter_text(Articulation, 0), "by the preset");
    EXPECT_EQ(parameter_text(Articulation, 2), "exciter 2");
    EXPECT_EQ(parameter_text(Legato, 1), "on");
    EXPECT_EQ(parameter_text(SlideTime, 0.25), "250 ms");
    EXPECT_EQ(parameter_text(VibratoDepth, 0.5), "0.50 st");
    EXPECT_EQ(parameter_text(VibratoRate, 5), "5.00 Hz");
    EXPECT_EQ(parameter_text(Action, -0.0005), "-0.50 mm");
    EXPECT_EQ(parameter_text(Action, -0.000001), "0.00 mm");
}

TEST(ParameterText, IsReadInItsUnitOrWithoutOne) {
    EXPECT_EQ(parameter_from_text(Volume, " 35 % "), 0.35);
    EXPECT_EQ(parameter_from_text(Volume, "35"), 0.35);
    EXPECT_EQ(parameter_from_text(Pan, "L50"), -0.5);
    EXPECT_EQ(parameter_from_text(Pan, "center"), 0.0);
    EXPECT_EQ(parameter_from_text(Pan, "-20"), -0.2);
    EXPECT_EQ(parameter_from_text(Harmonic, "1/3 of the STRING"), 3.0);
    EXPECT_EQ(parameter_from_text(Harmonic, "4"), 4.0);
    EXPECT_EQ(parameter_from_text(Action, "1.5 mm"), 0.0015);
    EXPECT_EQ(parameter_from_text(SlideTime, "250 ms"), 0.25);
}

TEST(ParameterText, IsClampedToTheRangeAndRefusedIfItIsNone) {
    EXPECT_EQ(parameter_from_text(Volume, "400 %"), 1.0);
    EXPECT_EQ(parameter_from_text(VibratoRate, "-3"), 0.1);
    EXPECT_EQ(parameter_from_text(Harmonic, "99"), 7.0);
    for (const char* text : {"", " ", "loud", "%", "1 2", "nan", "inf", "L", "Lx", "Lnan"})
        for (const ParameterId id : {Volume, Pan, Harmonic, Action})
            EXPECT_EQ(parameter_from_text(id, text), std::nullopt) << text;
}

/// What is shown reads back as a value that is shown the same, everywhere in every range.
TEST(ParameterText, ReadsBackAsWhatIsShown) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        for (int step = 0; step <= 1000; ++step) {
            const double value = parameter_value(parameter, step / 1000.0);
            const std::string text = parameter_text(parameter.id, value);
            const auto back = parameter_from_text(parameter.id, text);
            ASSERT_TRUE(back) << parameter.key << " " << text;
            EXPECT_EQ(parameter_text(parameter.id, *back), text) << parameter.key;
            EXPECT_NEAR(*back, value, 0.006 * std::max(1.0, parameter.high - parameter.low)) << text;
        }
    }
}

TEST(ParameterTable, NamesAndGroupsAreThereAndNamesDiffer) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        EXPECT_FALSE(parameter.name.empty());
        EXPECT_FALSE(parameter.group.empty());
        for (const ParameterDeclaration& other : parameter_table())
            EXPECT_TRUE(other.id == parameter.id || other.name != parameter.name) << parameter.name;
    }
}

}  // namespace
}  // namespace jawari::host
