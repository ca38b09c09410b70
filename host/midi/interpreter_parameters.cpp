#include "midi/interpreter_parameters.h"

#include "midi/interpreter_controllers.h"

namespace jawari::host {

namespace {

constexpr int channels_of_all = static_cast<int>(midi_channel_count);

/// RPN 0 of every channel that is in no MPE zone; zones have ranges of their own.
void set_bend_range(MidiInterpreter& interpreter, double semitones, MidiActions& actions) {
    interpreter.settings.bend_range_semitones = semitones;
    for (int channel = 0; channel < channels_of_all; ++channel) {
        MidiChannel& state = channel_state(interpreter, channel);
        if (manager_of(interpreter.zones, channel) >= 0) continue;
        const double before = whole_bend(interpreter, channel);
        state.bend_range_semitones = semitones;
        if (whole_bend(interpreter, channel) != before) add_bend(interpreter, channel, actions);
    }
}

/// While notes slide by portamento, they are legato whatever the parameter says.
void set_legato(MidiInterpreter& interpreter, double value, MidiActions& actions) {
    for (int channel = 0; channel < channels_of_all; ++channel) {
        MidiChannel& state = channel_state(interpreter, channel);
        state.legato = value;
        if (state.portamento && state.mono) continue;
        add_event(actions, jawari::set_parameter(0, ParameterId::Legato, value, channel));
    }
}

}  // namespace

void set_parameter(MidiInterpreter& interpreter, ParameterId parameter, double value,
                   MidiActions& actions) JAWARI_REALTIME {
    const ParameterDeclaration& declared = declaration_of(parameter);
    if (!(value >= declared.low && value <= declared.high)) return;
    interpreter.settings.initial[static_cast<std::size_t>(parameter)] = value;
    if (parameter == ParameterId::Legato) {
        set_legato(interpreter, value, actions);
        return;
    }
    double heard = value;
    if (parameter == ParameterId::Volume) {
        for (MidiChannel& channel : interpreter.channels) channel.volume = value;
        heard = value * interpreter.master_volume;
    }
    add_event(actions, jawari::set_parameter(0, parameter, heard, every_channel));
    if (parameter == ParameterId::BendRange) set_bend_range(interpreter, value, actions);
}

}  // namespace jawari::host
