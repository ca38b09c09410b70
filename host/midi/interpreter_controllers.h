// The interpreter's controllers, data entry and channel modes.
#pragma once

#include "midi/interpreter.h"

namespace jawari::host {

inline MidiChannel& channel_state(MidiInterpreter& interpreter, int channel) JAWARI_REALTIME {
    return interpreter.channels[static_cast<std::size_t>(channel)];
}

void add_event(MidiActions& actions, const InstrumentEvent& event) JAWARI_REALTIME;

/// The channel, and the members of the zone that it manages.
template <class Function>
void for_each_reached(const MidiInterpreter& interpreter, int channel, Function function) {
    const bool manages = manager_of(interpreter.zones, channel) == channel;
    for (int each = 0; each < static_cast<int>(midi_channel_count); ++each) {
        if (each == channel || (manages && manager_of(interpreter.zones, each) == channel)) function(each);
    }
}

/// The channel's bend, fine tuning and its manager's bend as one Bend event.
void add_bend(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME;

/// Parameter events of every binding of the source; false if there is none.
bool apply_bindings(MidiInterpreter& interpreter, MidiSource source, int number, int channel, double travel,
                    MidiActions& actions) JAWARI_REALTIME;

void control_change(MidiInterpreter& interpreter, int channel, int controller, int value,
                    MidiActions& actions) JAWARI_REALTIME;

/// Data entry, increment and decrement, and the numbers they go to: controllers 6, 38, 96 to 101.
void data_control(MidiInterpreter& interpreter, int channel, int controller, int value,
                  MidiActions& actions) JAWARI_REALTIME;

/// Controllers 120 to 127.
void channel_mode(MidiInterpreter& interpreter, int channel, int controller, int value,
                  MidiActions& actions) JAWARI_REALTIME;

/// Note messages: velocity prefix, mono, tunings; each note-off ends the oldest note of its key, and the
/// instrument hears of the last one (interpreter_notes.cpp).
void note_on_message(MidiInterpreter& interpreter, int channel, int key, int velocity,
                     MidiActions& actions) JAWARI_REALTIME;
void note_off_message(MidiInterpreter& interpreter, int channel, int key, int velocity,
                      MidiActions& actions) JAWARI_REALTIME;

/// Forgets which keys are down: the instrument has let go of all.
void forget_notes(MidiChannel& channel) JAWARI_REALTIME;

/// What slides take by controller 5 [s].
double portamento_s(const MidiChannel& channel) JAWARI_REALTIME;

/// Legato and the time of slides as the channel's controllers have set them, to all that it reaches.
void add_portamento(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME;

/// The sostenuto pedal: keys that are down when it goes down stay until it goes up.
void set_sostenuto(MidiInterpreter& interpreter, int channel, bool down,
                   MidiActions& actions) JAWARI_REALTIME;

/// Bends of the keys that are off the instrument's: they have the channel's bend, and their own.
void add_key_bends(const MidiInterpreter& interpreter, int channel, double bend,
                   MidiActions& actions) JAWARI_REALTIME;

/// After a change of tuning: what sounds follows it.
void retune_notes(MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME;

/// The channel's bend, its zone's and the instrument's [semitones].
double whole_bend(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME;

/// Volume times master volume, to all that the channel reaches.
void add_volume(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME;

/// A SystemKind message.
void system_message(MidiInterpreter& interpreter, const ChannelMessage& message,
                    MidiActions& actions) JAWARI_REALTIME;

bool in_guitar(const InterpreterSettings& settings, int channel) JAWARI_REALTIME;

/// State of a channel that belongs to these zones, as after power-up.
MidiChannel fresh_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME;

}  // namespace jawari::host
