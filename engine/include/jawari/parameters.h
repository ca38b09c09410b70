// The parameters that may change while an instrument plays, declared once: command line, preset, MIDI map and
// plugin read this table.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace jawari {

/// Number of a parameter. Numbers are stable: a new parameter is added at the end. parameter_table() says
/// what each one does.
enum class ParameterId : std::size_t {
    Volume,
    Expression,
    Pan,
    PluckPosition,
    PluckHardness,
    VelocityCurve,
    PalmMute,
    PalmPosition,
    Harmonic,
    DeadNote,
    Articulation,
    Legato,
    SlideTime,
    VibratoDepth,
    VibratoRate,
    BendRange,
    PickupMix,
    BodyMix,
    ReleaseTime,
    Action
};

/// How a control's travel 0..1 covers low..high.
enum class Curve {
    Linear,       ///< low + t (high - low)
    Exponential,  ///< low (high/low)^t; low above 0
    Squared,      ///< low + t^2 (high - low): MIDI's recommended law of volume and expression
    Stepped       ///< Linear, rounded to whole numbers
};

/// What follows a change of a parameter.
enum class Reach {
    Sounding,  ///< sounding notes, smoothly
    NextNote,  ///< notes that start afterwards
    Host       ///< the host's MIDI interpreter; the engine stores the value and does not read it
};

/// What a parameter is.
struct ParameterDeclaration {
    ParameterId id;               ///< its number, the index into parameter_table()
    std::string_view key;         ///< its name in files and on the command line; stable
    std::string_view unit;        ///< of low, high and neutral: "1" for ratios, else SI or musical
    double low;                   ///< smallest value
    double high;                  ///< largest value
    double neutral;               ///< value at which the instrument is as its preset describes it
    Curve curve;                  ///< how a control covers low to high
    Reach reach;                  ///< what follows a change
    std::string_view text;        ///< what it does, one phrase
    std::string_view name;        ///< what people read beside its control
    std::string_view group;       ///< of controls that belong together
    std::string_view short_name;  ///< where there is room for eight letters
};

namespace detail {
using enum ParameterId;
inline constexpr std::array<ParameterDeclaration, 20> parameters{{
    {Volume, "volume", "1", 0, 1, 1, Curve::Squared, Reach::Sounding, "Level of the channel's notes",
     "Volume", "Mix", "Volume"},
    {Expression, "expression", "1", 0, 1, 1, Curve::Squared, Reach::Sounding,
     "Level of the channel's notes, beside the volume", "Expression", "Mix", "Express"},
    {Pan, "pan", "1", -1, 1, 0, Curve::Linear, Reach::Sounding,
     "Left (-1) to right (1), added to each string's own place", "Pan", "Mix", "Pan"},
    {PluckPosition, "pluck_position", "1", 0.25, 4, 1, Curve::Exponential, Reach::NextNote,
     "Factor of the exciter's distance from the bridge", "Pluck position", "Pluck", "PluckPos"},
    {PluckHardness, "pluck_hardness", "1", 0.25, 4, 1, Curve::Exponential, Reach::NextNote,
     "Speed of release, stiffness of felt; above 1 is brighter", "Pluck hardness", "Pluck", "Hardness"},
    {VelocityCurve, "velocity_curve", "1", 0.25, 4, 1, Curve::Exponential, Reach::NextNote,
     "Exponent on note-on velocities; above 1 makes soft notes softer", "Velocity curve", "Pluck",
     "VelCurve"},
    {PalmMute, "palm_mute", "1", 0, 1, 0, Curve::Linear, Reach::Sounding,
     "How firmly the palm damps the strings", "Palm mute", "Right hand", "PalmMute"},
    {PalmPosition, "palm_position", "1", 0.25, 4, 1, Curve::Exponential, Reach::NextNote,
     "Factor of the palm's distance from the bridge", "Palm position", "Right hand", "PalmPos"},
    {Harmonic, "harmonic", "1", 1, 7, 1, Curve::Stepped, Reach::NextNote,
     "Natural harmonic: a light touch at 1/n of the string; 1 is off", "Harmonic", "Left hand", "Harmonic"},
    {DeadNote, "dead_note", "1", 0, 1, 0, Curve::Linear, Reach::NextNote,
     "How firmly the stopping hand damps a note that it does not press", "Dead note", "Left hand",
     "DeadNote"},
    {Articulation, "articulation", "1", 0, 16, 0, Curve::Stepped, Reach::NextNote,
     "0: the preset chooses by velocity and string; n: its n-th exciter", "Articulation", "Pluck", "Artic"},
    {Legato, "legato", "1", 0, 1, 0, Curve::Stepped, Reach::NextNote,
     "1: a note that overlaps another of its channel is a hammer-on or pull-off on its string", "Legato",
     "Left hand", "Legato"},
    {SlideTime, "slide_time", "s", 0, 2, 0, Curve::Squared, Reach::NextNote,
     "Time of a slide from note to note in legato; 0: hammer-ons and pull-offs", "Slide time", "Left hand",
     "Slide"},
    {VibratoDepth, "vibrato_depth", "semitones", 0, 2, 0, Curve::Squared, Reach::Sounding,
     "Amplitude of the vibrato by tension", "Vibrato depth", "Left hand", "VibDepth"},
    {VibratoRate, "vibrato_rate", "Hz", 0.1, 20, 5, Curve::Exponential, Reach::Sounding,
     "Rate of the vibrato", "Vibrato rate", "Left hand", "VibRate"},
    {BendRange, "bend_range", "semitones", 0, 96, 2, Curve::Linear, Reach::Host,
     "Pitch wheel's range, as RPN 0 sets it", "Bend range", "Left hand", "BendRng"},
    {PickupMix, "pickup_mix", "1", 0, 1, 0.5, Curve::Linear, Reach::Sounding,
     "0: pickups of the first half alone, 0.5: as the preset mixes them, 1: those of the second half alone",
     "Pickup mix", "Mix", "Pickups"},
    {BodyMix, "body_mix", "1", 0, 2, 1, Curve::Linear, Reach::Sounding, "Factor of the body's sound",
     "Body mix", "Mix", "Body"},
    {ReleaseTime, "release_time", "1", 0.1, 10, 1, Curve::Exponential, Reach::NextNote,
     "Factor of the decay time after note-off", "Release time", "Right hand", "Release"},
    {Action, "action", "m", -0.002, 0.004, 0, Curve::Linear, Reach::NextNote,
     "Distance added between the strings and everything below them", "Action", "Instrument", "Action"},
}};
}  // namespace detail

/// Number of parameters.
inline constexpr std::size_t parameter_count = detail::parameters.size();

/// All parameters, in order of ParameterId. Threads: any; realtime-safe.
constexpr std::span<const ParameterDeclaration, parameter_count> parameter_table() {
    return detail::parameters;
}

/// What the parameter is. Threads: any; realtime-safe.
constexpr const ParameterDeclaration& declaration_of(ParameterId id) {
    return detail::parameters[static_cast<std::size_t>(id)];
}

/// Value at which a control stands at `travel` of its way, 0 to 1 (clamped), in the parameter's unit.
/// Threads: any; realtime-safe.
double parameter_value(const ParameterDeclaration& parameter, double travel) noexcept;

/// Travel, 0 to 1, at which a control stands for `value`, low to high (clamped): the inverse of
/// parameter_value() but for the rounding of Curve::Stepped. Threads: any; realtime-safe.
double parameter_travel(const ParameterDeclaration& parameter, double value) noexcept;

}  // namespace jawari
