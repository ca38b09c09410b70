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

/// A place on the speaking length: a distance from the bridge, or a share of the length. The one above 0
/// counts; the share counts if both are.
struct StringPlace {
    double from_bridge_m = 0;  ///< distance from the bridge, inside the speaking length [m]
    double share = 0;          ///< distance from the bridge as a share of the length, 0 to 1, ends excluded
};

// ---------------------------------------------------------------------------------------------- strings

/// Places at which a string can be stopped. Fret j = 1, 2, ... sounds semitones[j-1] above the open string.
struct FretsDescription {
    std::size_t count = 0;       ///< number of frets, at most limits::frets
    std::vector<int> semitones;  ///< above the open string, rising, from 1; empty: 1, 2, 3, ...
    /// Distances from the nut, rising [m]. Empty: the speaking length falls as the pitch rises.
    std::vector<double> position_from_nut_m;
    /// Heights of the tops from the open string's rest line, negative [m]. Empty: the frets stop the string,
    /// but it never strikes them.
    std::vector<double> height_m;
    double restitution = 0;  ///< 0 to 1; ImpactLaw::Signorini ignores it
};

/// One string of an instrument.
struct InstrumentStringDescription {
    std::string name;                    ///< for messages and files; may be empty
    int open_note = 0;                   ///< MIDI note number of the open string, 0 to 127
    double open_frequency_hz = 0;        ///< of the open string's first partial, 10 to 5000 [Hz]
    double length_m = 0;                 ///< nut to bridge, 0.02 to 5 [m]
    double linear_density_kg_per_m = 0;  ///< 1e-5 to 0.1 [kg/m]
    double inharmonicity = 0;            ///< B of the open string, 0 to 0.01; f_k = k f_0 sqrt(1 + B k^2)
    std::variant<NoLoss, ValetteLoss, DecayTimePoints> damping;  ///< of the open string
    double level = 1;                                            ///< factor of the string's signals, 0 to 100
    double excitation = 1;  ///< factor of lifts and hammer speeds, 0.01 to 100
    double pan = 0;         ///< -1 left to 1 right
    /// Strings with the same course sound together: one key plays them all, at the same fret. Empty: alone.
    std::optional<std::size_t> course;
    std::optional<FretsDescription> frets;     ///< replaces the instrument's frets on this string
    std::optional<StringPlace> exciter_place;  ///< replaces the exciters' places on this string
    double release_t60_s = 0;  ///< replaces HandDescription::release_t60_s, 0.005 to 60 [s]; 0: does not
    /// No key plays it; on a moving bridge it answers to others. It has no frets.
    bool sympathetic = false;
};

// ---------------------------------------------------------------------------------------------- obstacles

/// Where an obstacle's distances begin, and what its heights are measured from.
enum class Origin {
    Bridge,  ///< distances from the bridge; heights from the open string's rest line
    Nut,     ///< distances from the nut; heights from the open string's rest line; only what lies in the
             ///< speaking length counts
    Stop     ///< distances from the nut or the fret that stops the string; heights from the speaking length's
             ///< rest line
};

/// height = height_m - drop_m (distance/length_m)^2 for distances up to length_m.
struct ParabolicProfile {
    double length_m = 0;  ///< extent of the profile, above 0, to 5 [m]
    double drop_m = 0;    ///< fall over the whole extent, 0 to 0.1 [m]
    double height_m = 0;  ///< height at the origin, -0.1 to 0.1 [m]
};

/// Corners (distance from the origin [m], height [m]) with rising distances, straight between them.
using CornerProfile = std::vector<std::pair<double, double>>;

