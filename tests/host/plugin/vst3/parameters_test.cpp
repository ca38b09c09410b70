// Parameters from 0 to 1, units, programs, and controllers as parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/builtin.h"
#include "support/clap_host.h"
#include "support/vst3_questions.h"

namespace jawari::host {
namespace {

using test::info_of;
using test::loudest;
using test::ready;
using test::small_state;
using test::text_of;
using test::value_of;
using test::Vst3Instance;

/// Sessions and automation keep ids: 0 to 19 of the table, 1000 of the preset, 10000 on of controllers.
TEST(Vst3Parameters, IdsAreFrozenAndOnce) {
    Vst3Instance one;
    const auto count = v3_cpp_obj(one.controller)->get_parameter_count(one.controller);
    ASSERT_EQ(count, 20 + 1 + 16 * 130);
    std::set<v3_param_id> ids;
    for (std::int32_t i = 0; i < count; ++i) {
        const v3_param_info info = info_of(one, i);
        ids.insert(info.param_id);
        EXPECT_EQ((info.flags & V3_PARAM_IS_HIDDEN) != 0, info.param_id >= 10000) << info.param_id;
        EXPECT_EQ((info.flags & V3_PARAM_PROGRAM_CHANGE) != 0, info.param_id == test::vst3_program);
    }
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(ids.contains(19) && ids.contains(test::vst3_program) && ids.contains(10000) &&
                ids.contains(12079));
    EXPECT_EQ(vst3::read_text(info_of(one, 6).title), "Palm mute");
    EXPECT_EQ(vst3::read_text(info_of(one, 6).short_title), "PalmMute");
}

TEST(Vst3Parameters, DefaultsAreWhatANewInstanceHas) {
    Vst3Instance one;
    auto* const controller = v3_cpp_obj(one.controller);
    for (std::int32_t i = 0; i < 20; ++i) {
        const v3_param_info info = info_of(one, i);
        EXPECT_DOUBLE_EQ(info.default_normalised_value,
                         controller->get_parameter_normalised(one.controller, info.param_id));
        const ParameterDeclaration& parameter = parameter_table()[static_cast<std::size_t>(i)];
        EXPECT_NEAR(one.value(info.param_id), parameter.neutral, 1e-12 * (1 + std::abs(parameter.neutral)));
    }
}

TEST(Vst3Parameters, TextsGoBothWays) {
    Vst3Instance one;
    EXPECT_EQ(text_of(one, 6, 0.35), "35 %");
    EXPECT_DOUBLE_EQ(value_of(one, 6, "35 %"), 0.35);
    EXPECT_EQ(text_of(one, 8, 2.0 / 6), "1/3 of the string");
    EXPECT_DOUBLE_EQ(value_of(one, 8, "1/3 of the string"), 2.0 / 6);
    EXPECT_EQ(text_of(one, 3, 0.5), "1.00 x");  // exponential: the middle of 1/4 to 4
    EXPECT_EQ(value_of(one, 6, "nonsense"), -1);
    EXPECT_EQ(text_of(one, test::vst3_program, 0), "(as loaded)");
    EXPECT_EQ(text_of(one, 10000 + 74, 1), "127");
    EXPECT_NE(v3_cpp_obj(one.controller)->get_parameter_string_for_value(one.controller, 500, 0.5, nullptr),
              V3_OK);
}

TEST(Vst3Parameters, ValuesOutsideZeroToOneAreRefused) {
    Vst3Instance one;
    for (const double value : {-0.1, 1.1, std::nan(""), HUGE_VAL}) EXPECT_NE(one.set(6, value), V3_OK);
    EXPECT_NE(one.set(777, 0.5), V3_OK);
    EXPECT_EQ(one.value(6), 0);
}

TEST(Vst3Parameters, ValuesSetWhileInactiveAreInForce) {
    Vst3Instance one;
    EXPECT_EQ(one.set(6, 0.5), V3_OK);
    EXPECT_NE(one.save().find("\"palm_mute\": 0.5"), std::string::npos);
}

/// The controls follow the automation with a delay: what they say is no news to the sound.
TEST(Vst3Parameters, WhilePlayingTheBlocksAloneDecide) {
    Vst3Instance one;
    ready({&one});
    one.events.parameter(10, 6, 0.75);
    one.process(100);
    EXPECT_EQ(one.set(6, 0.25), V3_OK);
    one.process(100);
    EXPECT_NE(one.save().find("\"palm_mute\": 0.75"), std::string::npos);
}

/// At its frame inside a block, as CLAP has it.
TEST(Vst3Parameters, ValuesCountFromTheirFrame) {
    Vst3Instance one;
    test::ClapInstance other;
    ready({&one});
    ASSERT_TRUE(other.load(small_state()));
    ASSERT_TRUE(other.activate());
    const auto play = [](auto& each) {
        each.events.midi(0, 0x90, 33, 100);
        each.events.parameter(700, 6, 0.5);
        each.events.midi(900, 0x90, 45, 100);
        each.events.midi(1200, 0xB0, 1, 90);
        each.events.parameter(1501, 6, 0.0);
    };
    play(one);
    play(other);
    one.process(6000);
    other.process(6000);
    EXPECT_EQ(one.left, other.left);
    test::ClapInstance without;
    ASSERT_TRUE(without.load(small_state()));
    ASSERT_TRUE(without.activate());
    without.events.midi(0, 0x90, 33, 100);
    without.events.midi(900, 0x90, 45, 100);
    without.events.midi(1200, 0xB0, 1, 90);
    without.process(6000);
    EXPECT_NE(one.left, without.left);
}

TEST(Vst3Parameters, MoreChangesThanItHasRoomForAreAllTaken) {
    Vst3Instance crowded, plain;
    ready({&crowded, &plain});
    for (int n = 0; n < 10000; ++n) crowded.events.parameter(100, 1, (n % 100) / 100.0);
    for (Vst3Instance* each : {&crowded, &plain}) {
        each->events.parameter(100, 1, 0.5625);
        each->events.note_on(200, 40, 1);
        each->process(3000);
        EXPECT_NE(each->save().find("\"expression\": 0.5625"), std::string::npos);
    }
    EXPECT_EQ(crowded.left, plain.left);
    EXPECT_GT(loudest(plain.left), 1e-3);
}

TEST(Vst3Parameters, ControllersAreMapped) {
    Vst3Instance one;
    v3_midi_mapping** mapping = nullptr;
    ASSERT_EQ(v3_cpp_obj_query_interface(one.component, v3_midi_mapping_iid, &mapping), V3_OK);
    const auto ask = [&](std::int32_t bus, std::int16_t channel, std::int16_t controller) {
        v3_param_id id = 0;
        const auto& table = **reinterpret_cast<v3_midi_mapping_cpp**>(mapping);
        return table.map.get_midi_controller_assignment(mapping, bus, channel, controller, &id) == V3_OK ? id
                                                                                                         : 0;
    };
    EXPECT_EQ(ask(0, 0, 0), 10000U);
    EXPECT_EQ(ask(0, 3, 74), 10000U + 3 * 130 + 74);
    EXPECT_EQ(ask(0, 15, 129), 12079U);
    EXPECT_EQ(ask(1, 0, 0), 0U);
    EXPECT_EQ(ask(0, 16, 0), 0U);
    EXPECT_EQ(ask(0, 0, 130), 0U);
    v3_cpp_obj_unref(mapping);
}

TEST(Vst3Parameters, GroupsAreUnitsAndPresetsAreAList) {
    Vst3Instance one;
    v3_unit_information** units = nullptr;
    ASSERT_EQ(v3_cpp_obj_query_interface(one.component, v3_unit_information_iid, &units), V3_OK);
    const auto& table = (**reinterpret_cast<v3_unit_information_cpp**>(units)).unit;
    const std::int32_t count = table.get_unit_count(units);
    std::set<std::string> names;
    for (std::int32_t u = 0; u < count; ++u) {
        v3_unit_info info{};
        ASSERT_EQ(table.get_unit_info(units, u, &info), V3_OK);
        names.insert(vst3::read_text(info.name));
    }
    for (std::int32_t i = 0; i < 20; ++i) {
        v3_unit_info unit{};
        ASSERT_EQ(table.get_unit_info(units, info_of(one, i).unit_id, &unit), V3_OK);
        EXPECT_EQ(vst3::read_text(unit.name), parameter_table()[static_cast<std::size_t>(i)].group);
    }
    v3_program_list_info list{};
    ASSERT_EQ(table.get_program_list_info(units, 0, &list), V3_OK);
    EXPECT_EQ(list.programCount, 1 + static_cast<std::int32_t>(builtin_files("instruments").size()));
    std::set<std::string> presets;
    for (std::int32_t p = 0; p < list.programCount; ++p) {
        std::array<std::int16_t, 128> name{};
        ASSERT_EQ(table.get_program_name(units, list.id, p, name.data()), V3_OK);
        presets.insert(vst3::read_text(name.data()));
    }
    EXPECT_EQ(presets.size(), static_cast<std::size_t>(list.programCount));
    EXPECT_TRUE(presets.contains("Sitar"));
    v3_cpp_obj_unref(units);
}

/// As Ardour does when it opens a session: what the controls say, as doubles or rounded to floats, while
/// inactive and in a block.
TEST(Vst3Parameters, WhatAHostRepeatsLeavesAStateAsItIs) {
    auto state = nlohmann::ordered_json::parse(small_state());
    state["parameters"] = {
        {"palm_mute", 0.1}, {"pluck_position", 0.7}, {"release_time", 1.3}, {"vibrato_rate", 5.0}};
    for (const bool as_float : {false, true}) {
        Vst3Instance one;
        ASSERT_TRUE(one.load(state.dump()));
        const std::string before = one.save();
        const auto told = [&](v3_param_id id) {
            const double travel = v3_cpp_obj(one.controller)->get_parameter_normalised(one.controller, id);
            return as_float ? static_cast<double>(static_cast<float>(travel)) : travel;
        };
        for (v3_param_id id = 0; id < parameter_count; ++id)
            EXPECT_EQ(v3_cpp_obj(one.controller)->set_parameter_normalised(one.controller, id, told(id)),
                      V3_OK);
        EXPECT_EQ(one.save(), before);
        ASSERT_TRUE(one.activate());
        for (v3_param_id id = 0; id < parameter_count; ++id) one.events.point(0, id, told(id));
        one.process(64);
        EXPECT_EQ(one.save(), before);
    }
}

}  // namespace
}  // namespace jawari::host
