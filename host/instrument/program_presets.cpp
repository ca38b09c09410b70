#include "instrument/program_presets.h"

#include <array>
#include <cstddef>

namespace jawari::host {

namespace {

constexpr std::array<std::string_view, 14> presets{
    "bass-fretted",    "bass-fretless", "bass-slap", "guitar-steel", "guitar-nylon",
    "guitar-electric", "guitar-12",     "sitar",     "tanpura",      "biwa",
    "harpsichord",     "clavichord",    "dulcimer",  "prepared"};

struct Family {
    int first, last;  ///< programs, from 0
    std::string_view preset;
};

/// Programs of General MIDI ("General MIDI System Level 1", MMA 1991), from 0.
constexpr std::array<Family, 17> families{{
    {0, 5, "dulcimer"},  // pianos: strings that hammers strike
    {6, 6, "harpsichord"},
    {7, 7, "clavichord"},  // clavi
    {15, 15, "dulcimer"},
    {24, 24, "guitar-nylon"},
    {25, 25, "guitar-steel"},
    {26, 31, "guitar-electric"},  // jazz, clean, muted, overdriven, distorted, harmonics
    {32, 32, "bass-fretless"},    // acoustic bass
    {33, 34, "bass-fretted"},     // finger, pick
    {35, 35, "bass-fretless"},
    {36, 37, "bass-slap"},
    {38, 39, "bass-fretted"},  // synthetic basses
    {45, 46, "guitar-nylon"},  // pizzicato, harp
    {104, 104, "sitar"},
    {105, 105, "guitar-steel"},  // banjo
    {106, 106, "biwa"},          // shamisen
    {107, 107, "biwa"},          // koto
}};

/// What stands in for instruments without strings to pluck or strike.
constexpr std::array<Family, 19> stand_ins{{
    {8, 14, "dulcimer"},          // bells and bars
    {16, 23, "harpsichord"},      // organs, accordions, harmonica
    {40, 42, "guitar-nylon"},     // violin, viola, cello
    {43, 43, "bass-fretless"},    // contrabass
    {44, 44, "guitar-12"},        // tremolo
    {47, 47, "bass-fretless"},    // timpani
    {48, 55, "guitar-12"},        // string ensembles, choirs, orchestra
    {56, 57, "guitar-electric"},  // trumpet, trombone
    {58, 58, "bass-fretted"},     // tuba
    {59, 67, "guitar-electric"},  // trumpet with mute, horns, brass, saxophones
    {68, 71, "guitar-nylon"},     // oboe, English horn, bassoon, clarinet
    {72, 79, "dulcimer"},         // flutes and whistles
    {80, 86, "guitar-electric"},  // synthetic leads
    {87, 87, "bass-fretted"},     // bass and lead
    {88, 103, "guitar-12"},       // synthetic pads and effects
    {108, 108, "dulcimer"},       // kalimba
    {109, 111, "sitar"},          // bagpipe, fiddle, shanai
    {112, 112, "dulcimer"},       // tinkle bell
    {114, 114, "dulcimer"},       // steel drums
}};

constexpr std::array<std::string_view, 2> below_keyboards{"harpsichord", "bass-fretless"};
constexpr std::array<std::string_view, 2> below_others{"bass-fretless", "harpsichord"};
constexpr std::array<std::string_view, 3> above_basses{"guitar-electric", "dulcimer", "harpsichord"};
constexpr std::array<std::string_view, 2> above_others{"dulcimer", "harpsichord"};

}  // namespace

std::span<const std::string_view> neighbour_presets(std::string_view preset, bool below) {
    const bool bass = preset.starts_with("bass");
    if (!below && bass) return above_basses;
    if (!below) return above_others;
    const bool keyboard = preset == "dulcimer" || preset == "clavichord" || preset == "prepared";
    if (keyboard) return below_keyboards;
    return below_others;
}

std::span<const std::string_view> numbered_presets() {
    return presets;
}

std::optional<std::string_view> program_preset(int bank, int program) {
    if (bank == numbered_bank) {
        if (program < 0 || program >= static_cast<int>(presets.size())) return std::nullopt;
        return presets[static_cast<std::size_t>(program)];
    }
    for (const Family& family : families)
        if (program >= family.first && program <= family.last) return family.preset;
    return std::nullopt;
}

std::optional<std::string_view> nearest_preset(int program) {
    for (const Family& family : stand_ins)
        if (program >= family.first && program <= family.last) return family.preset;
    return std::nullopt;
}

}  // namespace jawari::host
