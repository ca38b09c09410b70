#include "instrument/play/steady_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "instrument/model/played_string.h"
#include "instrument/play/control_targets.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_frame.h"
#include "instrument/voice/bridge_kernels.h"
#include "instrument/voice/coupled_voice.h"
#include "instrument/voice/end_run.h"
#include "instrument/voice/voice_run.h"

namespace jawari {
namespace {

using RunSignals = std::array<VoiceSignals, longest_end_run>;

/// Steady frames that are passed at a time.
struct SteadySpan {
    std::size_t first = 0;  ///< frame of the block's run
    std::size_t frames = 0;
    std::uint64_t frame = 0;  ///< InstrumentState::frame of the first
};

/// How many of the next `most` frames are steady as far as can be told now; sets what they have in common.
std::size_t find_steady_frames(const InstrumentModel& model, InstrumentState& state, std::size_t most) {
    BridgeState& bridge = state.bridge;
    if (state.waiting || bridge.voice_count == 0) return 0;
    std::size_t frames = most;
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        VoiceOnBridge& on_bridge = bridge.voices[i];
        Voice& voice = state.strings[on_bridge.string].voices[on_bridge.voice];
        if (!goes_on_steadily(model, string_of(model, state, on_bridge.string), voice, on_bridge)) return 0;
        frames = std::min(frames, voice.run.frames - voice.run.passed);
    }
    return frames;
}

/// Returns false, and no voice or body has moved, if a string might be brought to an obstacle.
bool pass_steady_frame(const InstrumentModel& model, InstrumentState& state, std::size_t strings) {
    BridgeState& bridge = state.bridge;
    const auto voice_of = [&](const VoiceOnBridge& on_bridge) -> Voice& {
        return state.strings[on_bridge.string].voices[on_bridge.voice];
    };
    begin_bridge_frame(model.bridge, bridge);
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        VoiceOnBridge& on_bridge = bridge.voices[i];
        set_force_in_run(voice_of(on_bridge).run, on_bridge.rest_N, on_bridge.frame);
    }
    solve_bridge_frame(model, state);
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        if (!may_pass_in_run(voice_of(bridge.voices[i]).run, bridge.voices[i].zeta_m)) return false;
    }
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        const VoiceOnBridge& on_bridge = bridge.voices[i];
        Voice& voice = voice_of(on_bridge);
        pass_in_run(voice_model(string_of(model, state, on_bridge.string), voice), voice, on_bridge.zeta_m);
    }
    for (std::size_t s = 0; s < strings; ++s) advance_body_of_string(model.bridge, bridge, s);
    end_bridge_frame(model.bridge, bridge);
    return true;
}

/// Voices have passed the span: ends runs that are over, and adds what the outputs get.
void add_signals_of(const InstrumentModel& model, InstrumentState& state, const VoiceOnBridge& on_bridge,
                    double smoothing, const SteadySpan& span, RunSignals& sums) {
    const InstrumentStringModel& string = string_of(model, state, on_bridge.string);
    Voice& voice = state.strings[on_bridge.string].voices[on_bridge.voice];
    EndRun& of = voice.run;
    OutputReadings readings;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    read_run(of, of.passed + 1 - span.frames, span.frames, readings);
    voice.end.force_N = of.readings[of.passed] - on_bridge.rest_N;
    const std::uint64_t resets = voice.string.counters.nonfinite_resets;
    if (of.passed == of.frames) settle_run(voice_model(string, voice), voice);
    const std::uint64_t resets_at_end = voice.string.counters.nonfinite_resets;
    if (resets_at_end != resets) voice.end.force_N = 0;
    VoiceRun run{model, string, voice, smoothing, state, readings, span.frame};
    for (std::size_t n = 0; n < span.frames && voice.phase != VoicePhase::Idle; ++n)
        add_signals(run, n, n + 1 < span.frames ? resets_at_end : resets, sums[n]);
}

/// What string s gives by itself.
void write_signals(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                   const StringOutputs& outputs, const SteadySpan& span, const RunSignals& sums) {
    double* out = outputs.strings[s] + outputs.first + span.first;
    for (std::size_t n = 0; n < span.frames; ++n) {
        out[n] += sums[n].pickups;
        if (state.string_bodies.empty()) continue;
        const StereoSample body = advance_body(model.body, state.string_bodies[s], sums[n].bridge_N);
        out[n] += (body.left + body.right) / 2;
    }
}

void add_strings(const InstrumentModel& model, InstrumentState& state, const StringOutputs& outputs,
                 double smoothing, const SteadySpan& span, const StereoRun& run) {
    BridgeState& bridge = state.bridge;
    const std::size_t heard = outputs.strings.empty() ? bridge.sounding.size() : state.strings.size();
    std::size_t next = 0;
    for (std::size_t i = 0; i < heard; ++i) {
        const std::size_t s = outputs.strings.empty() ? bridge.sounding[i] : i;
        RunSignals sums{};
        for (; next < bridge.voice_count && bridge.voices[next].string == s; ++next)
            add_signals_of(model, state, bridge.voices[next], smoothing, span, sums);
        for (std::size_t n = 0; n < span.frames; ++n) {
            run.left[span.first + n] += sums[n].left;
            run.right[span.first + n] += sums[n].right;
            run.bridge_N[span.first + n] += sums[n].bridge_N;
        }
        if (!outputs.strings.empty()) write_signals(model, state, s, outputs, span, sums);
    }
}

}  // namespace

std::size_t pass_steady_frames(const InstrumentModel& model, InstrumentState& state,
                               const StringOutputs& outputs, double smoothing, std::size_t n,
                               const StereoRun& run) JAWARI_REALTIME {
    BridgeState& bridge = state.bridge;
    SteadySpan span{n, 0, state.frame};
    const std::size_t most = find_steady_frames(model, state, run.frames - n);
    for (; span.frames < most && pass_steady_frame(model, state, outputs.strings.size()); ++span.frames) {
        const std::size_t at = n + span.frames;
        follow_level(state, smoothing);
        hear_strings(model.bridge, bridge, outputs, at);
        const kernels::BodyMotion moving = kernels::hear_body(model.bridge, bridge.v.data());
        run.left[at] += bridge.level * moving.left;
        run.right[at] += bridge.level * moving.right;
        state.frame += 1;
    }
    if (span.frames > 0) add_strings(model, state, outputs, smoothing, span, run);
    return span.frames;
}

}  // namespace jawari
