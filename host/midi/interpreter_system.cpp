// Messages to the whole instrument: resets, master volume and tuning, drums, tunings of keys.
#include <cmath>

#include "midi/interpreter_controllers.h"

namespace jawari::host {

namespace {

constexpr int all_channels = static_cast<int>(midi_channel_count);

/// "General MIDI System Level 1": volume 100, expression 127, a bend range of 2 semitones, the wheel at its
/// centre, nothing held, program 0. Its guitar mode a guitar keeps.
void start_anew(MidiInterpreter& interpreter, SoundMode mode, MidiActions& actions) {
    interpreter.zones = {};
    interpreter.mode = mode;
    interpreter.master_volume = 1;
    interpreter.master_fine_semitones = 0;
    interpreter.master_coarse_semitones = 0;
    interpreter.tunings = {};
    actions.programs_reset = true;
    for (int channel = 0; channel < all_channels; ++channel) {
        const double legato = channel_state(interpreter, channel).legato;
        control_change(interpreter, channel, 65, 0, actions);
        channel_state(interpreter, channel) = fresh_channel(interpreter, channel);
        add_event(actions, jawari::all_notes_off(0, channel));
        add_event(actions, jawari::reset_controllers(0, channel));
        add_event(actions, bend_channel(0, 0, channel));
        const auto set = [&](int controller, int value) {
            control_change(interpreter, channel, controller, value, actions);
        };
        set(7, 100);
        set(10, 64);
        set(11, 127);
        set(1, 0);
        if (legato != channel_state(interpreter, channel).legato) set(68, 0);
    }
    actions.ignored = false;
}

void set_master_volume(MidiInterpreter& interpreter, int value, MidiActions& actions) {
    const double share = value / 16383.0;
    interpreter.master_volume = share * share;  // as controller 7 has it: 40 log10 of the value
    for (int channel = 0; channel < all_channels; ++channel)
        if (!is_member(interpreter.zones, channel)) add_volume(interpreter, channel, actions);
}

void bend_all(const MidiInterpreter& interpreter, MidiActions& actions) {
    for (int channel = 0; channel < all_channels; ++channel) add_bend(interpreter, channel, actions);
}

void retune_all(MidiInterpreter& interpreter, MidiActions& actions) {
    if (!interpreter.tunings.now) return;
    for (int channel = 0; channel < all_channels; ++channel) retune_notes(interpreter, channel, actions);
}

void set_tuning_value(MidiInterpreter& interpreter, int value, MidiActions& actions) {
    MidiTunings& tunings = interpreter.tunings;
    if (tunings.key >= 0) {
        const double pitch = tunings.semitone + value / 16384.0;
        tunings.keys[static_cast<std::size_t>(tunings.program)][static_cast<std::size_t>(tunings.key)] =
            static_cast<float>(pitch - tunings.key);
    } else if (tunings.pitch_class >= 0) {
        const auto offset = static_cast<float>((value - 8192) / 8192.0);
        for (std::size_t channel = 0; channel < midi_channel_count; ++channel)
            if ((tunings.channels >> channel & 1U) != 0)
                tunings.classes[channel][static_cast<std::size_t>(tunings.pitch_class)] = offset;
    }
    retune_all(interpreter, actions);
}

void set_rhythm(MidiInterpreter& interpreter, int channel, bool drums) {
    if (channel >= all_channels) return;
    MidiChannel& state = channel_state(interpreter, channel);
    state.rhythm_part = drums;
    state.unpitched = drums && manager_of(interpreter.zones, channel) < 0;
}

}  // namespace

void system_message(MidiInterpreter& interpreter, const ChannelMessage& message,
                    MidiActions& actions) JAWARI_REALTIME {
    const int value = message.data1 + 128 * message.data2;
    MidiTunings& tunings = interpreter.tunings;
    switch (static_cast<SystemKind>(message.status)) {
        case SystemKind::Reset:
            if (message.data1 <= static_cast<int>(SoundMode::Xg))
                start_anew(interpreter, static_cast<SoundMode>(message.data1), actions);
            break;
        case SystemKind::MasterVolume:
            set_master_volume(interpreter, value, actions);
            break;
        case SystemKind::MasterFine:
            interpreter.master_fine_semitones = (value - 8192) / 8192.0;
            bend_all(interpreter, actions);
            break;
        case SystemKind::MasterCoarse:
            interpreter.master_coarse_semitones = message.data1 - 64;
            break;
        case SystemKind::Rhythm:
            set_rhythm(interpreter, message.data1, message.data2 > 0);
            break;
        case SystemKind::TuneProgram:
            tunings.program = message.data1;
            tunings.now = message.data2 > 0;
            tunings.key = tunings.pitch_class = -1;
            tunings.channels = 0;
            break;
        case SystemKind::TuneChannels:
            tunings.channels |= static_cast<unsigned>(message.data2) << (7U * (message.data1 % 3U));
            break;
        case SystemKind::TuneKey:
            tunings.key = message.data1;
            tunings.semitone = message.data2;
            tunings.pitch_class = -1;
            break;
        case SystemKind::TuneClass:
            tunings.pitch_class = message.data1 % 12;
            tunings.key = -1;
            break;
        case SystemKind::TuneValue:
            set_tuning_value(interpreter, value, actions);
            break;
    }
}

}  // namespace jawari::host
