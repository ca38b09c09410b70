// What a plugin instance keeps between sessions, as one JSON text ("jawari.plugin/1", docs/plugin.md): a
// session opens without any other file.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.h"
#include "jawari/parameters.h"
#include "jawari/scene/resolution.h"
#include "midi/interpreter.h"

namespace jawari::host {

struct PluginState {
    std::string preset_name;    ///< for people; may be empty
    std::string preset_text;    ///< of a preset file
    std::string scale_text;     ///< of a .scl or .ascl file; it and tun_text empty: as the preset is tuned
    std::string tun_text;       ///< of a .tun file, in place of scale and keyboard map
    std::string keyboard_text;  ///< of a .kbm file; empty: the default map
    bool move_frets = false;    ///< the scale moves the frets
    std::string midi_map_text;  ///< of a MIDI map file; empty: the default map
    int guitar_channel = 0;     ///< 1 to 16: guitar mode begins there; 0: none
    Quality quality = Quality::Live;            ///< while somebody plays
    Quality offline_quality = Quality::Studio;  ///< while the host renders offline
    std::array<double, parameter_count> parameters = neutral_parameters();  ///< by id, in their units

    bool operator==(const PluginState&) const = default;
};

/// Longer states are refused [bytes].
inline constexpr std::size_t longest_state_bytes = std::size_t{16} << 20U;

/// The name of a preset that new instances have.
inline constexpr const char* default_preset = "guitar-steel";

/// The state of a new instance. Threads: any.
PluginState new_plugin_state();

/// What read_plugin_state() reads back as the same state, bit for bit. Threads: any.
std::string write_plugin_state(const PluginState& state);

/// A problem names its place, value and what is allowed. Parameters and settings that a state of an older
/// version lacks have the values of a new instance; a newer version is refused. Texts of files inside are not
/// read here. Threads: any.
Outcome<PluginState> read_plugin_state(std::string_view text);

}  // namespace jawari::host
