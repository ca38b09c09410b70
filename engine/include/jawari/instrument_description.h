// What a plucked, fretted instrument is, in SI units, before compile_instrument(): plain structs with the
// names and units of the preset file format (docs/preset-format.md).
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "jawari/description.h"

namespace jawari {

struct InstrumentStringDescription {
    std::string name;
    int open_note = 0;                   ///< MIDI note number of the open string, 0 to 127
    double open_frequency_hz = 0;        ///< of its first partial, 10 to 5000
    double length_m = 0;                 ///< nut to bridge, 0.05 to 5
    double linear_density_kg_per_m = 0;  ///< 1e-5 to 0.1
    double inharmonicity = 0;            ///< B of the open string, 0 to 0.01; f_k = k f_0 sqrt(1 + B k^2)
    std::variant<NoLoss, ValetteLoss, DecayTimePoints> damping;
    double level = 1;  ///< factor of its pickup signal, 0 to 100
};

/// Fret j = 1, 2, ... lies at equal temperament; a note at fret f sounds f semitones above the open string.
struct FretsDescription {
    std::vector<double> height_m;  ///< from the open string's rest line, negative; at most limits::frets
    double restitution = 0;        ///< 0 to 1; ignored by ImpactLaw::Signorini
};

/// A finger lifts the string with a force at one point and lets go. The force rises and falls as half a
/// cosine, linear within each output frame; both times are rounded up to whole frames.
struct PluckDescription {
    double position_from_bridge_m = 0;  ///< inside the shortest speaking length
    double rise_s = 0.004;              ///< 1e-4 to 0.1
    double release_s = 0.0005;          ///< 5e-5 to 0.1
    double full_height_m = 0;           ///< lift of the string at the finger at velocity 1, 1e-6 to 0.02
    double height_exponent = 1;         ///< lift = full_height_m velocity^height_exponent, 0.1 to 4
};

/// A pickup senses the string's velocity, averaged over its width.
struct PickupDescription {
    double position_from_bridge_m = 0;  ///< inside the shortest speaking length
    double width_m = 0;                 ///< 0 to 0.1
    double level = 1;                   ///< -100 to 100
};

struct InstrumentDescription {
    std::string name;
    double gain = 1;                      ///< output per m/s at the pickups, 1 being full scale; 0 to 1e6
    double contact_rate_min_hz = 500000;  ///< rounded up to an integer multiple of the output rate
    double mode_limit_hz = 20000;  ///< modes up to this frequency are computed; at most 0.45 contact rates
    ImpactLaw law = ImpactLaw::Signorini;
    double release_t60_s = 0.1;  ///< 60 dB decay that the damping hand alone gives every mode, 0.005 to 60
    PluckDescription pluck;
    FretsDescription frets;
    std::vector<PickupDescription> pickups;            ///< 1 to limits::pickups
    std::vector<InstrumentStringDescription> strings;  ///< 1 to limits::instrument_strings
};

namespace limits {
inline constexpr std::size_t frets = 36;
inline constexpr std::size_t instrument_strings = 16;
inline constexpr std::size_t instrument_modes = 2048;  ///< per string
inline constexpr std::size_t pickups = 8;
}  // namespace limits

}  // namespace jawari
