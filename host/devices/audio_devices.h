// Which audio systems and devices there are, and which one a user means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace jawari::host {

struct AudioDevice {
    unsigned int id = 0;  ///< what the library calls it
    std::string name;
    unsigned int output_channels = 0;
    bool is_default = false;
    std::vector<unsigned int> rates_hz;
    unsigned int preferred_rate_hz = 0;  ///< 0: unknown
};

/// In the order in which `auto` tries them: those that the library here was built with.
std::vector<std::string> audio_systems();

/// Every word that --audio takes, whether the library here has it or not.
const std::vector<std::string>& audio_system_words();

/// `JACK`, `PulseAudio` ...
std::string audio_system_title(const std::string& system);

/// Devices with at least two output channels; without a server, none. Nothing is printed.
Outcome<std::vector<AudioDevice>> audio_devices(const std::string& system);

/// Index in `names` of the one that `wanted` means: a number from 0, a whole name, or a part of exactly one
/// name; letters' case does not matter. `what`: "audio device", for the message.
Outcome<std::size_t> match_name(const std::vector<std::string>& names, const std::string& wanted,
                                const std::string& what);

/// The rate to open a device with: the wanted one if the device has it or says nothing, else its preferred
/// one, else the nearest.
unsigned int choose_rate(const AudioDevice& device, unsigned int wanted_hz);

}  // namespace jawari::host
