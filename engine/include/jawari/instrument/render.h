// Playing an instrument: a function of (const model, state, events, block).
#pragma once

#include <cstddef>
#include <span>

#include "jawari/instrument/events.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Where rendering writes a block. Every pointer has room for the block's frames, which are overwritten.
struct InstrumentOutput {
    double* left = nullptr;   ///< left channel; full scale is 1
    double* right = nullptr;  ///< right channel; full scale is 1
    /// Empty, or one pointer for each string: what it gives to the sound with gain, volume and expression,
    /// without pan. That is its pickups, and the mean of the body's left and right when it alone drives it.
    std::span<double* const> strings;
};

/// Renders `frames` samples. Sample n is the sound at the end of the block's frame n, so that the first
/// sample that a note changes is the one at its event's offset. Events come in the order of their offsets;
/// one with a smaller offset than the event in front of it takes effect together with that event. An event at
/// or past `frames` is applied when the block is done, as if at the start of the next. The samples do not
/// depend on how frames are grouped into blocks. Events with a field out of range (or not finite) are
/// ignored.
///
/// *Which string*, PlayMode::Keyboard. A key already held on the same channel is excited again on its string.
/// Else, of the strings that have the note: one without a held note, with the lowest fret; if all are held,
/// the one longest held by the pedal alone, then the one whose key went down first. Before a held note is
/// taken, notes that begin in the same frame, without a note that ends between them, move over to other free
/// strings, so that as many of a chord sound as any choice of strings allows. Strings of a course go
/// together. PlayMode::Guitar: channel c plays course c. Notes that no string has are ignored and counted.
///
/// *Which voice.* A note at the fret where its string already sounds excites that voice again. At another
/// fret it starts a voice from rest, or takes the sounding one over in legato. A string does one thing at a
/// time: every earlier voice of the string then fades to silence within fade_s. If no voice is idle, the note
/// waits until one has faded; a further note replaces the one that waits, which is counted as ignored. A
/// string that only sounds open has one voice, which every note excites again.
///
/// Threads: one at a time per state; realtime-safe.
void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, const InstrumentOutput& output,
                       std::size_t frames) JAWARI_REALTIME;

/// Renders `frames` samples in mono: half the sum of left and right. Otherwise as the function above.
/// Threads: one at a time per state; realtime-safe.
void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME;

/// Energy of the voices of string `string` (index) beyond their energy at rest [J]. Uses the state's scratch
/// space. Threads: one at a time per state; realtime-safe.
double string_energy(const InstrumentModel& model, InstrumentState& state,
                     std::size_t string) JAWARI_REALTIME;

/// Energy of a moving bridge: of the body's modes, of the coupling, and what contacts have left unbalanced
/// (BridgeState::debt_J) [J]; 0 if the bridge is rigid. With string_energy() of all strings it rises by no
/// more than the work in InstrumentState::work. Threads: one at a time per state; realtime-safe.
double bridge_energy(const InstrumentModel& model, const InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
