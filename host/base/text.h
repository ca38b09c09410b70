// Numbers and foreign text as they appear in messages and files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jawari::host {

/// Shortest decimal text that reads back as the same double, without exponent where that is readable; `nan`,
/// `inf`, `-inf` otherwise.
std::string shortest(double value);

/// 17 significant digits: reads back as the same double and lines up with other programs' `%.17g`.
std::string seventeen_digits(double value);

/// A number spelled out completely (`12`, `-0.5`, `1e-3`, `inf`, `nan`), surrounding spaces not accepted.
std::optional<double> parse_number(std::string_view text);

/// A length of time [s], 0 or more: seconds (`90.5`), minutes and seconds (`1:30.5`) or hours too
/// (`1:02:03`). Behind a colon seconds and minutes are below 60.
std::optional<double> parse_time(std::string_view text);

/// Control characters as \xNN, so that foreign text never breaks a line or drives a terminal.
std::string printable(std::string_view text);

/// printable() in double quotes, shortened with "..." beyond `longest` bytes.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

/// ASCII letters only.
std::string lower_case(std::string_view text);

/// As printf writes it, at most 400 bytes of it.
template <class... Values>
std::string formatted(const char* format, Values... values) {
    std::array<char, 401> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

/// `a, b, c`
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace jawari::host
