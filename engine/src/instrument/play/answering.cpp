#include "instrument/play/answering.h"

#include "instrument/model/played_string.h"
#include "instrument/play/control_targets.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/hands.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// The hand that damps what answers comes in this time [s].
constexpr double ease_s = 0.02;

/// How freely the string may answer, 0 to 1. Sympathetic strings have no damper. Of others the dampers lift
/// where there are none, or with the pedal.
double freedom_of(const InstrumentModel& model, const InstrumentState& state, std::size_t s) {
    const ChannelState& controls = channel_of(state, state.bridge.channel);
    return model.strings[s].sympathetic || controls.sustain ? 1.0 : model.bridge.open_strings;
}

/// A hand under which the first partial takes the string's release time without freedom, and longer with it.
void damp_answer(const InstrumentModel& model, const InstrumentState& state, std::size_t s, Voice& voice,
                 double freedom) {
    const bool damped = touch_at(voice.touches, TouchSlot::Left).active;
    if (freedom >= 1) {
        if (damped) lift_touch(voice.touches, TouchSlot::Left);
        return;
    }
    const InstrumentStringModel& string = string_of(model, state, s);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double x = place_on(stopped, model.hand.release_places[0], 1);
    const double damping = damping_for(stopped, x, string.release_t60_s / ((1 - freedom) * (1 - freedom)));
    if (damped) {
        press_touch(voice.touches, TouchSlot::Left, damping);
    } else {
        lay_touch(voice_model(string, voice), voice.string, voice.touches, TouchSlot::Left,
                  {.x_m = x, .damping_kg_per_s = damping, .ease_frames = ease_s * model.output_rate_hz});
    }
}

void begin_to_answer(const InstrumentModel& model, InstrumentState& state, std::size_t s, double freedom) {
    InstrumentStringState& string = state.strings[s];
    Voice& voice = string.voices[0];
    start_voice(model, string_of(model, state, s), voice, 0, state.bridge.channel,
                parameter_of(state, state.bridge.channel, ParameterId::Action));
    voice.phase = VoicePhase::Answering;
    voice.targets = gain_targets(model, state, s, voice.channel);
    voice.gains = voice.targets;
    damp_answer(model, state, s, voice, freedom);
    string.busy += 1;
}

}  // namespace

void follow_answers(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    BridgeState& bridge = state.bridge;
    bridge.drives = body_energy(model.bridge, bridge) > model.bridge.least_drive_J;
    const bool may_begin = bridge.drives && state.frame >= bridge.answers_from;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        const double freedom = freedom_of(model, state, s);
        if (string.busy == 0 && !string.pending.active) {
            const bool sounds = model.strings[s].stopped[0].string.shape->mode_count > 0;
            if (may_begin && freedom > 0 && sounds) begin_to_answer(model, state, s, freedom);
            continue;
        }
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Answering || voice.fading) continue;
            if (freedom == 0) voice.phase = VoicePhase::Damped;
            damp_answer(model, state, s, voice, freedom);
        }
    }
}

}  // namespace jawari
