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

/// State of a channel that belongs to these zones, as after power-up.
MidiChannel fresh_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME;

}  // namespace jawari::host
