// A frame of a moving bridge in as many unknowns as there are voices: modes are many, voices few.
#include <algorithm>
#include <array>

#include "instrument/model/played_string.h"
#include "instrument/touch/bridge_end.h"
#include "instrument/voice/bridge_solve.h"

namespace jawari {
namespace {

/// Whether the factor is that of the voices as they are; notes what they are.
bool is_factorised(BridgeState& state) {
    const auto order = static_cast<double>(state.voice_count);
    bool same = state.factorised[0] == order;
    state.factorised[0] = order;
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        const std::array<double, 3> now{static_cast<double>(voice.string), voice.weight,
                                        voice.frame.stiffness_N_per_m};
        double* known = state.factorised.data() + 1 + now.size() * i;
        same = same && std::equal(now.begin(), now.end(), known);
        std::copy(now.begin(), now.end(), known);
    }
    return same;
}

/// The system over the voices' forces F: (1/stiffness + weight receptance weight/2) F = force/stiffness -
/// zeta of free motion. Its matrix is positive definite too.
void prepare_voices(const BridgeModel& bridge, BridgeState& state) {
    state.stale = true;  // the factor is no longer that of the modes
    if (is_factorised(state)) return;
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        double* row = state.matrix.data() + i * bridge.stride;
        const double* receptance = bridge.receptance.data() + voice.string * bridge.string_stride;
        for (std::size_t l = 0; l <= i; ++l)
            row[l] = voice.weight * state.voices[l].weight * receptance[state.voices[l].string] / 2;
        row[i] += 1 / voice.frame.stiffness_N_per_m;
    }
    factorise(bridge, state, state.voice_count);
}

/// What a newton of the exciter of voice i adds to the forces of all: state.solution.
void answer_to_exciter(const BridgeModel& bridge, BridgeState& state, std::size_t i) {
    const BridgeEndFrame& frame = state.voices[i].frame;
    std::fill(state.solution.begin(), state.solution.end(), 0.0);
    state.solution[i] = frame.by_exciter / frame.stiffness_N_per_m;
    solve(bridge, state, state.voice_count, state.solution.data());
}

double zeta_of(const VoiceOnBridge& voice, double pull_N) {
    const BridgeEndFrame& frame = voice.frame;
    return (frame.force_N + frame.by_exciter * frame.exciter_N - pull_N) / frame.stiffness_N_per_m;
}

void strike_by_voices(const InstrumentModel& model, InstrumentState& instrument) {
    BridgeState& state = instrument.bridge;
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        VoiceOnBridge& voice = state.voices[i];
        if (!voice.frame.active.excited) continue;
        Voice& struck = instrument.strings[voice.string].voices[voice.voice];
        const StringModel& string = voice_model(string_of(model, instrument, voice.string), struck);
        double zeta_m = 0, per_N = 0;
        if (voice.weight != 0) {
            answer_to_exciter(model.bridge, state, i);
            zeta_m = zeta_of(voice, state.pull[i]);
            per_N = (voice.frame.by_exciter - state.solution[i]) / voice.frame.stiffness_N_per_m;
        }
        voice.frame.exciter_N = strike_on_bridge(string, struck.touches, voice.frame, zeta_m, per_N);
        for (std::size_t l = 0; voice.weight != 0 && l < state.voice_count; ++l)
            state.pull[l] += state.solution[l] * voice.frame.exciter_N;
    }
}

}  // namespace

void solve_by_voices(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME {
    BridgeState& state = instrument.bridge;
    prepare_voices(model.bridge, state);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        state.pull[i] = voice.frame.force_N / voice.frame.stiffness_N_per_m -
                        voice.weight * state.under_mean[voice.string];
    }
    solve(model.bridge, state, state.voice_count, state.pull.data());
    strike_by_voices(model, instrument);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        VoiceOnBridge& voice = state.voices[i];
        voice.zeta_m = voice.weight == 0 ? 0.0 : zeta_of(voice, state.pull[i]);
    }
}

}  // namespace jawari
