#include "midi/interpreter.h"

#include <algorithm>

#include "midi/interpreter_controllers.h"

namespace jawari::host {

namespace {

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
    const MidiChannel& state = channel_state(interpreter, channel);
    const int sounding =
        state.open[static_cast<std::size_t>(key)] > 0 ? state.sounds[static_cast<std::size_t>(key)] : key;
    add_event(actions, press_note(0, sounding, value / 127.0, channel));
}

void pitch_bend(MidiInterpreter& interpreter, int channel, int bend, MidiActions& actions) {
    channel_state(interpreter, channel).bend = bend;
    for_each_reached(interpreter, channel, [&](int reached) { add_bend(interpreter, reached, actions); });
}

/// Drums and effects by bank: XG has them in banks 64, 126 and 127 (coarse), General MIDI 2 in 120; 121 is
/// melodic, on channel 10 too. In GS these are variations of instruments, and a message says what is a drum.
bool is_unpitched(const MidiInterpreter& interpreter, const MidiChannel& channel) {
    constexpr int effects = 64, gm2_drums = 120, gm2_melody = 121, xg_effect_kits = 126, xg_drums = 127;
    if (interpreter.mode == SoundMode::Gs) return channel.rhythm_part;
    const int bank = channel.bank_msb;
    if (bank == gm2_drums || bank == xg_effect_kits || bank == xg_drums) return true;
    if (bank == gm2_melody) return false;
    if (interpreter.mode != SoundMode::Xg) return channel.rhythm_part;
    return bank == effects || (channel.rhythm_part && !channel.has_bank);
}

void program_change(MidiInterpreter& interpreter, int channel, int program, MidiActions& actions) {
    if (is_member(interpreter.zones, channel)) return;
    MidiChannel& state = channel_state(interpreter, channel);
    const bool manages = manager_of(interpreter.zones, channel) == channel;
    state.unpitched = !manages && is_unpitched(interpreter, state);
    actions.program = {true, channel, state.bank_msb * 128 + state.bank_lsb, program, state.unpitched};
}

bool is_valid(const ChannelMessage& message) {
    const bool known = message.status >= 0x80 && (message.status < 0xF0 || is_system(message));
    return known && message.data1 < 0x80 && message.data2 < 0x80;
}

}  // namespace

bool in_guitar(const InterpreterSettings& settings, int channel) JAWARI_REALTIME {
    return settings.guitar_channel >= 0 && channel >= settings.guitar_channel &&
           channel < settings.guitar_channel + settings.guitar_strings;
}

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
    actions.programs_reset = false;
    actions.ignored = false;
    if (!is_valid(message)) return;
    if (is_system(message)) {
        system_message(interpreter, message, actions);
        return;
    }
    const int channel = channel_of(message);
    switch (kind_of(message)) {
        case MessageKind::NoteOff:
            note_off_message(interpreter, channel, message.data1, message.data2, actions);
            break;
        case MessageKind::NoteOn:
            note_on_message(interpreter, channel, message.data1, message.data2, actions);
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
    for (std::size_t key = 0; key < midi_key_count; ++key) fresh.sounds[key] = static_cast<std::uint8_t>(key);
    fresh.bend_range_semitones = interpreter.settings.bend_range_semitones;
    if (manager_of(interpreter.zones, channel) == channel) fresh.bend_range_semitones = 2;
    if (is_member(interpreter.zones, channel)) fresh.bend_range_semitones = 48;  // M1-100-UM
    fresh.mono = in_guitar(interpreter.settings, channel);
    fresh.rhythm_part = channel == default_drum_channel;
    fresh.unpitched = fresh.rhythm_part && manager_of(interpreter.zones, channel) < 0;
    const auto& initial = interpreter.settings.initial;
    fresh.volume = initial[static_cast<std::size_t>(ParameterId::Volume)];
    fresh.legato = initial[static_cast<std::size_t>(ParameterId::Legato)];
    return fresh;
}

int part_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME {
    if (in_guitar(interpreter.settings, channel)) return interpreter.settings.guitar_channel;
    const int manager = manager_of(interpreter.zones, channel);
    return manager >= 0 ? manager : channel;
}

}  // namespace jawari::host