/// A rigid body that strings strike: neck, curved bridge, thread, sawari, rattle.
struct ObstacleDescription {
    std::string name;                                       ///< for messages; may be empty
    Origin origin = Origin::Bridge;                         ///< of the profile's distances and heights
    Side side = Side::Below;                                ///< from which it presses on the string
    std::variant<CornerProfile, ParabolicProfile> profile;  ///< its shape
    /// Contacts spread evenly over the profile; 0: one at each corner (a corner profile only). At most
    /// limits::obstacle_points.
    std::size_t points = 0;
    double restitution = 0;            ///< 0 to 1; ImpactLaw::Signorini ignores it
    std::vector<std::size_t> strings;  ///< indices of the strings that strike it; empty: all
};

/// Something soft that always lies on the string: cotton, felt, rubber. Spring and dashpot.
struct SoftTouchDescription {
    std::string name;                  ///< for messages; may be empty
    StringPlace place;                 ///< of its middle
    double width_m = 0;                ///< over which its force is spread, 0 to 0.2 [m]
    double damping_kg_per_s = 0;       ///< of the dashpot, 0 to 1e4 [kg/s]
    double stiffness_N_per_m = 0;      ///< of the spring, 0 to 1e7 [N/m]
    std::vector<std::size_t> strings;  ///< indices of the strings that it lies on; empty: all
};

// ---------------------------------------------------------------------------------------------- players

/// A finger or plectrum lifts the string with a force and lets go. The force rises and falls as half a
/// cosine, held over each output frame; both times are rounded up to whole frames.
struct FingerDescription {
    double rise_s = 0.004;       ///< time in which the force rises, 1e-4 to 0.1 [s]
    double release_s = 0.0005;   ///< time in which the force falls, 5e-5 to 0.1 [s]
    double full_height_m = 0;    ///< lift of the string at the finger at velocity 1, 1e-6 to 0.02 [m]
    double height_exponent = 1;  ///< lift = full_height_m velocity^height_exponent, 0.1 to 4
    /// Dashpot of the finger while it lies on the string before the release, 0 to 100 [kg/s].
    double damping_kg_per_s = 0;
    /// The edge of a plectrum, skin on a wound string: rms of a random part of the force, as a share of the
    /// force, 0 to 1; its spectrum falls from some kilohertz on.
    double roughness = 0;
};

/// A free body with a felt or flesh of potential K xi^(p+1)/(p+1) strikes the string from below (Chaigne and
/// Askenfelt, JASA 95 (1994), give values for pianos).
struct HammerDescription {
    double mass_kg = 0;             ///< 1e-5 to 1 [kg]
    double stiffness = 0;           ///< K, 1 to 1e15 [N/m^p]
    double exponent = 2.5;          ///< p, 1 to 5
    double loss_s_per_m = 0;        ///< of the loss force K xi^p loss dxi/dt, 0 to 10 [s/m]
    double full_speed_m_per_s = 0;  ///< speed at velocity 1, 0.01 to 50 [m/s]
    double speed_exponent = 1;      ///< speed = full_speed velocity^speed_exponent, 0.1 to 4
    Side side = Side::Below;        ///< Above: it moves towards frets and neck, as the slapping thumb does
};

/// The clavichord's tangent: the string's end opposite the bridge is moved and stays in contact. The end
/// moves by height x (t/rise - sin(2 pi t/rise)/(2 pi)), without a jump of force.
struct TangentDescription {
    double rise_s = 0.003;       ///< time of the movement, 2e-4 to 0.1 [s]
    double full_height_m = 0;    ///< height at velocity 1, 1e-6 to 0.02 [m]
    double height_exponent = 1;  ///< height = full_height_m velocity^height_exponent, 0.1 to 4
};

/// What makes strings sound: one articulation. The first exciter whose velocities and strings fit plays a
/// note.
struct ExciterDescription {
    std::string name;    ///< of the articulation
    StringPlace place;   ///< where it acts; tangents ignore it
    double width_m = 0;  ///< over which the force is spread, 0 to 0.1 [m]
    std::variant<FingerDescription, HammerDescription, TangentDescription> body;  ///< what acts on the string
    double time_exponent = 0;        ///< times (finger, tangent) shrink as velocity^-time_exponent, 0 to 2
    double lowest_velocity = 0;      ///< of the notes that it plays, 0 to 1
    double highest_velocity = 1;     ///< of the notes that it plays, lowest_velocity to 1
    std::size_t first_string = 0;    ///< index of the first string that it plays
    std::size_t last_string = 1000;  ///< index of the last string that it plays; may be beyond the strings
};

