#include "midi/interpreter_controllers.h"

#include <algorithm>

namespace jawari::host {

namespace {

using Type = InstrumentEventType;

constexpr double largest_bend_semitones = 96;

double own_bend(const MidiChannel& channel) {
    return (2 * control_travel(channel.bend, 14) - 1) * channel.bend_range_semitones +
           channel.fine_tuning_semitones;
}

/// A member's timbre, moved by how far its manager's is off the neutral middle.
double reached_timbre(const MidiInterpreter& interpreter, int channel) {
    double timbre = interpreter.channels[static_cast<std::size_t>(channel)].timbre;
    if (is_member(interpreter.zones, channel)) {
        const int manager = manager_of(interpreter.zones, channel);
        timbre += interpreter.channels[static_cast<std::size_t>(manager)].timbre - 0.5;
    }
    return std::clamp(timbre, 0.0, 1.0);
}

void add_timbre(const MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    add_event(actions, set_timbre(0, reached_timbre(interpreter, channel), channel));
}

void add_for_zone(const MidiInterpreter& interpreter, int channel, Type type, double value,
                  MidiActions& actions) {
    for_each_reached(interpreter, channel, [&](int reached) {
        add_event(actions, {.type = type, .channel = reached, .value = value});
    });
}

/// What member channels may carry besides notes, bends and pressure (M1-100-UM): timbre, velocity prefix,
/// data entry (RPN 0) and channel modes.
bool may_reach_member(int controller) {
    return controller == 6 || controller == 38 || controller == 74 || controller == 88 ||
           (controller >= 96 && controller <= 101) || controller >= 120;
}

/// A pair of controllers sends its coarse half first, which clears the fine one (MIDI 1.0). False if no
/// binding has it.
bool bound_controller(MidiInterpreter& interpreter, int channel, int controller, int value,
                      MidiActions& actions) {
    const bool bound = apply_bindings(interpreter, MidiSource::Controller, controller, channel,
                                      control_travel(value, 7), actions);
    if (controller >= 64) return bound;
    const int coarse = controller % 32;
    int& kept = channel_state(interpreter, channel).coarse[static_cast<std::size_t>(coarse)];
    if (controller < 32) kept = value;
    const int fine = controller < 32 ? 0 : value;
    return apply_bindings(interpreter, MidiSource::Controller14, coarse, channel,
                          control_travel(kept * 128 + fine, 14), actions) ||
           bound;
}

/// Either pedal holds.
void add_sustain(MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    const MidiChannel& state = channel_state(interpreter, channel);
    add_for_zone(interpreter, channel, Type::Sustain, state.sustain || state.hold_2 ? 1 : 0, actions);
}

/// Controllers that mean something unless a map has them for something else.
bool default_controller(MidiInterpreter& interpreter, int channel, int controller, int value,
                        MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    switch (controller) {
        case 5:
            state.portamento_time = value;
            if (state.portamento && state.mono) add_portamento(interpreter, channel, actions);
            return true;
        case 65:
            if (state.portamento == (value >= 64)) return true;
            state.portamento = value >= 64;
            if (state.mono) add_portamento(interpreter, channel, actions);
            return true;
        case 84:  // a string slides only from where it is
            state.glide_from = state.open[static_cast<std::size_t>(value)] > 0 ? value : -1;
            return state.glide_from >= 0;
        case 66:
            for_each_reached(interpreter, channel,
                             [&](int reached) { set_sostenuto(interpreter, reached, value >= 64, actions); });
            return true;
        case 69:
            state.hold_2 = value >= 64;
            add_sustain(interpreter, channel, actions);
            return true;
        default:
            return false;
    }
}

/// "Response to Reset All Controllers", RP-015: volume, pan, bank, program, sound controllers (70 to 79) and
/// the values of parameter numbers stay.
void reset_controllers(MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    state.bend = 0x2000;
    state.pressure = 0;
    state.target = DataTarget::None;
    state.number_msb = state.number_lsb = 127;
    state.has_velocity_lsb = false;
    state.sustain = state.hold_2 = false;
    if (state.portamento) {
        state.portamento = false;
        if (state.mono) add_portamento(interpreter, channel, actions);
    }
    state.glide_from = -1;
    set_sostenuto(interpreter, channel, false, actions);
    add_event(actions, jawari::reset_controllers(0, channel));
    if (reached_timbre(interpreter, channel) != 0.5) add_timbre(interpreter, channel, actions);
    if (is_member(interpreter.zones, channel)) return;
    bound_controller(interpreter, channel, 1, 0, actions);
    bound_controller(interpreter, channel, 11, 127, actions);
}

/// What stays of the bends once all channels are reset: tunings, and a manager's bend for its members.
void restore_bends(MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    for_each_reached(interpreter, channel, [&](int reached) {
        if (whole_bend(interpreter, reached) != 0)
            add_bend(interpreter, reached, actions);
        else
            add_key_bends(interpreter, reached, 0, actions);
    });
}

/// Mode 4 of `count` channels, 0: all from this one on (MIDI 1.0).
void set_mono(MidiInterpreter& interpreter, int channel, int count, bool mono, MidiActions& actions) {
    const int all = static_cast<int>(midi_channel_count);
    const int end = mono && count != 1 ? std::min(all, count == 0 ? all : channel + count) : channel + 1;
    for (int each = channel; each < end; ++each) {
        MidiChannel& state = channel_state(interpreter, each);
        const bool changes = state.mono != mono && state.portamento;
        state.mono = mono;
        if (changes) add_portamento(interpreter, each, actions);
    }
}

}  // namespace

double whole_bend(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME {
    double bend = own_bend(interpreter.channels[static_cast<std::size_t>(channel)]);
    if (is_member(interpreter.zones, channel)) {
        const int manager = manager_of(interpreter.zones, channel);
        bend += own_bend(interpreter.channels[static_cast<std::size_t>(manager)]);
    }
    return std::clamp(bend + interpreter.master_fine_semitones, -largest_bend_semitones,
                      largest_bend_semitones);
}

double portamento_s(const MidiChannel& channel) JAWARI_REALTIME {
    return parameter_value(declaration_of(ParameterId::SlideTime),
                           control_travel(channel.portamento_time, 7));
}

/// Notes of a channel with one voice slide into each other; with several there is nothing to slide from.
void add_portamento(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME {
    const MidiChannel& state = interpreter.channels[static_cast<std::size_t>(channel)];
    const bool slides = state.portamento && state.mono;
    const double initial = interpreter.settings.initial[static_cast<std::size_t>(ParameterId::SlideTime)];
    const double slide_s = slides ? portamento_s(state) : initial;
    for_each_reached(interpreter, channel, [&](int reached) {
        add_event(actions, set_parameter(0, ParameterId::Legato, slides ? 1 : state.legato, reached));
        add_event(actions, set_parameter(0, ParameterId::SlideTime, slide_s, reached));
    });
}

void add_bend(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME {
    const double bend = whole_bend(interpreter, channel);
    add_event(actions, bend_channel(0, bend, channel));
    add_key_bends(interpreter, channel, bend, actions);
}

void add_volume(const MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME {
    const double volume =
        interpreter.channels[static_cast<std::size_t>(channel)].volume * interpreter.master_volume;
    for_each_reached(interpreter, channel, [&](int reached) {
        add_event(actions, set_parameter(0, ParameterId::Volume, volume, reached));
    });
}

bool apply_bindings(MidiInterpreter& interpreter, MidiSource source, int number, int channel, double travel,
                    MidiActions& actions) JAWARI_REALTIME {
    bool bound = false;
    const MidiMap& map = interpreter.settings.map;
    for (std::size_t i = 0; i < map.count; ++i) {
        const MidiBinding& binding = map.bindings[i];
        if (binding.source != source || binding.number != number) continue;
        if (binding.channel >= 0 && binding.channel != channel) continue;
        bound = true;
        const double value = bound_value(binding, travel);
        if (binding.parameter == ParameterId::Volume) {
            channel_state(interpreter, channel).volume = value;
            add_volume(interpreter, channel, actions);
            continue;
        }
        if (binding.parameter == ParameterId::Legato) channel_state(interpreter, channel).legato = value;
        for_each_reached(interpreter, channel, [&](int reached) {
            if (binding.parameter == ParameterId::BendRange) {
                if (reached != channel) return;  // each channel of a zone has a range of its own
                channel_state(interpreter, channel).bend_range_semitones = value;
                return;
            }
            add_event(actions, {.type = Type::SetParameter,
                                .channel = reached,
                                .value = value,
                                .parameter = binding.parameter});
        });
        if (binding.parameter == ParameterId::BendRange) restore_bends(interpreter, channel, actions);
    }
    return bound;
}

void control_change(MidiInterpreter& interpreter, int channel, int controller, int value,
                    MidiActions& actions) JAWARI_REALTIME {
    if (is_member(interpreter.zones, channel) && !may_reach_member(controller)) return;
    MidiChannel& state = channel_state(interpreter, channel);
    if (controller >= 120) {
        channel_mode(interpreter, channel, controller, value, actions);
        return;
    }
    switch (controller) {
        case 0:
            state.bank_msb = value;
            state.bank_lsb = 0;
            state.has_bank = true;
            break;
        case 32:
            state.bank_lsb = value;
            break;
        case 64:
            state.sustain = value >= 64;
            add_sustain(interpreter, channel, actions);
            break;
        case 67:
            add_for_zone(interpreter, channel, Type::SoftPedal, value / 127.0, actions);
            break;
        case 74:
            state.timbre = control_travel(value, 7);
            for_each_reached(interpreter, channel,
                             [&](int reached) { add_timbre(interpreter, reached, actions); });
            break;
        case 88:
            state.velocity_lsb = value;
            state.has_velocity_lsb = true;
            break;
        default:
            if (is_reserved_controller(controller)) {
                data_control(interpreter, channel, controller, value, actions);
            } else if (!bound_controller(interpreter, channel, controller, value, actions)) {
                actions.ignored = !default_controller(interpreter, channel, controller, value, actions);
            }
    }
}

void channel_mode(MidiInterpreter& interpreter, int channel, int controller, int value,
                  MidiActions& actions) JAWARI_REALTIME {
    constexpr int all_sound_off = 120;
    constexpr int reset_all_controllers = 121;
    constexpr int local_control = 122;
    constexpr int mono_on = 126;
    constexpr int poly_on = 127;
    if (controller == local_control) return;
    if (controller == reset_all_controllers) {
        for_each_reached(interpreter, channel,
                         [&](int reached) { reset_controllers(interpreter, reached, actions); });
        restore_bends(interpreter, channel, actions);
        return;
    }
    const Type type = controller == all_sound_off ? Type::AllSoundOff : Type::AllNotesOff;
    for_each_reached(interpreter, channel, [&](int reached) {
        forget_notes(channel_state(interpreter, reached));
        add_event(actions, {.type = type, .channel = reached});
    });
    if (controller == mono_on) set_mono(interpreter, channel, value, true, actions);
    if (controller == poly_on) set_mono(interpreter, channel, value, false, actions);
}

}  // namespace jawari::host
