// Texts of VST 3 are UTF-16.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace jawari::host::vst3 {

/// Units of a text of the interface, its end included.
inline constexpr std::size_t text_room = 128;

/// As much of a UTF-8 text as has room, and its end. What is no UTF-8 becomes U+FFFD. Threads: any.
void write_text(std::string_view text, std::int16_t* to, std::size_t room = text_room);

/// UTF-8 of a text that ends within `room` units. Halves of pairs become U+FFFD. Threads: any.
std::string read_text(const std::int16_t* text, std::size_t room = text_room);

}  // namespace jawari::host::vst3
