// What the command line of `jawari render` says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/sound_file.h"
#include "cli/instrument_options.h"

namespace jawari::host {

struct RenderOptions {
    std::vector<std::string> midi;  ///< files; `-`: standard input
    std::string preset = "auto";    ///< a file or a name; auto: each channel's program chooses
    std::string out;  ///< a sound file, of the format of its name's ending, for all MIDI files; `-`: standard
                      ///< output; a folder for a sound file of each
    std::string stems;          ///< a WAV file, or a folder with a slash at its end; empty: none
    std::string stats;          ///< JSON; empty: none; `-`: standard output
    std::string plot;           ///< waveform and spectrogram; empty: none
    bool overwrite = false;     ///< replaces files of other kinds too
    bool mono = false;          ///< one channel: the mean of both
    bool quiet = false;         ///< neither a summary nor notices; warnings and errors are shown
    bool only_strings = false;  ///< auto: programs without strings are silent
    bool strict = false;        ///< files that depart from the standard are refused; warnings are an error
    std::uint32_t rate_hz = 48000;
    std::optional<SampleFormat> format;  ///< nothing: PCM of 24 bits
    std::optional<double> tail_s;        ///< after the last event; nothing: until the sound has died away
    double silence_dbfs = -90;           ///< what counts as died away
    std::optional<std::uint64_t> seed;   ///< of humanise(); nothing: exactly as written
    InstrumentOptions instrument;
    double start_s = 0;           ///< what comes before it is not played, but its settings hold
    std::optional<double> end_s;  ///< what is down is let go there; nothing: at the end of the music
    double tempo_percent = 100;   ///< of the file's tempo
    std::vector<int> mute, solo;  ///< channels, 1 to 16; solo: no others
    int transpose_semitones = 0;  ///< of all notes but drums
    unsigned jobs = 0;            ///< 0: one a processor
};

inline constexpr const char* automatic_preset = "auto";
inline constexpr double longest_tail_s = 600;
/// Of --start and --end, as long as the longest music that is read.
inline constexpr double latest_time_s = 1000.0 * 3600;

/// `--tail auto` ends once the sound has stayed below the silence for this long, at the latest after
/// automatic_tail_limit_s.
inline constexpr double silence_s = 0.1;
inline constexpr double automatic_tail_limit_s = 60;

}  // namespace jawari::host
