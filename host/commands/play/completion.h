// What the shell offers for the word under the cursor.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "commands/play/verbs.h"

namespace jawari::host {

/// Names of presets; asked for when they are needed.
using PresetNames = std::function<std::vector<std::string>()>;

/// Words, sorted, that may stand where the last word of `line` (empty after a blank) is being typed.
std::vector<std::string> completions(std::string_view line, const PresetNames& presets);

/// The word being typed.
std::string_view last_word(std::string_view line);

/// The longest text that all words begin with.
std::string common_start(const std::vector<std::string>& words);

}  // namespace jawari::host
