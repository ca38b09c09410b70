#include "instrument/play/coupled_frames.h"

#include <algorithm>

#include "instrument/model/played_string.h"
#include "instrument/play/control_targets.h"
#include "instrument/play/impacts.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_frame.h"
#include "instrument/voice/coupled_voice.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// BridgeState::voices <- the voices that are not idle, by string and voice.
void find_voices(InstrumentState& state) {
    BridgeState& bridge = state.bridge;
    bridge.voice_count = 0;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const InstrumentStringState& string = state.strings[s];
        for (std::size_t v = 0; string.busy > 0 && v < string.voices.size(); ++v) {
            if (string.voices[v].phase == VoicePhase::Idle) continue;
            VoiceOnBridge& voice = bridge.voices[bridge.voice_count++];
            voice.string = s;
            voice.voice = v;
            voice.left_N = 0;
        }
    }
}

/// The factor of the body's sound follows volume, expression and body mix of the last note's channel.
void follow_level(InstrumentState& state, double smoothing) {
    const double target = body_level(state, state.bridge.channel);
    state.bridge.level += smoothing * (target - state.bridge.level);
}

/// Voices cross the frame; string by string, what they give is added up.
void end_voices(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                double smoothing, std::size_t n, const StereoRun& run) {
    BridgeState& bridge = state.bridge;
    std::size_t next = 0;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        VoiceSignals signals;
        for (; next < bridge.voice_count && bridge.voices[next].string == s; ++next) {
            VoiceOnBridge& on_bridge = bridge.voices[next];
            const Voice& voice = state.strings[s].voices[on_bridge.voice];
            const std::uint64_t impulses = voice.string.counters.impulses;
            end_coupled_frame(model, state, on_bridge, smoothing, signals);
            if (state.impacts.open && voice.string.counters.impulses != impulses)
                log_impacts(string_of(model, state, s), voice, s, state.impacts);
        }
        run.left[n] += signals.left;
        run.right[n] += signals.right;
        run.bridge_N[n] += signals.bridge_N;
        if (s >= outputs.strings.size()) continue;
        outputs.strings[s][outputs.first + n] = signals.pickups;
        if (state.string_bodies.empty()) continue;
        const StereoSample body = advance_body(model.body, state.string_bodies[s], signals.bridge_N);
        outputs.strings[s][outputs.first + n] += (body.left + body.right) / 2;
    }
}

/// Adds to each string's output what of the body's motion it has caused, in the mean of both channels.
void hear_strings(const BridgeModel& bridge, const BridgeState& state, const StringOutputs& outputs,
                  std::size_t n) {
    for (std::size_t s = 0; s < outputs.strings.size(); ++s) {
        const double* v = state.v_of.data() + s * bridge.stride;
        double sum = 0;
        for (std::size_t j = 0; j < bridge.count; ++j)
            sum += (bridge.gain_left[j] + bridge.gain_right[j]) / 2 * v[j];
        outputs.strings[s][outputs.first + n] += state.level * sum;
    }
}

/// Voices that have ended leave the bridge.
void let_go(const InstrumentModel& model, InstrumentState& state) {
    const BridgeState& bridge = state.bridge;
    state.busy = false;
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        const VoiceOnBridge& on_bridge = bridge.voices[i];
        InstrumentStringState& string = state.strings[on_bridge.string];
        if (string.voices[on_bridge.voice].phase != VoicePhase::Idle) {
            state.busy = true;
            continue;
        }
        leave_bridge(model, state, on_bridge);
        string.busy -= 1;
        if (string.sounding == on_bridge.voice) string.sounding = no_voice;
    }
}

void hear_body(const BridgeModel& bridge, const BridgeState& state, double& left, double& right) {
    double of_left = 0, of_right = 0;
    for (std::size_t j = 0; j < bridge.count; ++j) {
        of_left += bridge.gain_left[j] * state.v[j];
        of_right += bridge.gain_right[j] * state.v[j];
    }
    left += state.level * of_left;
    right += state.level * of_right;
}

bool is_still(const InstrumentState& state) {
    return !state.busy && !state.bridge.ringing && !state.body.ringing;
}

}  // namespace

void advance_coupled(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                     double smoothing, const StereoRun& run) JAWARI_REALTIME {
    BridgeState& bridge = state.bridge;
    bridge.separates = !outputs.strings.empty();
    for (std::size_t n = 0; n < run.frames; ++n, ++state.frame) {
        follow_level(state, smoothing);
        if (is_still(state)) {
            for (double* string : outputs.strings) string[outputs.first + n] = 0;
            continue;
        }
        find_voices(state);
        begin_bridge_frame(model.bridge, bridge);
        for (std::size_t i = 0; i < bridge.voice_count; ++i)
            begin_coupled_frame(model, state, bridge.voices[i]);
        solve_bridge_frame(model, state);
        end_voices(model, state, outputs, smoothing, n, run);
        for (std::size_t s = 0; s < outputs.strings.size(); ++s)
            advance_body_of_string(model.bridge, bridge, s);
        end_bridge_frame(model.bridge, bridge);
        hear_strings(model.bridge, bridge, outputs, n);
        let_go(model, state);
        hear_body(model.bridge, bridge, run.left[n], run.right[n]);
        const StereoSample body = advance_body(model.body, state.body, run.bridge_N[n]);
        run.left[n] += body.left;
        run.right[n] += body.right;
    }
}

}  // namespace jawari
