// What `jawari devices` says.
#pragma once

#include <string>
#include <vector>

#include "devices/audio_devices.h"

namespace jawari::host {

struct AudioSystemSurvey {
    std::string system;
    std::string problem;  ///< why it has no devices; empty if it has
    std::vector<AudioDevice> devices;
};

struct MidiSystemSurvey {
    std::string system;
    std::string problem;
    std::vector<std::string> inputs;
};

/// Systems in the order in which `auto` tries them.
struct DeviceSurvey {
    std::vector<AudioSystemSurvey> audio;
    std::vector<MidiSystemSurvey> midi;
};

DeviceSurvey survey_devices();

/// Lines without their ends.
std::vector<std::string> devices_text(const DeviceSurvey& survey);

/// "jawari.devices/1" (docs/commands/play.md).
std::string devices_json(const DeviceSurvey& survey);

}  // namespace jawari::host
