// Playing an instrument: a function of (const model, state, events, block). Nothing here allocates, locks,
// throws or makes system calls.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/parameters.h"
#include "jawari/realtime.h"

namespace jawari {

enum class InstrumentEventType {
    NoteOn,            ///< key; value: velocity above 0, to 1; 0 is a note-off
    NoteOff,           ///< key; value: release velocity 0 to 1, 0.5 unless known
    Bend,              ///< value: semitones, -96 to 96; key -1: all notes of the channel
    Pressure,          ///< value 0 to 1; key -1: all notes of the channel
    Timbre,            ///< value 0 to 1, 0.5 is neutral: hardness of the channel's next plucks
    Sustain,           ///< value >= 0.5: pedal down
    SoftPedal,         ///< value 0 to 1: softer next notes
    AllNotesOff,       ///< releases every key of the channel; the pedal still holds
    AllSoundOff,       ///< releases everything on the channel and fades it within fade_s
    ResetControllers,  ///< pedals, bends, pressure and timbre of the channel to neutral
    SetParameter       ///< parameter, value in its unit; channel -1: all channels
};

struct InstrumentEvent {
    std::size_t frame = 0;  ///< offset in the block
    InstrumentEventType type = InstrumentEventType::NoteOff;
    int channel = 0;   ///< 0 to 15; -1 in SetParameter: all
    int key = 0;       ///< MIDI note number, 0 to 127; -1 in Bend and Pressure: every note of the channel
    double value = 0;  ///< see the types
    int string = -1;   ///< NoteOn: index of the string (its course) that must play; -1: the allocator chooses
    ParameterId parameter{};
};

/// Where a block goes; every pointer to `frames` samples, overwritten.
struct InstrumentOutput {
    double* left = nullptr;
    double* right = nullptr;
    /// Empty, or one pointer per string: its pickups with gain, volume and expression, without pan and body.
    std::span<double* const> strings;
};

/// Renders `frames` samples. Sample n is the sound at the end of the block's frame n, so that the first
/// sample a note changes is the one at its event's offset. Events must be in order of their offsets; those at
/// or past `frames` are applied when the block is done, as if at the start of the next. The numbers do not
/// depend on how frames are grouped into blocks.
///
/// *Which string*, PlayMode::Keyboard. A key already held on the same channel is excited again on its string.
/// Else, of the strings that have the note: one without a held note, with the lowest fret; if all are held,
/// the one longest held by the pedal alone, then the one whose key went down first. Strings of a course go
/// together. PlayMode::Guitar: channel c plays course c. Notes that no string has are ignored and counted.
///
/// *Which motion.* A new note at the fret where its string already sounds acts on that motion. At another
/// fret it damps the sounding motion and starts one from rest, or carries it over in legato. When that leaves
/// the string no idle motion, the damped one with the least energy fades to silence in fade_s. A note that
/// comes even sooner waits for it; a further one replaces the one that waits.
///
/// Events with a field out of range (or not finite) are ignored.
void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, const InstrumentOutput& output,
                       std::size_t frames) JAWARI_REALTIME;

/// The same in mono: left and right added and halved.
void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME;

/// Energy of the motions of string `s` beyond that of their rest [J]. Uses the state's scratch space.
double string_energy(const InstrumentModel& model, InstrumentState& state, std::size_t s) JAWARI_REALTIME;

}  // namespace jawari
