#include "base/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace jawari::host {

std::string shortest(double value) {
    if (std::isnan(value)) return "nan";
    std::array<char, 64> buffer{};
    char* const end = buffer.data() + buffer.size();
    // Rates read better as 2000000 than as 2e+06.
    const bool plain = value == 0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e15);
    const auto result = plain ? std::to_chars(buffer.data(), end, value, std::chars_format::fixed)
                              : std::to_chars(buffer.data(), end, value);
    return {buffer.data(), result.ptr};
}

std::string seventeen_digits(double value) {
    std::array<char, 40> buffer{};
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 17);
    return {buffer.data(), result.ptr};
}

std::optional<double> parse_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.starts_with('+')) return std::nullopt;
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<double> parse_time(std::string_view text) {
    constexpr double per_unit = 60;
    constexpr int most_colons = 2;
    double seconds = 0;
    for (int colons = 0; colons <= most_colons; ++colons) {
        const std::size_t colon = text.find(':');
        const auto part = parse_number(text.substr(0, colon));
        const bool last = colon == std::string_view::npos;
        if (!part || !std::isfinite(*part) || std::signbit(*part)) return std::nullopt;
        if (!last && *part != std::floor(*part)) return std::nullopt;
        if (colons > 0 && *part >= per_unit) return std::nullopt;
        seconds = seconds * per_unit + *part;
        if (last) return seconds;
        text.remove_prefix(colon + 1);
    }
    return std::nullopt;
}

std::string printable(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7f) {
            std::array<char, 5> escape{};
            std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned>(code));
            result += escape.data();
        } else {
            result += c;
        }
    }
    return result;
}

std::string in_quotes(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return '"' + printable(text) + '"';
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U)
        --end;  // whole UTF-8 characters
    return '"' + printable(text.substr(0, end)) + "...\"";
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
    std::string result;
    for (const auto& word : words) {
        if (!result.empty()) result += separator;
        result += word;
    }
    return result;
}

}  // namespace jawari::host
