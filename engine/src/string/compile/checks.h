// Checks of single values of a description: a failure names the place, the value and what is allowed.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "string/compile/validate.h"

namespace jawari::checks {

using detail::Check;
using detail::indexed_place;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Range {
    double low = 0;
    double high = 0;
    bool low_included = true;
    bool high_included = true;
};

inline constexpr Range positive{0, infinity, false, false};
inline constexpr Range not_negative{0, infinity, true, false};
inline constexpr Range any_finite{-infinity, infinity, false, false};

inline std::string described(const Range& range) {
    if (range.low == -infinity && range.high == infinity) return "a finite number";
    if (range.high == infinity) {
        return std::string("a finite number ") + (range.low_included ? ">= " : "> ") + printed(range.low);
    }
    const std::string span = printed(range.low) + " to " + printed(range.high);
    return range.low_included && range.high_included ? span : span + ", ends excluded";
}

inline Check check(const std::string& place, double value, const Range& range) {
    const bool above = range.low_included ? value >= range.low : value > range.low;
    const bool below = range.high_included ? value <= range.high : value < range.high;
    if (std::isfinite(value) && above && below) return {};
    return Failure{place, printed(value), described(range)};
}

inline Check check_count(const std::string& place, std::size_t value, std::size_t low, std::size_t high) {
    if (value >= low && value <= high) return {};
    return Failure{place, std::to_string(value), std::to_string(low) + " to " + std::to_string(high)};
}

/// The first failure of several checks.
template <class... Rest>
Check first(Check check, Rest... rest) {
    if constexpr (sizeof...(rest) == 0) {
        return check;
    } else {
        return check ? check : first(std::move(rest)...);
    }
}

inline Check check_list(const std::string& place, const std::vector<double>& values, const Range& range) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (auto failure = check(indexed_place(place, i), values[i], range)) return failure;
    }
    return {};
}

}  // namespace jawari::checks
