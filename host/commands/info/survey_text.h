// Surveys and lists of presets, for people and for programs (docs/presets.md).
#pragma once

#include <string>
#include <vector>

#include "commands/info/survey.h"
#include "instrument/preset_library.h"

namespace jawari::host {

/// A preset of the list, with its title or the reason why it cannot be read.
struct ListedPreset {
    NamedPreset named;
    std::string title;    ///< `name` of the file
    std::string problem;  ///< empty if it can be read
    std::size_t strings = 0;
    int program = -1;  ///< its number in the bank of all presets; -1: none
};

std::string survey_text(const PresetSurvey& survey);
std::string survey_json(const PresetSurvey& survey);
std::string list_text(const std::vector<ListedPreset>& presets);
std::string list_json(const std::vector<ListedPreset>& presets);

}  // namespace jawari::host
