// Readable names for tests with parameters: INSTANTIATE_TEST_SUITE_P(..., test::named).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <type_traits>

namespace jawari::test {

/// GoogleTest allows letters, digits and underscores.
inline std::string as_test_name(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c >= 128 || std::isalnum(c) == 0; }, '_');
    return text;
}

inline std::string name_of_number(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%g", std::abs(value));
    return (std::signbit(value) && !std::isnan(value) ? "minus_" : "") + as_test_name(digits);
}

/// Numbers, text, tuples of what has a name, and every type with a function `name_of` in its own namespace.
struct Named {
    template <class Parameter>
    std::string operator()(const testing::TestParamInfo<Parameter>& info) const {
        return name(info.param);
    }

  private:
    template <class Value>
    static std::string name(const Value& value) {
        if constexpr (std::is_arithmetic_v<Value>)
            return name_of_number(static_cast<double>(value));
        else if constexpr (std::is_convertible_v<Value, std::string>)
            return as_test_name(value);
        else
            return as_test_name(name_of(value));
    }

    template <class First, class... Rest>
    static std::string name(const std::tuple<First, Rest...>& values) {
        return std::apply(
            [](const First& first, const Rest&... rest) { return (name(first) + ... + ("_" + name(rest))); },
            values);
    }
};

inline constexpr Named named;

}  // namespace jawari::test
