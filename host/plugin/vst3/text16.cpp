#include "plugin/vst3/text16.h"

namespace jawari::host::vst3 {

namespace {

constexpr char32_t no_character = 0xFFFD;
constexpr char32_t first_pair = 0x10000;

bool continues(std::string_view text, std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
}

/// The character at `i`, which moves behind it (RFC 3629).
char32_t next_character(std::string_view text, std::size_t& i) {
    const auto first = static_cast<unsigned char>(text[i++]);
    if (first < 0x80U) return first;
    const std::size_t more = first >= 0xF0U ? 3 : first >= 0xE0U ? 2 : 1;
    if (first < 0xC2U || first > 0xF4U) return no_character;
    char32_t code = first & (0x3FU >> more);
    for (std::size_t n = 0; n < more; ++n) {
        if (!continues(text, i)) return no_character;
        code = code << 6U | (static_cast<unsigned char>(text[i++]) & 0x3FU);
    }
    constexpr char32_t smallest[]{0x80, 0x800, 0x10000};
    const bool is_half = code >= 0xD800U && code < 0xE000U;
    return code < smallest[more - 1] || is_half || code > 0x10FFFFU ? no_character : code;
}

void append(char32_t code, std::string& text) {
    const auto add = [&text](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80U) {
        add(code);
    } else if (code < 0x800U) {
        add(0xC0U | code >> 6U);
        add(0x80U | (code & 0x3FU));
    } else {
        if (code < first_pair) {
            add(0xE0U | code >> 12U);
        } else {
            add(0xF0U | code >> 18U);
            add(0x80U | (code >> 12U & 0x3FU));
        }
        add(0x80U | (code >> 6U & 0x3FU));
        add(0x80U | (code & 0x3FU));
    }
}

}  // namespace

void write_text(std::string_view text, std::int16_t* to, std::size_t room) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size();) {
        const char32_t code = next_character(text, i);
        if (count + (code < first_pair ? 1 : 2) >= room) break;
        if (code < first_pair) {
            to[count++] = static_cast<std::int16_t>(code);
        } else {
            to[count++] = static_cast<std::int16_t>(0xD800U | (code - first_pair) >> 10U);
            to[count++] = static_cast<std::int16_t>(0xDC00U | ((code - first_pair) & 0x3FFU));
        }
    }
    to[count] = 0;
}

std::string read_text(const std::int16_t* text, std::size_t room) {
    std::string read;
    for (std::size_t i = 0; i < room && text[i] != 0; ++i) {
        const auto unit = static_cast<std::uint16_t>(text[i]);
        if (unit < 0xD800U || unit >= 0xE000U) {
            append(unit, read);
            continue;
        }
        const auto second = static_cast<std::uint16_t>(i + 1 < room ? text[i + 1] : 0);
        if (unit < 0xDC00U && second >= 0xDC00U && second < 0xE000U) {
            append(first_pair + ((unit & 0x3FFU) << 10U) + (second & 0x3FFU), read);
            ++i;
        } else {
            append(no_character, read);
        }
    }
    return read;
}

}  // namespace jawari::host::vst3
