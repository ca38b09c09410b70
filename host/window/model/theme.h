// The few colours, sizes of type and distances of the window.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace jawari::host::window {

struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0;
};

namespace theme {

// -- surfaces, from the back to the front
inline constexpr Colour ground{0x13, 0x15, 0x19};   ///< behind everything, and under the strings
inline constexpr Colour surface{0x1c, 0x1f, 0x25};  ///< panels
inline constexpr Colour raised{0x2b, 0x2f, 0x38};   ///< tracks of controls, the row under the pointer
inline constexpr Colour line{0x3b, 0x40, 0x4b};     ///< hairlines, frets; carries no text

// -- what is read
inline constexpr Colour text{0xf0, 0xed, 0xe6};
inline constexpr Colour quiet{0xa9, 0xad, 0xb8};  ///< labels, descriptions

// -- what happens
inline constexpr Colour string{0xe6, 0xc4, 0x86};  ///< a string, values of parameters
inline constexpr Colour impact{0xff, 0x8a, 0x4c};  ///< impulses, overload
inline constexpr Colour accent{0x7c, 0xc7, 0xe0};  ///< notes, handles, focus

// -- type [units of the layout]
inline constexpr float small_type = 11;
inline constexpr float type = 13;
inline constexpr float large_type = 20;

/// Everything lies on multiples of it [units of the layout].
inline constexpr float grid = 8;

struct Pair {
    std::string_view use;
    Colour text, ground;
};

/// Every colour of text on every ground on which it is written.
inline constexpr std::array<Pair, 12> written{{
    {"text", text, ground},
    {"text on panels", text, surface},
    {"text on rows", text, raised},
    {"labels", quiet, ground},
    {"labels on panels", quiet, surface},
    {"labels on rows", quiet, raised},
    {"values", string, surface},
    {"values on rows", string, raised},
    {"notices", impact, ground},
    {"notices on panels", impact, surface},
    {"chosen tab", ground, accent},
    {"handles", accent, ground},
}};

}  // namespace theme

/// Relative luminance, 0 to 1 (WCAG 2.1).
inline double luminance(Colour colour) {
    const auto linear = [](std::uint8_t byte) {
        const double c = byte / 255.0;
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

/// 1 to 21 (WCAG 2.1).
inline double contrast(Colour a, Colour b) {
    const double one = luminance(a) + 0.05;
    const double other = luminance(b) + 0.05;
    return std::max(one, other) / std::min(one, other);
}

}  // namespace jawari::host::window
