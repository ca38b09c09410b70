// The file, the buses and the states of VST 3.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/vst3_questions.h"

namespace jawari::host {
namespace {

using test::info_of;
using test::small_state;
using test::text_of;
using test::Vst3Instance;

TEST(Vst3, TheFileOffersOneClassByItsExactId) {
    v3_plugin_factory_3** const factory = test::vst3_factory();
    const auto& table = **reinterpret_cast<v3_plugin_factory_cpp**>(factory);
    ASSERT_EQ(table.v1.num_classes(factory), 1);
    v3_class_info_3 info{};
    ASSERT_EQ(table.v3.get_class_info_utf16(factory, 0, &info), V3_OK);
    EXPECT_STREQ(info.category, "Audio Module Class");
    EXPECT_STREQ(info.sub_categories, "Instrument|Synth");
    EXPECT_EQ(vst3::read_text(info.name, 64), "Jawari");
    EXPECT_EQ(table.v3.get_class_info_utf16(factory, 1, &info), V3_INVALID_ARG);
    v3_tuid other;
    std::memcpy(other, info.class_id, sizeof other);
    other[15] ^= 1;
    void* object = nullptr;
    EXPECT_NE(table.v1.create_instance(factory, other, v3_component_iid, &object), V3_OK);
    EXPECT_EQ(object, nullptr);
    EXPECT_EQ(table.v1.create_instance(factory, info.class_id, v3_bstream_iid, &object), V3_NO_INTERFACE);
    EXPECT_EQ(object, nullptr);
}

/// Sessions keep it: it never changes.
TEST(Vst3, TheClassIdIsFrozen) {
    v3_class_info info{};
    v3_plugin_factory_3** const factory = test::vst3_factory();
    ASSERT_EQ((**reinterpret_cast<v3_plugin_factory_cpp**>(factory)).v1.get_class_info(factory, 0, &info),
              V3_OK);
    EXPECT_EQ(std::memcmp(info.class_id, "JawariStringEng1", 16), 0);
}

TEST(Vst3, InterfacesAreOneObject) {
    Vst3Instance one;
    v3_funknown** again = nullptr;
    ASSERT_EQ(v3_cpp_obj_query_interface(one.controller, v3_component_iid, &again), V3_OK);
    EXPECT_EQ(static_cast<void*>(again), static_cast<void*>(one.component));
    v3_cpp_obj_unref(again);
    EXPECT_EQ(v3_cpp_obj_query_interface(one.component, v3_bstream_iid, &again), V3_NO_INTERFACE);
    EXPECT_EQ(again, nullptr);
}

TEST(Vst3, BusesAreStereoAndSingleStrings) {
    Vst3Instance one;
    auto* const component = v3_cpp_obj(one.component);
    EXPECT_EQ(component->get_bus_count(one.component, V3_AUDIO, V3_INPUT), 0);
    ASSERT_EQ(component->get_bus_count(one.component, V3_AUDIO, V3_OUTPUT), 17);
    EXPECT_EQ(component->get_bus_count(one.component, V3_EVENT, V3_INPUT), 1);
    for (std::int32_t bus = 0; bus < 17; ++bus) {
        v3_bus_info info{};
        ASSERT_EQ(component->get_bus_info(one.component, V3_AUDIO, V3_OUTPUT, bus, &info), V3_OK);
        EXPECT_EQ(info.channel_count, bus == 0 ? 2 : 1);
        EXPECT_EQ(info.bus_type, bus == 0 ? V3_MAIN : V3_AUX);
        EXPECT_EQ(info.flags, bus == 0 ? 1U : 0U);
    }
    v3_bus_info info{};
    EXPECT_EQ(component->get_bus_info(one.component, V3_AUDIO, V3_OUTPUT, 17, &info), V3_INVALID_ARG);
    EXPECT_EQ(component->activate_bus(one.component, V3_AUDIO, V3_OUTPUT, 16, 1), V3_OK);
    std::array<v3_speaker_arrangement, 2> wanted{3, V3_SPEAKER_M};
    auto* const processor = v3_cpp_obj(one.processor);
    EXPECT_EQ(processor->set_bus_arrangements(one.processor, nullptr, 0, wanted.data(), 2), V3_OK);
    wanted[0] = V3_SPEAKER_M;
    EXPECT_NE(processor->set_bus_arrangements(one.processor, nullptr, 0, wanted.data(), 2), V3_OK);
}

TEST(Vst3, LatencyAndTailCanBeAskedForBeforeActivation) {
    Vst3Instance one;
    EXPECT_EQ(v3_cpp_obj(one.processor)->get_latency_samples(one.processor), 0U);
    EXPECT_EQ(v3_cpp_obj(one.processor)->get_tail_samples(one.processor), 60U * 48000U);
    ASSERT_TRUE(one.setup(96000, 512));
    EXPECT_EQ(v3_cpp_obj(one.processor)->get_tail_samples(one.processor), 60U * 96000U);
}

TEST(Vst3, RatesThatItCannotHaveAreRefused) {
    Vst3Instance one;
    ASSERT_TRUE(one.load(small_state()));
    for (const double rate : {0.0, -1.0, 7999.0, 384001.0, std::nan("")})
        EXPECT_FALSE(one.activate(rate)) << rate;
    EXPECT_TRUE(one.activate(8000));
}

TEST(Vst3Programs, AChosenPresetIsLoadedAndTold) {
    Vst3Instance one;
    one.set(6, 0.5);
    ASSERT_TRUE(one.choose_preset("Sitar"));
    EXPECT_EQ(one.restarts, std::vector<std::int32_t>{V3_RESTART_PARAM_VALUES_CHANGED});
    EXPECT_NE(one.save().find("\"name\": \"sitar\""), std::string::npos);
    EXPECT_EQ(one.value(6), 0);
    EXPECT_FALSE(one.choose_preset("Kazoo"));
}

/// Hosts repeat the program that they know after a state: the state stays.
TEST(Vst3Programs, AStateIsNotOverwrittenByTheChoiceBeforeIt) {
    Vst3Instance first;
    ASSERT_TRUE(first.choose_preset("Sitar"));
    first.set(6, 0.5);
    const std::string sitar = first.save();
    Vst3Instance reopened;
    ASSERT_TRUE(reopened.load(sitar));
    const double told =
        v3_cpp_obj(reopened.controller)->get_parameter_normalised(reopened.controller, test::vst3_program);
    EXPECT_EQ(text_of(reopened, test::vst3_program, told), "Sitar");
    EXPECT_EQ(reopened.set(test::vst3_program, told), V3_OK);
    EXPECT_EQ(reopened.save(), sitar);
    ASSERT_TRUE(reopened.load(small_state()));  // no factory preset
    EXPECT_EQ(
        v3_cpp_obj(reopened.controller)->get_parameter_normalised(reopened.controller, test::vst3_program),
        0);
    EXPECT_EQ(reopened.set(test::vst3_program, 0), V3_OK);
    EXPECT_NE(reopened.save().find("bass-fretted"), std::string::npos);
}

TEST(Vst3Programs, TheHostHearsOfTheValuesOfAState) {
    Vst3Instance one, other;
    one.set(6, 0.5);
    ASSERT_TRUE(other.load(one.save()));
    EXPECT_EQ(other.restarts, std::vector<std::int32_t>{V3_RESTART_PARAM_VALUES_CHANGED});
    EXPECT_EQ(other.value(6), 0.5);
    EXPECT_FALSE(other.load("{}"));
    EXPECT_EQ(other.restarts.size(), 1U);
}

}  // namespace
}  // namespace jawari::host
