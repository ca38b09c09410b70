// What the command line of `jawari render` says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace jawari::host {

enum class SampleFormat { Pcm16, Pcm24, Float };

struct RenderOptions {
    std::string midi;    ///< a file
    std::string preset;  ///< a file or a built-in name
    std::string out;     ///< a WAV file
    std::string stats;   ///< JSON; empty: none; `-`: standard output
    std::string plot;    ///< waveform and spectrogram; empty: none
    std::uint32_t rate_hz = 48000;
    std::optional<SampleFormat> format;  ///< nothing: PCM of 24 bits
    double gain_db = 0;
    std::optional<double> tail_s;  ///< after the last event; nothing: until the sound has died away
};

inline constexpr std::uint32_t lowest_render_rate_hz = 8000;
inline constexpr std::uint32_t highest_render_rate_hz = 384000;
inline constexpr double longest_tail_s = 600;

/// `--tail auto` ends once the sound has stayed below this level for this long, at the latest after
/// automatic_tail_limit_s.
inline constexpr double silence_dbfs = -90;
inline constexpr double silence_s = 0.1;
inline constexpr double automatic_tail_limit_s = 60;

}  // namespace jawari::host
