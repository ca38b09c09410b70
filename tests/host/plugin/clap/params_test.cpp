// Parameters as a CLAP host sees them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "jawari/parameters.h"
#include "support/clap_host.h"

namespace jawari::host {
namespace {

using test::ClapInstance;
using test::small_state;

clap_param_info_t info_of(const ClapInstance& one, std::uint32_t index) {
    clap_param_info_t info{};
    EXPECT_TRUE(one.params().get_info(one.plugin, index, &info));
    return info;
}

/// Sessions hold these numbers: they never change, new ones come after them.
TEST(ClapParams, IdsAreFrozen) {
    const std::array<const char*, 20> names{
        "Volume",         "Expression", "Pan",           "Pluck position", "Pluck hardness",
        "Velocity curve", "Palm mute",  "Palm position", "Harmonic",       "Dead note",
        "Articulation",   "Legato",     "Slide time",    "Vibrato depth",  "Vibrato rate",
        "Bend range",     "Pickup mix", "Body mix",      "Release time",   "Action"};
    ClapInstance one;
    ASSERT_EQ(one.params().count(one.plugin), names.size());
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(info_of(one, i).id, i);
        EXPECT_STREQ(info_of(one, i).name, names[i]);
    }
    clap_param_info_t none{};
    EXPECT_FALSE(one.params().get_info(one.plugin, 20, &none));
}

TEST(ClapParams, RangesDefaultsAndGroupsAreThoseOfTheTable) {
    ClapInstance one;
    std::set<std::string> groups;
    for (std::uint32_t i = 0; i < parameter_count; ++i) {
        const clap_param_info_t info = info_of(one, i);
        const ParameterDeclaration& declared = parameter_table()[i];
        EXPECT_EQ(info.min_value, declared.low);
        EXPECT_EQ(info.max_value, declared.high);
        EXPECT_EQ(info.default_value, declared.neutral);
        EXPECT_EQ(one.value(i), declared.neutral);
        EXPECT_TRUE(info.flags & CLAP_PARAM_IS_AUTOMATABLE);
        EXPECT_EQ((info.flags & CLAP_PARAM_IS_STEPPED) != 0, declared.curve == Curve::Stepped);
        groups.insert(info.module);
    }
    EXPECT_EQ(groups, (std::set<std::string>{"Instrument", "Left hand", "Mix", "Pluck", "Right hand"}));
}

TEST(ClapParams, TextsGoBothWaysAndFitTheirPlace) {
    ClapInstance one;
    std::array<char, 64> text{};
    ASSERT_TRUE(one.params().value_to_text(one.plugin, 8, 3, text.data(), text.size()));
    EXPECT_STREQ(text.data(), "1/3 of the string");
    double value = 0;
    ASSERT_TRUE(one.params().text_to_value(one.plugin, 8, text.data(), &value));
    EXPECT_EQ(value, 3);
    std::array<char, 6> narrow{'#', '#', '#', '#', '#', '#'};
    ASSERT_TRUE(one.params().value_to_text(one.plugin, 8, 3, narrow.data(), 5));
    EXPECT_STREQ(narrow.data(), "1/3 ");
    EXPECT_EQ(narrow[5], '#');
    EXPECT_FALSE(one.params().value_to_text(one.plugin, 20, 3, text.data(), text.size()));
    EXPECT_FALSE(one.params().text_to_value(one.plugin, 0, "loud", &value));
}

TEST(ClapParams, ValuesAreTakenWhileInactiveAndInBlocks) {
    ClapInstance one;
    ASSERT_TRUE(one.load(small_state()));
    const auto flush = [&] {
        one.params().flush(one.plugin, one.events.list(), nullptr);
        one.events.clear();
    };
    one.events.parameter(0, 0, 0.5);
    flush();
    EXPECT_EQ(one.value(0), 0.5);
    ASSERT_TRUE(one.activate());
    EXPECT_EQ(one.value(0), 0.5);
    one.events.parameter(0, 0, 0.25);
    flush();
    EXPECT_EQ(one.value(0), 0.25);
    one.events.parameter(3, 0, 0.75);
    one.process(10);
    EXPECT_EQ(one.value(0), 0.75);
    one.events.parameter(3, 0, std::numeric_limits<double>::quiet_NaN());
    one.events.parameter(3, 2, 1e9);
    one.process(10);
    EXPECT_EQ(one.value(0), 0.75);
    EXPECT_EQ(one.value(2), 1);
}

/// A change of volume at a frame changes the sound from that frame on, not before.
TEST(ClapParams, ChangesCountFromTheirFrame) {
    ClapInstance changed, plain;
    for (ClapInstance* each : {&changed, &plain}) {
        ASSERT_TRUE(each->load(small_state()));
        ASSERT_TRUE(each->activate());
        each->events.note_on(0, 33, 0.9);
        each->process(1000);
        each->events.note_on(516, 38, 0.9);
        if (each == &changed) each->events.parameter(517, 3, 4.0);  // pluck position: of the next note
        each->events.note_on(517, 43, 0.9);
        each->process(2000);
    }
    std::size_t first = 0;
    while (first < plain.left.size() && plain.left[first] == changed.left[first]) ++first;
    EXPECT_GE(first, 1517U);
    EXPECT_LT(first, 1540U);
}

/// A volume set while inactive, in a flush and at the first frame give one sound: that of half the factor.
TEST(ClapParams, ItDoesNotMatterHowAValueGotThere) {
    std::vector<std::vector<float>> sounds;
    for (int way = 0; way < 4; ++way) {
        ClapInstance one;
        ASSERT_TRUE(one.load(small_state()));
        if (way == 0) {
            one.events.parameter(0, 0, 0.5);
            one.params().flush(one.plugin, one.events.list(), nullptr);
            one.events.clear();
        }
        ASSERT_TRUE(one.activate());
        if (way == 1) {
            one.events.parameter(0, 0, 0.5);
            one.params().flush(one.plugin, one.events.list(), nullptr);
            one.events.clear();
        }
        if (way == 2) one.events.parameter(0, 0, 0.5);
        one.events.note_on(0, 33, 0.9);
        one.render(2000);
        sounds.push_back(one.left);
    }
    EXPECT_EQ(sounds[0], sounds[1]);
    EXPECT_EQ(sounds[0], sounds[2]);
    for (std::size_t n = 0; n < 2000; ++n) ASSERT_NEAR(sounds[0][n], 0.5F * sounds[3][n], 1e-7F);
}

}  // namespace
}  // namespace jawari::host
