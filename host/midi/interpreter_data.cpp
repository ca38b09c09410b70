// Registered and non-registered parameter numbers and the data that goes to them (MIDI 1.0;
// RP-018 for increments).
#include <algorithm>
#include <cmath>

#include "midi/interpreter_controllers.h"

namespace jawari::host {

namespace {

constexpr int bend_sensitivity = 0;
constexpr int fine_tuning = 1;
constexpr int coarse_tuning = 2;
constexpr int tuning_program = 3;
constexpr int mpe_configuration = 6;

/// A member's range is that of all members of its zone (M1-100-UM).
void set_bend_range(MidiInterpreter& interpreter, int channel, double semitones, MidiActions& actions) {
    const double range = std::clamp(semitones, 0.0, 96.0);
    const bool member = is_member(interpreter.zones, channel);
    const int manager = manager_of(interpreter.zones, channel);
    for (int each = 0; each < static_cast<int>(midi_channel_count); ++each) {
        const bool follows =
            member && is_member(interpreter.zones, each) && manager_of(interpreter.zones, each) == manager;
        if (each != channel && !follows) continue;
        channel_state(interpreter, each).bend_range_semitones = range;
        if (channel_state(interpreter, each).bend == 0x2000) continue;
        for_each_reached(interpreter, each, [&](int reached) { add_bend(interpreter, reached, actions); });
    }
}

/// The MPE configuration message: every channel whose zone changes starts anew (M1-100-UM).
void configure_zone(MidiInterpreter& interpreter, int manager, int members, MidiActions& actions) {
    const MpeZones before = interpreter.zones;
    interpreter.zones = with_zone(before, manager, members);
    for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel) {
        const int old_manager = manager_of(before, channel);
        const int new_manager = manager_of(interpreter.zones, channel);
        const bool touched = old_manager != new_manager || new_manager == manager || channel == manager;
        if (!touched) continue;
        add_event(actions, jawari::all_notes_off(0, channel));
        add_event(actions, jawari::reset_controllers(0, channel));
        MidiChannel fresh = fresh_channel(interpreter, channel);
        fresh.bank_msb = channel_state(interpreter, channel).bank_msb;
        fresh.bank_lsb = channel_state(interpreter, channel).bank_lsb;
        fresh.has_bank = channel_state(interpreter, channel).has_bank;
        fresh.volume = channel_state(interpreter, channel).volume;
        fresh.legato = channel_state(interpreter, channel).legato;
        channel_state(interpreter, channel) = fresh;
    }
}

void set_registered(MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    if (state.number_msb != 0) {
        actions.ignored = true;
        return;
    }
    switch (state.number_lsb) {
        case bend_sensitivity:
            set_bend_range(interpreter, channel, state.data_msb + state.data_lsb / 100.0, actions);
            break;
        case fine_tuning:
            state.fine_tuning_semitones = 2 * control_travel(state.data_msb * 128 + state.data_lsb, 14) - 1;
            for_each_reached(interpreter, channel,
                             [&](int reached) { add_bend(interpreter, reached, actions); });
            break;
        case coarse_tuning:  // its fine half means nothing
            state.coarse_tuning_semitones = state.data_msb - 64;
            break;
        case tuning_program:
            state.tuning_program = state.data_msb;
            for_each_reached(interpreter, channel,
                             [&](int reached) { retune_notes(interpreter, reached, actions); });
            break;
        default:
            actions.ignored = true;
            break;
    }
}

/// After any change of data_msb or data_lsb.
void set_data(MidiInterpreter& interpreter, int channel, MidiActions& actions) {
    const MidiChannel& state = channel_state(interpreter, channel);
    if (state.target == DataTarget::Registered) {
        set_registered(interpreter, channel, actions);
    } else if (state.target == DataTarget::NonRegistered) {
        actions.ignored =
            !apply_bindings(interpreter, MidiSource::Nrpn, state.number_msb * 128 + state.number_lsb, channel,
                            control_travel(state.data_msb * 128 + state.data_lsb, 14), actions);
    }
}

/// The current value of what is selected, so that increments start from it.
void recall_data(MidiChannel& state) {
    state.data_msb = state.data_lsb = 0;
    if (state.target != DataTarget::Registered || state.number_msb != 0) return;
    if (state.number_lsb == bend_sensitivity) {
        const int cents = static_cast<int>(std::lround(100 * state.bend_range_semitones));
        state.data_msb = cents / 100;
        state.data_lsb = cents % 100;
    } else if (state.number_lsb == fine_tuning) {
        const int value = static_cast<int>(std::lround(8192 * (1 + state.fine_tuning_semitones)));
        state.data_msb = std::min(value, 16383) / 128;
        state.data_lsb = std::min(value, 16383) % 128;
    } else if (state.number_lsb == coarse_tuning) {
        state.data_msb = state.coarse_tuning_semitones + 64;
    } else if (state.number_lsb == tuning_program) {
        state.data_msb = state.tuning_program;
    }
}

/// Whether the coarse half is all of it: steps are of that.
bool is_coarse(const MidiChannel& state) {
    return state.target == DataTarget::Registered && state.number_msb == 0 &&
           (state.number_lsb == coarse_tuning || state.number_lsb == tuning_program);
}

/// RP-018: by one of the fine half, with carry; cents of the bend range carry at 100.
void step_data(MidiInterpreter& interpreter, int channel, int step, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    const bool cents = state.target == DataTarget::Registered && state.number_msb == 0 &&
                       state.number_lsb == bend_sensitivity;
    const int carry = cents ? 100 : 128;
    const int top = cents ? 9600 : 16383;
    const int size = is_coarse(state) ? 128 : 1;
    const int value = std::clamp(state.data_msb * carry + state.data_lsb + step * size, 0, top);
    state.data_msb = value / carry;
    state.data_lsb = value % carry;
    set_data(interpreter, channel, actions);
}

/// 127, 127 is the null number: data goes nowhere until the next selection.
void select(MidiChannel& state, DataTarget target, bool coarse, int value) {
    if (state.target != target) state.number_msb = state.number_lsb = 127;
    state.target = target;
    (coarse ? state.number_msb : state.number_lsb) = value;
    recall_data(state);
}

bool is_null(const MidiChannel& state) {
    return state.target == DataTarget::None || (state.number_msb == 127 && state.number_lsb == 127);
}

}  // namespace

void data_control(MidiInterpreter& interpreter, int channel, int controller, int value,
                  MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    switch (controller) {
        case 98:
        case 99:
            select(state, DataTarget::NonRegistered, controller == 99, value);
            return;
        case 100:
        case 101:
            select(state, DataTarget::Registered, controller == 101, value);
            return;
        default:
            break;
    }
    if (is_null(state)) return;
    const bool configuration = state.target == DataTarget::Registered && state.number_msb == 0 &&
                               state.number_lsb == mpe_configuration;
    if (configuration) {  // only its coarse half means anything, and only on a manager's channel
        const bool manager = channel == lower_manager || channel == upper_manager;
        if (controller == 6 && manager && value < static_cast<int>(midi_channel_count))
            configure_zone(interpreter, channel, value, actions);
        return;
    }
    if (controller == 96 || controller == 97) {
        step_data(interpreter, channel, controller == 96 ? 1 : -1, actions);
        return;
    }
    if (controller == 6) {
        state.data_msb = value;
        state.data_lsb = 0;
    } else {
        state.data_lsb = value;
    }
    set_data(interpreter, channel, actions);
}

}  // namespace jawari::host
