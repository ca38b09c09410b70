#include "midi/interpreter.h"

#include <algorithm>

#include "midi/interpreter_controllers.h"

namespace jawari::host {

namespace {

using Type = InstrumentEventType;

bool in_guitar(const InterpreterSettings& settings, int channel) {
    return settings.guitar_channel >= 0 && channel >= settings.guitar_channel &&
           channel < settings.guitar_channel + settings.guitar_strings;
}

int forced_string(const InterpreterSettings& settings, int channel) {
    if (!in_guitar(settings, channel)) return -1;
    return settings.guitar_string[static_cast<std::size_t>(channel - settings.guitar_channel)];
}

/// Velocity with the 14 bits of controller 88 (CA-031) if that came just before.
double take_velocity(MidiChannel& channel, int value) {
    const bool fine = channel.has_velocity_lsb;
    channel.has_velocity_lsb = false;
    return fine ? (value * 128 + channel.velocity_lsb) / 16383.0 : value / 127.0;
}

void note_off(MidiInterpreter& interpreter, int channel, int key, double release, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    if (state.mono_key == key) state.mono_key = -1;
    add_event(actions, jawari::note_off(0, key, release, channel));
}

void note_on(MidiInterpreter& interpreter, int channel, int key, int velocity, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    if (velocity == 0) {
        state.has_velocity_lsb = false;
        note_off(interpreter, channel, key, 0.5, actions);
        return;
    }
    add_event(actions, {.type = Type::NoteOn,
                        .channel = channel,
                        .key = key,
                        .value = take_velocity(state, velocity),
                        .string = forced_string(interpreter.settings, channel)});
    const int before = state.mono_key;
    state.mono_key = key;
    // After the new note, so that the instrument sees them overlap: legato is its affair.
    if (state.mono && before >= 0 && before != key)
        add_event(actions, jawari::note_off(0, before, neutral_release_velocity, channel));
}

/// A zone's pressure is felt by all its notes: the stronger of the two counts (M1-100-UM leaves the
/// combination to the receiver).
void add_pressure(const MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    double pressure = interpreter.channels[static_cast<std::size_t>(channel)].pressure;
    if (is_member(interpreter.zones, channel)) {
        const int manager = manager_of(interpreter.zones, channel);
        pressure = std::max(pressure, interpreter.channels[static_cast<std::size_t>(manager)].pressure);
    }
    add_event(actions, press_channel(0, pressure, channel));
}

void channel_pressure(MidiInterpreter& interpreter, int channel, int value, MidiActions& actions) {
    const double travel = value / 127.0;
    if (apply_bindings(interpreter, MidiSource::ChannelPressure, 0, channel, travel, actions)) return;
    channel_state(interpreter, channel).pressure = travel;
    for_each_reached(interpreter, channel, [&](int reached) { add_pressure(interpreter, reached, actions); });
}

void poly_pressure(MidiInterpreter& interpreter, int channel, int key, int value, MidiActions& actions) {
    if (is_member(interpreter.zones, channel)) return;  // forbidden there: M1-100-UM
    add_event(actions, press_note(0, key, value / 127.0, channel));
}

void pitch_bend(MidiInterpreter& interpreter, int channel, int bend, MidiActions& actions) {
    channel_state(interpreter, channel).bend = bend;
    for_each_reached(interpreter, channel, [&](int reached) { add_bend(interpreter, reached, actions); });
}

void program_change(const MidiInterpreter& interpreter, int channel, int program, MidiActions& actions) {
    if (is_member(interpreter.zones, channel)) return;
    const MidiChannel& state = interpreter.channels[static_cast<std::size_t>(channel)];
    actions.program = {true, channel, state.bank_msb * 128 + state.bank_lsb, program};
}

bool is_valid(const ChannelMessage& message) {
    return message.status >= 0x80 && message.status < 0xF0 && message.data1 < 0x80 && message.data2 < 0x80;
}

}  // namespace

void add_event(MidiActions& actions, const InstrumentEvent& event) JAWARI_REALTIME {
    if (actions.count < actions.events.size()) actions.events[actions.count++] = event;
}

MidiInterpreter make_interpreter(const InterpreterSettings& settings) {
    MidiInterpreter interpreter;
    interpreter.settings = settings;
    for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel)
        channel_state(interpreter, channel) = fresh_channel(interpreter, channel);
    return interpreter;
}

void interpret(MidiInterpreter& interpreter, const ChannelMessage& message,
               MidiActions& actions) JAWARI_REALTIME {
    actions.count = 0;
    actions.program.asked = false;
    if (!is_valid(message)) return;
    const int channel = channel_of(message);
    switch (kind_of(message)) {
        case MessageKind::NoteOff: {
            const double release = take_velocity(channel_state(interpreter, channel), message.data2);
            note_off(interpreter, channel, message.data1, release, actions);
            break;
        }
        case MessageKind::NoteOn:
            note_on(interpreter, channel, message.data1, message.data2, actions);
            break;
        case MessageKind::PolyPressure:
            poly_pressure(interpreter, channel, message.data1, message.data2, actions);
            break;
        case MessageKind::ControlChange:
            control_change(interpreter, channel, message.data1, message.data2, actions);
            break;
        case MessageKind::ProgramChange:
            program_change(interpreter, channel, message.data1, actions);
            break;
        case MessageKind::ChannelPressure:
            channel_pressure(interpreter, channel, message.data1, actions);
            break;
        case MessageKind::PitchBend:
            pitch_bend(interpreter, channel, message.data1 + 128 * message.data2, actions);
            break;
    }
}

MidiChannel fresh_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME {
    MidiChannel fresh;
    fresh.bend_range_semitones = interpreter.settings.bend_range_semitones;
    if (manager_of(interpreter.zones, channel) == channel) fresh.bend_range_semitones = 2;
    if (is_member(interpreter.zones, channel)) fresh.bend_range_semitones = 48;  // M1-100-UM
    fresh.mono = in_guitar(interpreter.settings, channel);
    return fresh;
}

int part_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME {
    if (in_guitar(interpreter.settings, channel)) return interpreter.settings.guitar_channel;
    const int manager = manager_of(interpreter.zones, channel);
    return manager >= 0 ? manager : channel;
}

}  // namespace jawari::host
