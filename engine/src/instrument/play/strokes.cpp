#include "instrument/play/strokes.h"

#include <cmath>

#include "instrument/play/control_targets.h"
#include "instrument/touch/exciters.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/hands.h"
#include "instrument/voice/legato_transfer.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/events.h"

namespace jawari {
namespace {

std::size_t idle_voice(const InstrumentStringState& string) {
    for (std::size_t v = 0; v < string.voices.size(); ++v) {
        if (string.voices[v].phase == VoicePhase::Idle) return v;
    }
    return no_voice;
}

/// A voice that goes on at the fret.
std::size_t voice_at(const InstrumentStringState& string, std::size_t fret) {
    for (std::size_t v = 0; v < string.voices.size(); ++v) {
        const Voice& voice = string.voices[v];
        if (voice.phase != VoicePhase::Idle && !voice.fading && !voice.slide.active && voice.fret == fret)
            return v;
    }
    return no_voice;
}

void damp_sounding(const InstrumentModel& model, InstrumentState& state, std::size_t s, bool with_hand,
                   double release_velocity) {
    InstrumentStringState& string = state.strings[s];
    if (string.sounding == no_voice) return;
    Voice& voice = string.voices[string.sounding];
    string.sounding = no_voice;
    if (voice.phase != VoicePhase::Sounding) return;
    voice.phase = VoicePhase::Damped;
    voice.slide.active = false;
    if (!with_hand) return;
    const double time = parameter_of(state, voice.channel, ParameterId::ReleaseTime);
    lay_damping_hand(model, string_of(model, state, s), voice, release_velocity, time);
}

/// A string does one thing at a time: its earlier voices fade as a note begins, as under the finger or
/// plectrum that takes hold of the string.
void fade_damped(InstrumentStringState& string, InstrumentCounters& counters) {
    if (string.voices.size() == 1) return;
    for (Voice& voice : string.voices) {
        const bool earlier = voice.phase == VoicePhase::Damped || voice.phase == VoicePhase::Answering;
        if (!earlier || voice.fading) continue;
        fade_voice(voice);
        counters.faded_voices += 1;
    }
}

/// What the stopping hand and the palm do at the beginning of a note.
void lay_hands(const InstrumentModel& model, InstrumentState& state, std::size_t s, Voice& voice) {
    const InstrumentStringModel& string = string_of(model, state, s);
    const auto value = [&](ParameterId id) { return parameter_of(state, voice.channel, id); };
    lift_touch(voice.touches, TouchSlot::Left);
    const double dead = value(ParameterId::DeadNote);
    const auto harmonic = static_cast<int>(value(ParameterId::Harmonic));
    if (dead > 0) {
        deaden(model, string, voice, dead);
    } else if (harmonic > 1) {
        touch_node(model, string, voice, harmonic);
    }
    press_palm(model, string, voice, value(ParameterId::PalmMute), value(ParameterId::PalmPosition));
}

/// The voice has the note from now on.
Voice& take_note(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t v,
                 int channel) {
    InstrumentStringState& string = state.strings[s];
    Voice& voice = string.voices[v];
    voice.phase = VoicePhase::Sounding;
    voice.channel = channel;
    voice.targets = gain_targets(model, state, s, channel);
    state.bridge.channel = channel;
    if (!state.bridge.ringing) state.bridge.level = body_level(state, channel);
    string.sounding = v;
    string.pending.active = false;
    return voice;
}

/// A voice begins at rest at the stroke's fret.
Voice& wake_voice(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t v,
                  const Stroke& stroke) {
    InstrumentStringState& string = state.strings[s];
    start_voice(model, string_of(model, state, s), string.voices[v], stroke.fret, stroke.channel,
                parameter_of(state, stroke.channel, ParameterId::Action));
    string.busy += 1;
    state.busy = true;
    return string.voices[v];
}

/// The voice has at once the bend that its note and channel ask for.
void bend_at_once(const InstrumentModel& model, InstrumentState& state, std::size_t s, Voice& voice) {
    voice.bend.target = bend_target(model, state, s);
    set_bend(string_of(model, state, s).stopped[voice.fret], voice, voice.bend.target, state.work);
}

void start_from_rest(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t v,
                     const Stroke& stroke) {
    wake_voice(model, state, s, v, stroke);
    Voice& voice = take_note(model, state, s, v, stroke.channel);
    voice.gains = voice.targets;
    bend_at_once(model, state, s, voice);
}

void excite(const InstrumentModel& model, InstrumentState& state, std::size_t s, Voice& voice,
            const Stroke& stroke) {
    lay_hands(model, state, s, voice);
    strike_voice(model, string_of(model, state, s), voice, stroke,
                 parameter_of(state, stroke.channel, ParameterId::PluckPosition));
    state.counters.notes += 1;
}

void begin_stroke(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t v,
                  const Stroke& stroke) {
    start_from_rest(model, state, s, v, stroke);
    excite(model, state, s, state.strings[s].voices[v], stroke);
    fade_damped(state.strings[s], state.counters);
}

void wait_for_voice(InstrumentState& state, std::size_t s, const Stroke& stroke) {
    InstrumentStringState& string = state.strings[s];
    fade_damped(string, state.counters);
    if (string.pending.active) state.counters.ignored_notes += 1;
    string.pending = {.active = true, .delay = 0, .stroke = stroke};
    state.waiting = true;
    state.counters.delayed_notes += 1;
}

/// What a new voice takes over from the old one.
using Transfer = void (*)(const InstrumentStringModel&, const Voice&, Voice&, PlayerWork&);

/// The old voice fades while the new one, which has its motion, rises.
Voice& cross_over(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t v,
                  const Stroke& stroke, Transfer transfer) {
    InstrumentStringState& string = state.strings[s];
    Voice& old = string.voices[string.sounding];
    const VoiceGains gains = old.gains;
    old.phase = VoicePhase::Damped;
    old.slide.active = false;
    Voice& voice = wake_voice(model, state, s, v, stroke);
    transfer(string_of(model, state, s), old, voice, state.work);
    fade_voice(old);
    voice.rise_frame = 0;
    voice.age = 1;
    take_note(model, state, s, v, stroke.channel);
    voice.gains = gains;
    bend_at_once(model, state, s, voice);
    lay_hands(model, state, s, voice);
    state.counters.legato_notes += 1;
    return voice;
}

bool begin_slide(const InstrumentModel& model, InstrumentState& state, std::size_t s, const Stroke& stroke) {
    const double time_s = parameter_of(state, stroke.channel, ParameterId::SlideTime);
    if (!(time_s > 0)) return false;
    InstrumentStringState& string = state.strings[s];
    const InstrumentStringModel& strings = string_of(model, state, s);
    Voice& voice = string.voices[string.sounding];
    const double ratio = strings.stopped[stroke.fret].frequency_hz / strings.stopped[voice.fret].frequency_hz;
    const double begun = voice.slide.active ? voice.bend.semitones - voice.bend.target : 0;
    voice.slide = {.active = true,
                   .fret = stroke.fret,
                   .begun = begun,
                   .semitones = 12 * std::log2(ratio),
                   .frame = 0,
                   .frames = frames_of(time_s, model.output_rate_hz)};
    return true;
}

}  // namespace

void stroke_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                   const Stroke& stroke) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    const std::size_t same = voice_at(string, stroke.fret);
    if (same != no_voice) {
        if (string.sounding != same) damp_sounding(model, state, s, true, neutral_release_velocity);
        Voice& voice = take_note(model, state, s, same, stroke.channel);
        lift_damping_hand(voice);
        excite(model, state, s, voice, stroke);
        return;
    }
    damp_sounding(model, state, s, true, neutral_release_velocity);
    const std::size_t v = idle_voice(string);
    if (v == no_voice) {
        wait_for_voice(state, s, stroke);
    } else {
        begin_stroke(model, state, s, v, stroke);
    }
}

