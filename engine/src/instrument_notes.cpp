#include "instrument_notes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "instrument_voice.h"

namespace jawari {
namespace {

constexpr std::size_t no_string = std::numeric_limits<std::size_t>::max();

// ---------------------------------------------------------------------------------------------- choosing a
// string

bool has_note(const InstrumentStringModel& string, int key) {
    return key >= string.open_note && key < string.open_note + static_cast<int>(string.stopped.size());
}

std::size_t fret_of(const InstrumentStringModel& string, int key) {
    return static_cast<std::size_t>(key - string.open_note);
}

std::size_t string_holding(const InstrumentState& state, int channel, int key) {
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const HeldNote& held = state.strings[s].held;
        if (held.active && held.channel == channel && held.key == key) return s;
    }
    return no_string;
}

/// Smaller is better: free, then held by the pedal alone, then held by a key.
int occupation(const HeldNote& held) {
    if (!held.active) return 0;
    return held.key_down ? 2 : 1;
}

bool is_better(const InstrumentModel& model, const InstrumentState& state, std::size_t candidate,
               std::size_t best, int key) {
    if (best == no_string) return true;
    const HeldNote& a = state.strings[candidate].held;
    const HeldNote& b = state.strings[best].held;
    if (occupation(a) != occupation(b)) return occupation(a) < occupation(b);
    if (!a.active) return fret_of(model.strings[candidate], key) < fret_of(model.strings[best], key);
    return a.order < b.order;
}

std::size_t choose_string(const InstrumentModel& model, const InstrumentState& state, int channel, int key) {
    const std::size_t holding = string_holding(state, channel, key);
    if (holding != no_string) return holding;
    std::size_t best = no_string;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        if (has_note(model.strings[s], key) && is_better(model, state, s, best, key)) best = s;
    }
    return best;
}

// ---------------------------------------------------------------------------------------------- voices of a
// string

std::size_t idle_voice(const InstrumentStringState& string) {
    for (std::size_t v = 0; v < voices_per_string; ++v) {
        if (string.voices[v].phase == VoicePhase::Idle) return v;
    }
    return no_voice;
}

void damp_sounding(const InstrumentStringModel& model, InstrumentStringState& string) {
    if (string.sounding == no_voice) return;
    Voice& voice = string.voices[string.sounding];
    if (voice.phase == VoicePhase::Sounding) damp_voice(model, voice);
    string.sounding = no_voice;
}

/// Keeps a voice free for the next note: fades the quietest damped one if none is idle or on its way there.
void make_room(const InstrumentStringModel& model, InstrumentStringState& string,
               InstrumentCounters& counters) {
    Voice* quietest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Voice& voice : string.voices) {
        if (voice.phase == VoicePhase::Idle || voice.fading) return;
        if (voice.phase != VoicePhase::Damped) continue;
        const double energy = voice_energy(model, voice);
        if (energy < least) {
            least = energy;
            quietest = &voice;
        }
    }
    if (quietest == nullptr) return;
    fade_voice(*quietest);
    counters.faded_voices += 1;
}

void start_note(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t voice,
                std::size_t fret, double velocity) {
    InstrumentStringState& string = state.strings[s];
    start_voice(model, model.strings[s], string.voices[voice], fret, velocity);
    string.sounding = voice;
    string.pending.active = false;
    state.counters.notes += 1;
    make_room(model.strings[s], string, state.counters);
}

void pluck(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t fret,
           double velocity) {
    InstrumentStringState& string = state.strings[s];
    damp_sounding(model.strings[s], string);
    const std::size_t voice = idle_voice(string);
    if (voice != no_voice) {
        start_note(model, state, s, voice, fret, velocity);
        return;
    }
    make_room(model.strings[s], string, state.counters);
    if (string.pending.active) state.counters.ignored_notes += 1;
    string.pending = {.active = true, .fret = fret, .velocity = velocity};
    state.counters.delayed_notes += 1;
}

// ---------------------------------------------------------------------------------------------- events

void release(const InstrumentStringModel& model, InstrumentStringState& string,
             InstrumentCounters& counters) {
    if (string.pending.active) {
        string.pending.active = false;
        counters.ignored_notes += 1;
    }
    damp_sounding(model, string);
    string.held.active = false;
}

void note_on(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event) {
    const std::size_t s = choose_string(model, state, event.channel, event.key);
    if (s == no_string) {
        state.counters.ignored_notes += 1;
        return;
    }
    HeldNote& held = state.strings[s].held;
    if (held.active && (held.channel != event.channel || held.key != event.key))
        state.counters.stolen_notes += 1;
    held = {.active = true,
            .key_down = true,
            .channel = event.channel,
            .key = event.key,
            .order = state.note_order++};
    pluck(model, state, s, fret_of(model.strings[s], event.key), event.value);
}

/// The key goes up: the pedal may hold the note on.
void lift_key(const InstrumentModel& model, InstrumentState& state, std::size_t s) {
    HeldNote& held = state.strings[s].held;
    held.key_down = false;
    if (!state.sustain[static_cast<std::size_t>(held.channel)]) {
        release(model.strings[s], state.strings[s], state.counters);
    }
}

void note_off(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event) {
    const std::size_t s = string_holding(state, event.channel, event.key);
    if (s != no_string && state.strings[s].held.key_down) lift_key(model, state, s);
}

void set_sustain(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event) {
    const bool down = event.value >= 0.5;
    state.sustain[static_cast<std::size_t>(event.channel)] = down;
    if (down) return;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const HeldNote& held = state.strings[s].held;
        if (held.active && !held.key_down && held.channel == event.channel) {
            release(model.strings[s], state.strings[s], state.counters);
        }
    }
}

void all_notes_off(const InstrumentModel& model, InstrumentState& state, int channel) {
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const HeldNote& held = state.strings[s].held;
        if (held.active && held.key_down && held.channel == channel) lift_key(model, state, s);
    }
}

void all_sound_off(const InstrumentModel& model, InstrumentState& state, int channel) {
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        if (string.held.active && string.held.channel != channel) continue;
        release(model.strings[s], string, state.counters);
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) fade_voice(voice);
        }
    }
}

bool is_valid(const InstrumentEvent& event) {
    return event.channel >= 0 && event.channel < midi_channels && event.key >= 0 && event.key <= 127 &&
           event.value >= 0 && event.value <= 1;  // false for NaN
}

}  // namespace

void apply_event(const InstrumentModel& model, InstrumentState& state,
                 const InstrumentEvent& event) JAWARI_REALTIME {
    if (!is_valid(event)) return;
    switch (event.type) {
        case InstrumentEventType::NoteOn:
            if (event.value > 0) {
                note_on(model, state, event);
                break;
            }
            [[fallthrough]];
        case InstrumentEventType::NoteOff:
            note_off(model, state, event);
            break;
        case InstrumentEventType::Sustain:
            set_sustain(model, state, event);
            break;
        case InstrumentEventType::AllNotesOff:
            all_notes_off(model, state, event.channel);
            break;
        case InstrumentEventType::AllSoundOff:
            all_sound_off(model, state, event.channel);
            break;
        default:
            break;
    }
}

void start_pending_notes(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        if (!string.pending.active) continue;
        const std::size_t voice = idle_voice(string);
        if (voice != no_voice)
            start_note(model, state, s, voice, string.pending.fret, string.pending.velocity);
    }
}

}  // namespace jawari
