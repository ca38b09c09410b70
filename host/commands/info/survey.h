// What there is to know about a preset: its strings as they are, and what they cost.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "instrument/instrument_cache.h"

namespace jawari::host {

struct StringSurvey {
    std::string name;
    std::optional<std::size_t> course;
    int open_note = 0;
    double open_frequency_hz = 0;
    double length_m = 0;
    double linear_density_kg_per_m = 0;
    double tension_N = 0;  ///< 4 L^2 f_0^2 mu, f_0 = f_1/sqrt(1 + B)
    double inharmonicity = 0;
    std::size_t frets = 0;
    int highest_note = 0;
    std::size_t modes = 0;     ///< of the open string
    std::size_t contacts = 0;  ///< of the open string
};

struct PresetSurvey {
    Preset preset;
    std::string quality;
    double contact_rate_hz = 0;
    std::vector<StringSurvey> strings;
    std::size_t stopped_strings = 0;  ///< compiled: one per string and fret
    double cpu_compile_s = 0;
    /// CPU seconds per second of sound: the first second after all strings are played open at full velocity.
    double cpu_all_strings = 0;
};

/// Compiles the preset and plays it for a second.
Outcome<PresetSurvey> survey_preset(const std::string& preset, const InstrumentSettings& settings);

/// `A4`, `C#5`: MIDI note 60 is C4.
std::string note_name(int note);

}  // namespace jawari::host