/// What the hands do beside exciting. Dampings are given as the 60 dB decay time T60 of the first partial
/// that the touch alone would give in first order; no touch is harder than one that absorbs best.
struct HandDescription {
    bool damps = true;  ///< false: strings ring on after note-off, as on a dulcimer
    /// Where the damping hand lies. The defaults leave no partial free: for each k up to 39, |sin(k pi
    /// share)| is at least 0.35 at one of the two.
    std::array<StringPlace, 2> release_places{{{0, 0.164}, {0, 0.312}}};
    double release_t60_s = 0.1;  ///< T60 after note-off at release velocity 0.5, 0.005 to 60 [s]
    double release_spread = 2;   ///< factor of T60 at release velocity 0, divisor at 1; 1 to 10
    /// Noise of the hand, damper or jack that comes to the string at note-off: rms force in its middle at
    /// release velocity 0.5, multiplied by release_spread at 1 and divided by it at 0; 0 to 100 [N].
    double release_noise_N = 0;
    double release_noise_s = 0.03;    ///< time in which that noise swells and ends, 0.001 to 1 [s]
    StringPlace palm_place{0, 0.03};  ///< where the palm lies
    double palm_t60_s = 0.2;          ///< T60 at full palm mute, 0.005 to 60 [s]
    double dead_t60_s = 0.03;         ///< T60 of a dead note under the stopping hand, 0.005 to 60 [s]
    double harmonic_t60_s = 0.03;     ///< T60 of the light touch at a node, 0.005 to 60 [s]
    double harmonic_touch_s = 0.15;   ///< time after which the light touch leaves, 0.001 to 5 [s]
    double legato_level = 0.3;        ///< velocity factor of hammer-ons and pull-offs, 0 to 1
    double pressure_semitones = 0;    ///< bend at full pressure, -12 to 12 [semitones]
    double course_delay_s = 0;        ///< time between the strings of a course, 0 to 0.05 [s]
};

// ---------------------------------------------------------------------------------------------- output

/// What a pickup senses.
enum class PickupQuantity {
    Velocity,      ///< of the string [m/s]
    Displacement,  ///< of the string [m]
    BridgeForce    ///< what the string exerts on the bridge [N]; place and width are ignored
};

/// A pickup under every string.
struct PickupDescription {
    StringPlace place;                                   ///< of its middle
    double width_m = 0;                                  ///< over which it averages, 0 to 0.1 [m]
    double level = 1;                                    ///< output per unit of the quantity, -100 to 100
    PickupQuantity quantity = PickupQuantity::Velocity;  ///< what it senses
    /// Distance to the pole, 0 to 0.1 [m]; 0: linear. Velocities are divided by (1 - u/distance)^3: the field
    /// of a magnetic charge falls with the squared distance (Horton and Moore, Am. J. Phys. 77 (2009) 144).
    double magnet_distance_m = 0;
    /// The coil with its cable and the tone control: a low pass of second order with its resonance here, 50
    /// to 20000 [Hz]; 0: none. It acts on each partial at its compiled frequency, without its phase.
    double resonance_hz = 0;
    double quality_factor = 1;  ///< of that low pass: its gain at the resonance, 0.2 to 20
};

/// A resonance of the body, driven by the force on the bridge: a damped oscillator whose velocity is heard.
struct BodyModeDescription {
    double frequency_hz = 0;  ///< 5 to 20000 [Hz]
    double t60_s = 0;         ///< time of a decay by 60 dB, 1e-4 to 20 [s]
    double gain_left = 0;     ///< output on the left per velocity, -1e6 to 1e6 [s/m]
    double gain_right = 0;    ///< output on the right per velocity, -1e6 to 1e6 [s/m]
    /// Of a mode that moves the bridge, 1e-4 to 1e4 [kg]; 0: it listens to the force on the bridge, as a mode
    /// of 1 kg, and takes nothing. On a rigid bridge all do.
    double mass_kg = 0;
    /// Of a mode with mass: displacement of the bridge under each string per displacement of the mode, -100
    /// to 100; empty: 1 under all.
    std::vector<double> shape{};
};

