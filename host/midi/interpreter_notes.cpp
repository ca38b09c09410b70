// Notes: which note-off ends which, where a key sounds, and the sostenuto pedal.
#include <algorithm>
#include <cmath>
#include <limits>

#include "midi/interpreter_controllers.h"
#include "midi/interpreter_expressions.h"

namespace jawari::host {

namespace {

constexpr int highest_key = static_cast<int>(midi_key_count) - 1;

/// Velocity with the 14 bits of controller 88 (CA-031) if that came just before.
double take_velocity(MidiChannel& channel, int value) {
    const bool fine = channel.has_velocity_lsb;
    channel.has_velocity_lsb = false;
    return fine ? (value * 128 + channel.velocity_lsb) / 16383.0 : value / 127.0;
}

int forced_string(const InterpreterSettings& settings, int channel) {
    if (!in_guitar(settings, channel)) return -1;
    return settings.guitar_string[static_cast<std::size_t>(channel - settings.guitar_channel)];
}

/// Where a key sounds, in keys of the instrument. Drums have no pitch to tune.
double tuned_key(const MidiInterpreter& interpreter, int channel, int key) {
    const MidiChannel& state = interpreter.channels[static_cast<std::size_t>(channel)];
    if (state.unpitched) return key;
    const int leader = part_channel(interpreter, channel);
    const int coarse = interpreter.channels[static_cast<std::size_t>(leader)].coarse_tuning_semitones;
    const MidiTunings& tunings = interpreter.tunings;
    const auto program = static_cast<std::size_t>(state.tuning_program);
    const auto at = static_cast<std::size_t>(key);
    const auto tuned = static_cast<double>(tunings.keys[program][at]) +
                       static_cast<double>(tunings.classes[static_cast<std::size_t>(channel)][at % 12]);
    return key + coarse + interpreter.master_coarse_semitones + interpreter.settings.transpose_semitones +
           tuned;
}

void end_note(MidiInterpreter& interpreter, int channel, int key, double release, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    const auto at = static_cast<std::size_t>(key);
    state.let_go[at] = false;
    add_event(actions, jawari::note_off(0, state.sounds[at], release, channel));
}

void note_off(MidiInterpreter& interpreter, int channel, int key, double release, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    const auto at = static_cast<std::size_t>(key);
    if (state.open[at] == 0 && state.let_go[at]) return;
    if (state.open[at] > 0) state.open[at] -= 1;
    if (state.open[at] > 0) return;  // an older note of this key ends; on its string the latest one sounds
    if (state.mono_key == key) state.mono_key = -1;
    if (state.kept[at]) {
        state.let_go[at] = true;
    } else {
        end_note(interpreter, channel, key, release, actions);
    }
}

/// What a note sounds above its key of the instrument besides the channel's bend [semitones].
double above_key(const MidiChannel& channel, std::size_t key) {
    return static_cast<double>(channel.off_key[key]) + static_cast<double>(channel.expressed[key]);
}

/// A note that is off the instrument's keys begins at its own pitch: the channel has it for that moment.
void add_note_on(const MidiInterpreter& interpreter, int channel, int key, double velocity,
                 MidiActions& actions) {
    const MidiChannel& state = interpreter.channels[static_cast<std::size_t>(channel)];
    const int sounds = state.sounds[static_cast<std::size_t>(key)];
    const auto off_key = static_cast<double>(state.off_key[static_cast<std::size_t>(key)]);
    const double bend = whole_bend(interpreter, channel);
    const double own = std::clamp(bend + off_key, -96.0, 96.0);
    if (off_key != 0) add_event(actions, bend_channel(0, own, channel));
    add_event(actions, {.type = InstrumentEventType::NoteOn,
                        .channel = channel,
                        .key = sounds,
                        .value = velocity,
                        .string = forced_string(interpreter.settings, channel)});
    if (off_key == 0) return;
    add_event(actions, bend_channel(0, bend, channel));
    add_event(actions, bend_note(0, sounds, own, channel));
}

/// Where the key sounds from now on. False if the instrument has no such key.
bool place_key(MidiInterpreter& interpreter, int channel, int key, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    const auto at = static_cast<std::size_t>(key);
    const double tuned = tuned_key(interpreter, channel, key);
    const int sounds = static_cast<int>(std::lround(tuned));
    const bool down = state.open[at] > 0 || state.let_go[at];
    if (down && sounds != state.sounds[at]) {  // nobody could end the note there any more
        end_note(interpreter, channel, key, neutral_release_velocity, actions);
    }
    if (sounds < 0 || sounds > highest_key) return false;
    state.sounds[at] = static_cast<std::uint8_t>(sounds);
    state.off_key[at] = static_cast<float>(tuned - sounds);
    state.expressed[at] = 0;
    state.expresses[at] = false;
    return true;
}

/// After the new note, so that the instrument sees them overlap: legato is its affair.
void end_mono_key(MidiInterpreter& interpreter, int channel, int key, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    state.kept[static_cast<std::size_t>(key)] = false;
    end_note(interpreter, channel, key, neutral_release_velocity, actions);
}

/// The key of controller 84 is still down.
bool slides_from(const MidiChannel& state, int key) {
    return state.glide_from >= 0 && state.glide_from != key &&
           state.open[static_cast<std::size_t>(state.glide_from)] > 0;
}

/// One note slides from another, which it ends, whatever the mode and the portamento switch.
void add_slide(MidiInterpreter& interpreter, int channel, int key, double velocity, MidiActions& actions) {
    MidiChannel& state = channel_state(interpreter, channel);
    const int from = state.glide_from;
    add_event(actions, set_parameter(0, ParameterId::Legato, 1, channel));
    add_event(actions, set_parameter(0, ParameterId::SlideTime, portamento_s(state), channel));
    add_note_on(interpreter, channel, key, velocity, actions);
    state.open[static_cast<std::size_t>(from)] = 0;
    if (state.mono_key == from) state.mono_key = -1;
    end_mono_key(interpreter, channel, from, actions);
    add_portamento(interpreter, channel, actions);
}

}  // namespace

void note_on_message(MidiInterpreter& interpreter, int channel, int key, int velocity,
                     MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    if (velocity == 0) {
        state.has_velocity_lsb = false;
        note_off(interpreter, channel, key, 0.5, actions);
        return;
    }
    start_note(interpreter, channel, key, take_velocity(state, velocity), actions);
}

void start_note(MidiInterpreter& interpreter, int channel, int key, double velocity,
                MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    if (!place_key(interpreter, channel, key, actions)) {
        actions.ignored = true;
        return;
    }
    const auto at = static_cast<std::size_t>(key);
    if (state.open[at] < std::numeric_limits<std::uint8_t>::max()) state.open[at] += 1;
    state.let_go[at] = false;
    if (slides_from(state, key)) {
        add_slide(interpreter, channel, key, velocity, actions);
    } else {
        add_note_on(interpreter, channel, key, velocity, actions);
    }
    state.glide_from = -1;
    const int before = state.mono_key;
    state.mono_key = key;
    if (state.mono && before >= 0 && before != key) end_mono_key(interpreter, channel, before, actions);
}

void release_note(MidiInterpreter& interpreter, int channel, int key, double release,
                  MidiActions& actions) JAWARI_REALTIME {
    note_off(interpreter, channel, key, release, actions);
}

void tune_note(MidiInterpreter& interpreter, int channel, int key, double semitones,
               MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    const auto at = static_cast<std::size_t>(key);
    if (state.open[at] == 0 && !state.let_go[at]) return;
    state.expressed[at] = static_cast<float>(semitones);
    state.expresses[at] = true;
    const double own = std::clamp(whole_bend(interpreter, channel) + above_key(state, at), -96.0, 96.0);
    add_event(actions, bend_note(0, state.sounds[at], own, channel));
}

void note_off_message(MidiInterpreter& interpreter, int channel, int key, int velocity,
                      MidiActions& actions) JAWARI_REALTIME {
    const double release = take_velocity(channel_state(interpreter, channel), velocity);
    note_off(interpreter, channel, key, release, actions);
}

void forget_notes(MidiChannel& channel) JAWARI_REALTIME {
    channel.mono_key = channel.glide_from = -1;
    channel.open.fill(0);
    channel.kept.reset();
    channel.let_go.reset();
}

void set_sostenuto(MidiInterpreter& interpreter, int channel, bool down,
                   MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    if (state.sostenuto == down) return;
    state.sostenuto = down;
    for (std::size_t key = 0; key < midi_key_count; ++key) {
        if (down) {
            state.kept[key] = state.open[key] > 0;
            continue;
        }
        if (state.let_go[key])
            end_note(interpreter, channel, static_cast<int>(key), neutral_release_velocity, actions);
        state.kept[key] = false;
    }
}

void add_key_bends(const MidiInterpreter& interpreter, int channel, double bend,
                   MidiActions& actions) JAWARI_REALTIME {
    const MidiChannel& state = interpreter.channels[static_cast<std::size_t>(channel)];
    for (std::size_t key = 0; key < midi_key_count; ++key) {
        const bool sounds = state.open[key] > 0 || state.let_go[key];
        if (!sounds || (state.off_key[key] == 0 && !state.expresses[key])) continue;
        const double own = std::clamp(bend + above_key(state, key), -96.0, 96.0);
        add_event(actions, bend_note(0, state.sounds[key], own, channel));
    }
}

void retune_notes(MidiInterpreter& interpreter, int channel, MidiActions& actions) JAWARI_REALTIME {
    MidiChannel& state = channel_state(interpreter, channel);
    const double bend = whole_bend(interpreter, channel);
    for (std::size_t key = 0; key < midi_key_count; ++key) {
        if (state.open[key] == 0 && !state.let_go[key]) continue;
        const double tuned = tuned_key(interpreter, channel, static_cast<int>(key));
        const auto off_key = static_cast<float>(tuned - state.sounds[key]);
        if (off_key == state.off_key[key]) continue;
        state.off_key[key] = off_key;
        const double own = std::clamp(bend + above_key(state, key), -96.0, 96.0);
        add_event(actions, bend_note(0, state.sounds[key], own, channel));
    }
}

}  // namespace jawari::host
