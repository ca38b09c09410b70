#include "instrument/play/coupled_frames.h"

#include <algorithm>

#include "instrument/model/played_string.h"
#include "instrument/play/control_targets.h"
#include "instrument/play/impacts.h"
#include "instrument/play/steady_frames.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_frame.h"
#include "instrument/voice/bridge_kernels.h"
#include "instrument/voice/coupled_voice.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// BridgeState::voices <- the voices that are not idle, by string and voice.
void find_voices(InstrumentState& state) {
    BridgeState& bridge = state.bridge;
    bridge.voice_count = 0;
    bridge.sounding.clear();
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const InstrumentStringState& string = state.strings[s];
        if (string.busy == 0) continue;
        bridge.sounding.push(s);
        for (std::size_t v = 0; v < string.voices.size(); ++v) {
            if (string.voices[v].phase == VoicePhase::Idle) continue;
            VoiceOnBridge& voice = bridge.voices[bridge.voice_count++];
            voice.string = s;
            voice.voice = v;
            voice.left_N = 0;
        }
    }
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
        outputs.strings[s][outputs.first + n] += signals.pickups;
        if (state.string_bodies.empty()) continue;
        const StereoSample body = advance_body(model.body, state.string_bodies[s], signals.bridge_N);
        outputs.strings[s][outputs.first + n] += (body.left + body.right) / 2;
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

bool is_still(const InstrumentState& state) {
    return !state.busy && !state.bridge.ringing && !state.body.ringing;
}

/// Frame n, voice by voice.
void pass_frame(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                double smoothing, std::size_t n, const StereoRun& run) {
    BridgeState& bridge = state.bridge;
    follow_level(state, smoothing);
    begin_bridge_frame(model.bridge, bridge);
    for (std::size_t i = 0; i < bridge.voice_count; ++i) begin_coupled_frame(model, state, bridge.voices[i]);
    solve_bridge_frame(model, state);
    end_voices(model, state, outputs, smoothing, n, run);
    for (std::size_t s = 0; s < outputs.strings.size(); ++s) advance_body_of_string(model.bridge, bridge, s);
    end_bridge_frame(model.bridge, bridge);
    hear_strings(model.bridge, bridge, outputs, n);
    const kernels::BodyMotion moving = kernels::hear_body(model.bridge, bridge.v.data());
    run.left[n] += bridge.level * moving.left;
    run.right[n] += bridge.level * moving.right;
    state.frame += 1;
}

}  // namespace

void follow_level(InstrumentState& state, double smoothing) JAWARI_REALTIME {
    const double target = body_level(state, state.bridge.channel);
    state.bridge.level += smoothing * (target - state.bridge.level);
}

void hear_strings(const BridgeModel& bridge, const BridgeState& state, const StringOutputs& outputs,
                  std::size_t n) JAWARI_REALTIME {
    for (std::size_t s = 0; s < outputs.strings.size(); ++s) {
        const double* v = state.v_of.data() + s * bridge.stride;
        double sum = 0;
        for (std::size_t j = 0; j < bridge.count; ++j)
            sum += (bridge.gain_left[j] + bridge.gain_right[j]) / 2 * v[j];
        outputs.strings[s][outputs.first + n] += state.level * sum;
    }
}

void advance_coupled(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                     double smoothing, const StereoRun& run) JAWARI_REALTIME {
    BridgeState& bridge = state.bridge;
    bridge.separates = !outputs.strings.empty();
    for (double* string : outputs.strings) std::fill_n(string + outputs.first, run.frames, 0.0);
    for (std::size_t n = 0; n < run.frames;) {
        if (is_still(state)) {
            follow_level(state, smoothing);
            ++n;
            ++state.frame;
            continue;
        }
        find_voices(state);
        std::size_t passed = pass_steady_frames(model, state, outputs, smoothing, n, run);
        if (passed == 0) {
            pass_frame(model, state, outputs, smoothing, n, run);
            passed = 1;
        }
        let_go(model, state);
        for (const std::size_t end = n + passed; n < end; ++n) {
            const StereoSample body = advance_body(model.body, state.body, run.bridge_N[n]);
            run.left[n] += body.left;
            run.right[n] += body.right;
        }
    }
}

}  // namespace jawari
