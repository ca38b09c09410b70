// Notes that are no MIDI messages: plugin hosts give them finer velocities, and each its own tuning. Pedals,
// modes, tunings and bends of the channel act on them as on others.
#pragma once

#include "midi/interpreter.h"

namespace jawari::host {

// All of these append to `actions`; channel: 0 to 15, key: 0 to 127, as the sender names it. Threads: one at
// a time per interpreter; realtime-safe.

/// velocity: above 0, to 1.
void start_note(MidiInterpreter& interpreter, int channel, int key, double velocity,
                MidiActions& actions) JAWARI_REALTIME;

/// release: velocity of the release, 0 to 1.
void release_note(MidiInterpreter& interpreter, int channel, int key, double release,
                  MidiActions& actions) JAWARI_REALTIME;

/// The held note sounds `semitones` (-96 to 96) above what its channel's bend and tuning say, until it ends
/// or this is called again. Nothing happens if the key is not down.
void tune_note(MidiInterpreter& interpreter, int channel, int key, double semitones,
               MidiActions& actions) JAWARI_REALTIME;

/// The key of the instrument that plays a key of the sender, as of its latest note.
inline int sounding_key(const MidiInterpreter& interpreter, int channel, int key) JAWARI_REALTIME {
    return interpreter.channels[static_cast<std::size_t>(channel)].sounds[static_cast<std::size_t>(key)];
}

}  // namespace jawari::host
