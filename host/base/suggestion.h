// "Did you mean": the known word that a word which is refused was probably meant to be.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jawari::host {

/// Fewest characters to insert, delete, replace or swap with their neighbour that make one text the other;
/// no character is changed twice (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that is nearest, whatever the case, `_` and `-` being one: the first of several. Of names with
/// folders the last part alone may be meant. Nothing if more than a third of the letters differ.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

/// `; did you mean "length_m"?`, to follow the word in a message. Empty if nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace jawari::host
