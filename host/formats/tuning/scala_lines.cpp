#include "formats/tuning/scala_lines.h"

#include <charconv>
#include <utility>

#include "base/text.h"

namespace jawari::host {

namespace {

constexpr std::string_view blanks = " \t";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
constexpr std::size_t most_digits = 18;  // fit 64 bits

}  // namespace

std::vector<ScalaLine> text_lines(std::string_view text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    std::vector<ScalaLine> lines;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find_first_of("\r\n");
        const std::string_view line = text.substr(0, end);
        lines.push_back({number, line});
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
    }
    return lines;
}

std::vector<ScalaLine> scala_lines(std::string_view text) {
    std::vector<ScalaLine> lines = text_lines(text);
    std::erase_if(lines, [](const ScalaLine& line) { return line.text.starts_with('!'); });
    return lines;
}

std::vector<ScalaLine> scala_comments(std::string_view text) {
    std::vector<ScalaLine> lines = text_lines(text);
    std::erase_if(lines, [](const ScalaLine& line) { return !line.text.starts_with('!'); });
    return lines;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::string_view first_word(std::string_view text) {
    const std::string_view rest = trimmed(text);
    return rest.substr(0, rest.find_first_of(blanks));
}

std::optional<long long> whole_number(std::string_view text) {
    const std::size_t digits = text.size() - (text.starts_with('-') ? 1 : 0);
    if (digits == 0 || digits > most_digits) return std::nullopt;
    long long value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Failure scala_failure(std::size_t line, std::string_view value, std::string allowed) {
    return {"line " + std::to_string(line), in_quotes(trimmed(value)), std::move(allowed)};
}

Failure scala_missing(std::string_view what, std::string allowed) {
    return {"end of file", "no " + std::string(what), std::move(allowed)};
}

}  // namespace jawari::host
