// What the command line of `jawari play` and its configuration file say.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "cli/instrument_options.h"

namespace jawari::host {

/// Nothing: not said.
struct PlayOptions {
    std::optional<std::string> preset;  ///< a file or a name; auto: program changes choose
    std::optional<std::string> audio;   ///< a word of audio_system_words(), or auto
    std::optional<std::string> audio_device;
    std::optional<std::string> midi;     ///< a word of midi_system_words(), or auto
    std::optional<std::string> midi_in;  ///< auto, virtual, number or part of a name
    std::optional<std::uint32_t> rate_hz;
    std::optional<std::uint32_t> frames;
    std::optional<bool> fixed_quality;  ///< never lowered under load
    InstrumentOptions instrument;
    std::optional<std::uint16_t> osc_port;
    std::optional<std::string> osc_host;
    std::optional<bool> shell;
    std::optional<bool> monitor;
    std::optional<bool> retry;  ///< go on without the device until it is back
    std::optional<bool> lock_memory;
    std::optional<bool> window;  ///< with a window

    // Of one performance: not in the file.
    std::string record, record_midi;  ///< empty: none
    bool overwrite = false;           ///< --force
    std::string config;               ///< empty: the user's own, if there is one
};

namespace play_defaults {
inline constexpr const char* preset = "auto";
/// What `auto` begins with.
inline constexpr const char* first_preset = "guitar-steel";
inline constexpr std::uint32_t rate_hz = 48000;
inline constexpr std::uint32_t frames = 128;
inline constexpr const char* osc_host = "127.0.0.1";
}  // namespace play_defaults

inline constexpr std::uint32_t lowest_play_frames = 16;
inline constexpr std::uint32_t highest_play_frames = 8192;

/// `own` where it says something, else `other`. Parameters of `own` come after those of `other`.
PlayOptions merge(PlayOptions own, const PlayOptions& other);

/// $XDG_CONFIG_HOME/jawari/play.json, or ~/.config/jawari/play.json; empty without a home.
std::string default_config_path();

/// "jawari.play-config/1" (docs/commands/play.md). Every problem names the file and the path inside it.
Outcome<PlayOptions> read_play_config(const std::string& text, const std::string& file);

/// The options with those of the configuration file under them: of `options.config`, which must exist, or of
/// default_config_path() if it does.
Outcome<PlayOptions> with_config_file(PlayOptions options);

}  // namespace jawari::host
