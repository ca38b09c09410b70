// What tests of VST 3 ask of an instance.
#pragma once

#include <cmath>
#include <initializer_list>

#include "plugin/vst3/text16.h"
#include "support/small_preset.h"
#include "support/vst3_host.h"

namespace jawari::test {

inline constexpr v3_param_id vst3_program = 1000;

inline v3_param_info info_of(const Vst3Instance& one, std::int32_t index) {
    v3_param_info info{};
    EXPECT_EQ(v3_cpp_obj(one.controller)->get_parameter_info(one.controller, index, &info), V3_OK);
    return info;
}

inline std::string text_of(const Vst3Instance& one, v3_param_id id, double value) {
    std::array<std::int16_t, 128> text{};
    EXPECT_EQ(
        v3_cpp_obj(one.controller)->get_parameter_string_for_value(one.controller, id, value, text.data()),
        V3_OK);
    return host::vst3::read_text(text.data());
}

inline double value_of(const Vst3Instance& one, v3_param_id id, const std::string& words) {
    std::array<std::int16_t, 128> text{};
    host::vst3::write_text(words, text.data());
    double value = -1;
    v3_cpp_obj(one.controller)->get_parameter_value_for_string(one.controller, id, text.data(), &value);
    return value;
}

/// With a cheap instrument, active.
inline void ready(std::initializer_list<Vst3Instance*> instances) {
    for (Vst3Instance* each : instances) {
        EXPECT_TRUE(each->load(small_state()));
        EXPECT_TRUE(each->activate());
    }
}

inline double loudest(const std::vector<float>& sound) {
    double most = 0;
    for (const float sample : sound) most = std::max<double>(most, std::abs(sample));
    return most;
}

}  // namespace jawari::test
