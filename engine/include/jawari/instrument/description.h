// What a string instrument is, in SI units, before compile_instrument(): plain structs with the names and
// units of the preset file format (docs/formats/preset.md).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari {

/// A place on the speaking length, from the bridge: in metres, or as a share of the length. The one that is
/// above 0 counts; the share if both are.
struct StringPlace {
    double from_bridge_m = 0;
    double share = 0;  ///< 0 to 1, ends excluded
};

// ---------------------------------------------------------------------------------------------- strings

/// Places at which a string can be stopped. Fret j = 1, 2, ... sounds semitones[j-1] above the open string.
struct FretsDescription {
    std::size_t count = 0;                    ///< at most limits::frets
    std::vector<int> semitones;               ///< rising, from 1; empty: 1, 2, 3, ...
    std::vector<double> position_from_nut_m;  ///< rising; empty: the speaking length falls as the pitch rises
    /// Tops, from the open string's rest line, negative. Empty: the frets stop the string, but it never
    /// strikes them.
    std::vector<double> height_m;
    double restitution = 0;  ///< 0 to 1; ignored by ImpactLaw::Signorini
};

struct InstrumentStringDescription {
    std::string name;
    int open_note = 0;                   ///< MIDI note number of the open string, 0 to 127
    double open_frequency_hz = 0;        ///< of its first partial, 10 to 5000
    double length_m = 0;                 ///< nut to bridge, 0.02 to 5
    double linear_density_kg_per_m = 0;  ///< 1e-5 to 0.1
    double inharmonicity = 0;            ///< B of the open string, 0 to 0.01; f_k = k f_0 sqrt(1 + B k^2)
    std::variant<NoLoss, ValetteLoss, DecayTimePoints> damping;
    double level = 1;       ///< factor of its signals, 0 to 100
    double excitation = 1;  ///< factor of lifts and hammer speeds, 0.01 to 100
    double pan = 0;         ///< -1 left to 1 right
    /// Strings with the same course sound together: one key plays them all, at the same fret. Empty: alone.
    std::optional<std::size_t> course;
    std::optional<FretsDescription> frets;     ///< instead of the instrument's
    std::optional<StringPlace> exciter_place;  ///< instead of the exciters'
    double release_t60_s = 0;                  ///< instead of the hand's, 0.005 to 60; 0: the hand's
};

// ---------------------------------------------------------------------------------------------- obstacles

/// Where an obstacle's distances begin, and what its heights are measured from.
enum class Origin {
    Bridge,  ///< from the bridge; heights from the open string's rest line
    Nut,     ///< from the nut; the same; only what lies in the speaking length counts
    Stop     ///< from the nut or the fret that stops the string; heights from the speaking length's rest line
};

/// height = height_m - drop_m (distance/length_m)^2 for distances up to length_m.
struct ParabolicProfile {
    double length_m = 0;  ///< above 0, to 5
    double drop_m = 0;    ///< 0 to 0.1
    double height_m = 0;  ///< at the origin, -0.1 to 0.1
};

/// Corners (distance from the origin [m], height [m]) with rising distances, straight between them.
using CornerProfile = std::vector<std::pair<double, double>>;

/// A rigid body that strings strike: neck, curved bridge, thread, sawari, rattle.
struct ObstacleDescription {
    std::string name;
    Origin origin = Origin::Bridge;
    Side side = Side::Below;
    std::variant<CornerProfile, ParabolicProfile> profile;
    /// Contacts spread evenly over the profile; 0: one at each corner (a corner profile only). At most
    /// limits::obstacle_points.
    std::size_t points = 0;
    double restitution = 0;            ///< 0 to 1; ignored by ImpactLaw::Signorini
    std::vector<std::size_t> strings;  ///< indices; empty: all
};

/// Something soft that always lies on the string: cotton, felt, rubber. Spring and dashpot.
struct SoftTouchDescription {
    std::string name;
    StringPlace place;
    double width_m = 0;                ///< 0 to 0.2
    double damping_kg_per_s = 0;       ///< 0 to 1e4
    double stiffness_N_per_m = 0;      ///< 0 to 1e7
    std::vector<std::size_t> strings;  ///< indices; empty: all
};

// ---------------------------------------------------------------------------------------------- players

/// A finger or plectrum lifts the string with a force and lets go. The force rises and falls as half a
/// cosine, held over each output frame; both times are rounded up to whole frames.
struct FingerDescription {
    double rise_s = 0.004;        ///< 1e-4 to 0.1
    double release_s = 0.0005;    ///< 5e-5 to 0.1
    double full_height_m = 0;     ///< lift of the string at the finger at velocity 1, 1e-6 to 0.02
    double height_exponent = 1;   ///< lift = full_height_m velocity^height_exponent, 0.1 to 4
    double damping_kg_per_s = 0;  ///< of the finger while it lies on the string before the release, 0 to 100
};

/// A free body with a felt or flesh of potential K xi^(p+1)/(p+1) strikes the string from below (Chaigne and
/// Askenfelt, JASA 95 (1994), give values for pianos).
struct HammerDescription {
    double mass_kg = 0;             ///< 1e-5 to 1
    double stiffness = 0;           ///< K [N/m^p], 1 to 1e15
    double exponent = 2.5;          ///< p, 1 to 5
    double loss_s_per_m = 0;        ///< loss force K xi^p loss dxi/dt, 0 to 10
    double full_speed_m_per_s = 0;  ///< at velocity 1, 0.01 to 50
    double speed_exponent = 1;      ///< speed = full_speed velocity^speed_exponent, 0.1 to 4
    Side side = Side::Below;        ///< Above: towards frets and neck, as the slapping thumb
};

