// What an instrument is told while it plays: notes, bends, pedals, parameters.
#pragma once

#include <cstddef>

#include "jawari/parameters.h"

namespace jawari {

/// Kinds of events. The comment names the fields of InstrumentEvent that a kind reads, besides `frame` and
/// `channel`.
enum class InstrumentEventType {
    NoteOn,            ///< key, string; value: velocity above 0, to 1; 0 is a note-off
    NoteOff,           ///< key; value: release velocity, 0 to 1
    Bend,              ///< key or every_key; value: -96 to 96 [semitones]
    Pressure,          ///< key or every_key; value: 0 to 1
    Timbre,            ///< value: 0 to 1, 0.5 is neutral: hardness of the channel's next plucks
    Sustain,           ///< value: pedal down from 0.5 on
    SoftPedal,         ///< value: 0 to 1: how much softer the channel's next notes are
    AllNotesOff,       ///< releases every key of the channel; the sustain pedal still holds their notes
    AllSoundOff,       ///< releases everything on the channel and fades it within fade_s
    ResetControllers,  ///< sets pedals, bends, pressures and timbre of the channel to neutral
    SetParameter,      ///< parameter; value in its unit; channel or every_channel
    NoteLevel,         ///< key; value: 0 to most_note_level, 1 is neutral: factor of a held note's sound
    NotePan            ///< key; value: -1 (left) to 1 (right), 0 is neutral: added to a held note's place
};

/// Largest value of a NoteLevel: 12 dB.
inline constexpr double most_note_level = 4;

/// InstrumentEvent::key of a Bend or Pressure for all notes of a channel.
inline constexpr int every_key = -1;
/// InstrumentEvent::channel of a SetParameter for all channels.
inline constexpr int every_channel = -1;
/// InstrumentEvent::string of a NoteOn for which the engine chooses the string.
inline constexpr int any_string = -1;
/// Release velocity of a note-off that does not state one.
inline constexpr double neutral_release_velocity = 0.5;

/// One event. The functions below make it; rendering ignores an event with a field out of its range.
struct InstrumentEvent {
    std::size_t frame = 0;  ///< when it happens: frames after the block's first
    InstrumentEventType type = InstrumentEventType::NoteOff;  ///< which fields count
    int channel = 0;                                          ///< 0 to 15; every_channel in SetParameter
    int key = 0;              ///< MIDI note number, 0 to 127; every_key in Bend and Pressure
    double value = 0;         ///< see InstrumentEventType
    int string = any_string;  ///< index of the string whose course must play a NoteOn, or any_string
    ParameterId parameter{};  ///< of SetParameter
};

// Factories. `frame` is the offset in the block [frames]; `channel` is 0 to 15. All of them: any thread;
// realtime-safe.

/// A key goes down. `key`: 0 to 127; `velocity`: above 0, to 1.
constexpr InstrumentEvent note_on(std::size_t frame, int key, double velocity, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::NoteOn,
            .channel = channel,
            .key = key,
            .value = velocity};
}

/// A key goes down and must be played by the course of string `string` (index in the description).
constexpr InstrumentEvent note_on_string(std::size_t frame, int string, int key, double velocity,
                                         int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::NoteOn,
            .channel = channel,
            .key = key,
            .value = velocity,
            .string = string};
}

/// A key goes up. `velocity`: of the release, 0 (slow) to 1 (fast).
constexpr InstrumentEvent note_off(std::size_t frame, int key, double velocity = neutral_release_velocity,
                                   int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::NoteOff,
            .channel = channel,
            .key = key,
            .value = velocity};
}

/// Bends every note of a channel. `semitones`: -96 to 96.
constexpr InstrumentEvent bend_channel(std::size_t frame, double semitones, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::Bend,
            .channel = channel,
            .key = every_key,
            .value = semitones};
}

/// Bends one held note, in place of its channel's bend. `semitones`: -96 to 96.
constexpr InstrumentEvent bend_note(std::size_t frame, int key, double semitones, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::Bend,
            .channel = channel,
            .key = key,
            .value = semitones};
}

/// Presses every note of a channel. `pressure`: 0 to 1; HandDescription::pressure_semitones says what it
/// does.
constexpr InstrumentEvent press_channel(std::size_t frame, double pressure, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::Pressure,
            .channel = channel,
            .key = every_key,
            .value = pressure};
}

/// Presses one held note, in place of its channel's pressure. `pressure`: 0 to 1.
constexpr InstrumentEvent press_note(std::size_t frame, int key, double pressure, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::Pressure,
            .channel = channel,
            .key = key,
            .value = pressure};
}

/// Scales the sound of one held note until its string is played again; the note that is called off rings out
/// with it. `level`: 0 to most_note_level.
constexpr InstrumentEvent set_note_level(std::size_t frame, int key, double level, int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::NoteLevel,
            .channel = channel,
            .key = key,
            .value = level};
}

/// Moves one held note to the left or right of its string's and channel's place, likewise. `pan`: -1 to 1.
constexpr InstrumentEvent set_note_pan(std::size_t frame, int key, double pan, int channel = 0) noexcept {
    return {
        .frame = frame, .type = InstrumentEventType::NotePan, .channel = channel, .key = key, .value = pan};
}

/// Sets the hardness of a channel's next plucks. `timbre`: 0 to 1, 0.5 is neutral.
constexpr InstrumentEvent set_timbre(std::size_t frame, double timbre, int channel = 0) noexcept {
    return {.frame = frame, .type = InstrumentEventType::Timbre, .channel = channel, .value = timbre};
}

/// Moves the sustain pedal of a channel.
constexpr InstrumentEvent set_sustain_pedal(std::size_t frame, bool down, int channel = 0) noexcept {
    return {
        .frame = frame, .type = InstrumentEventType::Sustain, .channel = channel, .value = down ? 1.0 : 0.0};
}

/// Moves the soft pedal of a channel. `depth`: 0 (up) to 1 (down).
constexpr InstrumentEvent set_soft_pedal(std::size_t frame, double depth, int channel = 0) noexcept {
    return {.frame = frame, .type = InstrumentEventType::SoftPedal, .channel = channel, .value = depth};
}

/// Releases every key of a channel; the sustain pedal still holds their notes.
constexpr InstrumentEvent all_notes_off(std::size_t frame, int channel = 0) noexcept {
    return {.frame = frame, .type = InstrumentEventType::AllNotesOff, .channel = channel};
}

/// Releases everything on a channel and fades it within fade_s.
constexpr InstrumentEvent all_sound_off(std::size_t frame, int channel = 0) noexcept {
    return {.frame = frame, .type = InstrumentEventType::AllSoundOff, .channel = channel};
}

/// Sets pedals, bends, pressures and timbre of a channel to neutral. Parameters stay.
constexpr InstrumentEvent reset_controllers(std::size_t frame, int channel = 0) noexcept {
    return {.frame = frame, .type = InstrumentEventType::ResetControllers, .channel = channel};
}

/// Sets a parameter of one channel, or of all with every_channel. `value`: in the parameter's unit, from its
/// `low` to its `high` (ParameterDeclaration).
constexpr InstrumentEvent set_parameter(std::size_t frame, ParameterId parameter, double value,
                                        int channel = 0) noexcept {
    return {.frame = frame,
            .type = InstrumentEventType::SetParameter,
            .channel = channel,
            .value = value,
            .parameter = parameter};
}

}  // namespace jawari
