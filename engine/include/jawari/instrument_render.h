// Playing an instrument: a function of (const model, state, events, block). Nothing here allocates, locks,
// throws or makes system calls.
#pragma once

#include <cstddef>
#include <span>

#include "jawari/instrument_model.h"
#include "jawari/instrument_state.h"
#include "jawari/realtime.h"

namespace jawari {

enum class InstrumentEventType {
    NoteOn,       ///< key, velocity; velocity 0 is a note-off
    NoteOff,      ///< key
    Sustain,      ///< value >= 0.5: pedal down
    AllNotesOff,  ///< releases every key of the channel; the pedal still holds
    AllSoundOff   ///< releases everything on the channel and fades it within fade_s
};

struct InstrumentEvent {
    std::size_t frame = 0;  ///< offset in the block
    InstrumentEventType type = InstrumentEventType::NoteOff;
    int channel = 0;   ///< 0 to 15
    int key = 0;       ///< MIDI note number, 0 to 127
    double value = 0;  ///< velocity or controller value, 0 to 1
};

/// Renders `frames` samples into `output` (overwritten). Sample n is the sound at the end of the block's
/// frame n, so that the first sample a note changes is the one at its event's offset. Events must be in order
/// of their offsets; those at or past `frames` are applied when the block is done, as if at the start of the
/// next. The numbers do not depend on how frames are grouped into blocks.
///
/// *Which string.* A key already held on the same channel is plucked again on its string. Else, of the
/// strings that have the note: one without a held note, with the lowest fret; if all are held, the one
/// longest held by the pedal alone, then the one whose key went down first. Notes that no string has are
/// ignored and counted.
///
/// *Which voice.* A new note damps its string's sounding note and starts another voice from rest. When that
/// leaves the string no idle voice, the damped one with the least energy fades to silence in fade_s. A note
/// that comes even sooner waits for it; a further one replaces the one that waits.
///
/// Events with a channel, key or value out of range (or not finite) are ignored.
void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME;

}  // namespace jawari