/// The bridge moves with the body: strings drive the body, it drives them, and each string the others
/// (docs/engine/model.md, "The moving bridge").
struct BridgeDescription {
    /// How freely open strings that nobody plays ring along, 0 to 1: 1 undamped, in between under a hand, 0
    /// only with the sustain pedal, as under dampers.
    double open_strings = 1;
};

/// How strings are given to notes; render_instrument() has the rules.
enum class PlayMode {
    Keyboard,  ///< the engine chooses a string that has the note
    Guitar     ///< channel c plays course c
};

/// How finely an instrument is computed.
struct QualityDescription {
    /// Contact steps per second, rounded up to an integer multiple of the output rate, 8000 to 1e8 [Hz].
    double contact_rate_min_hz = 500000;
    /// Modes up to this frequency are computed, 10 to 0.45 contact_rate_min_hz [Hz].
    double mode_limit_hz = 20000;
};

/// A string instrument.
struct InstrumentDescription {
    std::string name;  ///< for messages and files; may be empty
    double gain = 1;   ///< factor of the sum of pickups and body, 0 to 1e6; an output of 1 is full scale
    QualityDescription quality;                ///< for playing
    std::optional<QualityDescription> studio;  ///< for rendering to files; the host chooses
    ImpactLaw law = ImpactLaw::Signorini;      ///< of all contacts
    PlayMode play = PlayMode::Keyboard;        ///< how strings are given to notes
    bool contacts = true;    ///< false: frets and obstacles are never struck, all else being equal
    FretsDescription frets;  ///< of strings that have none of their own
    std::vector<ObstacleDescription> obstacles;      ///< at most limits::obstacles
    std::vector<SoftTouchDescription> soft_touches;  ///< at most limits::soft_touches on a string
    std::vector<ExciterDescription> exciters;        ///< 1 to limits::exciters
    HandDescription hand;                            ///< damping, palm, legato
    std::vector<PickupDescription> pickups;          ///< at most limits::pickups; none needs a body
    std::vector<BodyModeDescription> body;           ///< at most limits::body_modes
    /// The bridge moves; body modes then have masses and shapes. Empty: it is rigid, and the body listens.
    std::optional<BridgeDescription> bridge;
    std::vector<InstrumentStringDescription> strings;  ///< 1 to limits::instrument_strings

    /// Frequencies of the 128 MIDI notes from a tuning [Hz], NaN where no key is mapped. They set the pitch
    /// of every string and fret. Empty: open strings and frets as described. Preset files do not have them.
    std::vector<double> note_frequency_hz;
    bool tuning_moves_frets = false;  ///< fret positions follow the tuning instead of the description
};

/// Largest sizes that compile_instrument() accepts.
namespace limits {
inline constexpr std::size_t frets = 36;                ///< per string
inline constexpr std::size_t instrument_strings = 128;  ///< per instrument
inline constexpr std::size_t instrument_modes = 2048;   ///< per string
inline constexpr std::size_t pickups = 8;               ///< per instrument
inline constexpr std::size_t obstacles = 32;            ///< per instrument
inline constexpr std::size_t obstacle_points = 256;     ///< per obstacle
inline constexpr std::size_t soft_touches = 2;          ///< per string
inline constexpr std::size_t exciters = 16;             ///< per instrument
inline constexpr std::size_t body_modes = 256;          ///< per instrument
inline constexpr std::size_t moving_body_modes = 64;    ///< per instrument with a bridge that moves
}  // namespace limits

}  // namespace jawari