void continue_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                     const Stroke& stroke) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    const std::size_t v = idle_voice(string);
    const bool sounds = string.sounding != no_voice && !string.voices[string.sounding].fading;
    if (!sounds || v == no_voice || string.voices[string.sounding].fret == stroke.fret) {
        stroke_string(model, state, s, stroke);
        return;
    }
    if (begin_slide(model, state, s, stroke)) return;
    Voice& voice = cross_over(model, state, s, v, stroke, carry_over);
    Stroke lighter = stroke;
    lighter.velocity *= model.hand.legato_level;
    if (lighter.velocity > 0) {
        strike_voice(model, string_of(model, state, s), voice, lighter,
                     parameter_of(state, stroke.channel, ParameterId::PluckPosition));
        lift_touch(voice.touches, TouchSlot::Finger);  // nothing lies on the string before
    }
    fade_damped(string, state.counters);
}

void arrive(const InstrumentModel& model, InstrumentState& state, std::size_t s) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    const std::size_t v = idle_voice(string);
    if (v == no_voice) {  // stays at the slide's end until there is one
        fade_damped(string, state.counters);
        return;
    }
    const Voice& voice = string.voices[string.sounding];
    Stroke stroke;
    stroke.fret = voice.slide.fret;
    stroke.channel = voice.channel;
    cross_over(model, state, s, v, stroke, keep_partials);
    fade_damped(string, state.counters);
}

void release_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                    double release_velocity) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    if (string.pending.active) {
        string.pending.active = false;
        state.counters.ignored_notes += 1;
    }
    damp_sounding(model, state, s, model.hand.damps, release_velocity);
}

void silence_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                    int channel) JAWARI_REALTIME {
    InstrumentStringState& string = state.strings[s];
    if (string.pending.active && string.pending.stroke.channel == channel) {
        string.pending.active = false;
        state.counters.ignored_notes += 1;
    }
    for (Voice& voice : string.voices) {
        if (voice.phase != VoicePhase::Idle && voice.channel == channel) fade_voice(voice);
    }
    if (string.sounding != no_voice && string.voices[string.sounding].channel == channel)
        damp_sounding(model, state, s, false, neutral_release_velocity);
}

void start_pending_strokes(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    if (state.strokes_until > state.frame) return;
    state.strokes_until = state.frame + 1;
    if (!state.waiting) return;
    bool waiting = false;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        if (!string.pending.active) continue;
        waiting = true;
        if (string.pending.delay > 0) {
            string.pending.delay -= 1;
            continue;
        }
        const Stroke stroke = string.pending.stroke;
        const std::size_t v = idle_voice(string);
        if (v != no_voice || voice_at(string, stroke.fret) != no_voice) {
            string.pending.active = false;
            stroke_string(model, state, s, stroke);
        }
    }
    state.waiting = waiting;
}

}  // namespace jawari