/// The clavichord's tangent: the string's end opposite the bridge is moved and stays in contact. The end
/// moves by height x (t/rise - sin(2 pi t/rise)/(2 pi)), without a jump of force.
struct TangentDescription {
    double rise_s = 0.003;       ///< 2e-4 to 0.1
    double full_height_m = 0;    ///< at velocity 1, 1e-6 to 0.02
    double height_exponent = 1;  ///< 0.1 to 4
};

struct ExciterDescription {
    std::string name;    ///< of the articulation
    StringPlace place;   ///< ignored by tangents
    double width_m = 0;  ///< over which the force is spread, 0 to 0.1
    std::variant<FingerDescription, HammerDescription, TangentDescription> body;
    double time_exponent = 0;    ///< times (finger, tangent) shrink as velocity^-time_exponent, 0 to 2
    double lowest_velocity = 0;  ///< the first exciter whose velocities and strings fit plays the note
    double highest_velocity = 1;
    std::size_t first_string = 0;
    std::size_t last_string = 1000;
};

/// What the hands do beside exciting. Dampings are given as the 60 dB decay time of the first partial that
/// the touch alone would give in first order; no touch is harder than one that absorbs best.
struct HandDescription {
    bool damps = true;  ///< false: strings ring on after note-off, as on a dulcimer
    std::array<StringPlace, 2> release_places{{{0, 0.164}, {0, 0.312}}};
    double release_t60_s = 0.1;  ///< at release velocity 0.5; 0.005 to 60
    double release_spread = 2;   ///< T60 times this at release velocity 0, over it at 1; 1 to 10
    StringPlace palm_place{0, 0.03};
    double palm_t60_s = 0.2;         ///< at full palm mute, 0.005 to 60
    double dead_t60_s = 0.03;        ///< of a dead note's left hand, 0.005 to 60
    double harmonic_t60_s = 0.03;    ///< of the light touch at a node, 0.005 to 60
    double harmonic_touch_s = 0.15;  ///< after which it leaves, 0.001 to 5
    double legato_level = 0.3;       ///< velocity factor of hammer-ons and pull-offs, 0 to 1
    double pressure_semitones = 0;   ///< bend at full pressure, -12 to 12
    double course_delay_s = 0;       ///< between the strings of a course, 0 to 0.05
};

// ---------------------------------------------------------------------------------------------- output

enum class PickupQuantity {
    Velocity,      ///< m/s
    Displacement,  ///< m
    BridgeForce    ///< N: what the string exerts on the bridge; place and width are ignored
};

struct PickupDescription {
    StringPlace place;
    double width_m = 0;  ///< averages over it, 0 to 0.1
    double level = 1;    ///< -100 to 100
    PickupQuantity quantity = PickupQuantity::Velocity;
    /// Distance to the pole; 0: linear. Velocities are divided by (1 - u/distance)^3: the field of a magnetic
    /// charge falls with the squared distance (Horton and Moore, Am. J. Phys. 77 (2009) 144). 0 to 0.1.
    double magnet_distance_m = 0;
};

/// A resonance of the body, driven by the force on the bridge: a damped oscillator of 1 kg whose velocity is
/// heard.
struct BodyModeDescription {
    double frequency_hz = 0;  ///< 5 to 20000
    double t60_s = 0;         ///< 1e-4 to 20
    double gain_left = 0;     ///< output per m/s, -1e6 to 1e6
    double gain_right = 0;
};

/// How strings are given to notes (instrument_render.h).
enum class PlayMode { Keyboard, Guitar };

struct QualityDescription {
    double contact_rate_min_hz = 500000;  ///< rounded up to an integer multiple of the output rate
    double mode_limit_hz = 20000;  ///< modes up to this frequency are computed; at most 0.45 contact rates
};

struct InstrumentDescription {
    std::string name;
    double gain = 1;  ///< factor of the sum of pickups and body; 1 is full scale; 0 to 1e6
    QualityDescription quality;
    std::optional<QualityDescription> studio;  ///< for renderings without haste; chosen by the host
    ImpactLaw law = ImpactLaw::Signorini;
    PlayMode play = PlayMode::Keyboard;
    bool contacts = true;  ///< false: frets and obstacles are never struck, all else being equal
    FretsDescription frets;
    std::vector<ObstacleDescription> obstacles;      ///< at most limits::obstacles
    std::vector<SoftTouchDescription> soft_touches;  ///< at most limits::soft_touches on a string
    std::vector<ExciterDescription> exciters;        ///< 1 to limits::exciters
    HandDescription hand;
    std::vector<PickupDescription> pickups;            ///< at most limits::pickups; none needs a body
    std::vector<BodyModeDescription> body;             ///< at most limits::body_modes
    std::vector<InstrumentStringDescription> strings;  ///< 1 to limits::instrument_strings

    /// Not of preset files: frequencies of the 128 MIDI notes from a tuning [Hz], NaN where no key is mapped;
    /// empty: open strings and frets as described. They set the pitch of every string and fret.
    std::vector<double> note_frequency_hz;
    bool tuning_moves_frets = false;  ///< fret positions follow the tuning instead of the description
};

namespace limits {
inline constexpr std::size_t frets = 36;
inline constexpr std::size_t instrument_strings = 128;
inline constexpr std::size_t instrument_modes = 2048;  ///< per string
inline constexpr std::size_t pickups = 8;
inline constexpr std::size_t obstacles = 32;
inline constexpr std::size_t obstacle_points = 256;
inline constexpr std::size_t soft_touches = 2;
inline constexpr std::size_t exciters = 16;
inline constexpr std::size_t body_modes = 256;
}  // namespace limits

}  // namespace jawari
