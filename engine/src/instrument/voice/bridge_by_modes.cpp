// A frame of a moving bridge in as many unknowns as the body has modes: strings are many, modes few.
#include <algorithm>

#include "instrument/model/played_string.h"
#include "instrument/touch/bridge_end.h"
#include "instrument/voice/bridge_solve.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// The matrix of the system is summed anew at least this often, so that rounding of its updates does not add
/// up.
constexpr std::uint64_t summing_frames = 32;

/// matrix <- matrix + coupling shape shape'
void add_coupling(const BridgeModel& bridge, BridgeState& state, std::size_t s, double coupling) {
    const double* shape = shape_under(bridge, s);
    for (std::size_t i = 0; i < bridge.count; ++i) {
        double* row = state.matrix.data() + i * bridge.stride;
        const double scaled = coupling * shape[i];
        for (std::size_t j = 0; j <= i; ++j) row[j] += scaled * shape[j];
    }
}

double coupling_of(const VoiceOnBridge& voice) {
    return voice.weight * voice.weight * voice.frame.stiffness_N_per_m;
}

std::size_t slot_of(const VoiceOnBridge& voice) {
    return voice.string * voices_per_string + voice.voice;
}

/// The couplings of voices that are not in the frame leave the matrix. Returns whether something changed.
bool remove_gone(const BridgeModel& bridge, BridgeState& state) {
    bool changed = false;
    std::size_t next = 0;
    for (std::size_t slot = 0; slot < state.couplings.size(); ++slot) {
        if (next < state.voice_count && slot_of(state.voices[next]) == slot) {
            ++next;
            continue;
        }
        if (state.couplings[slot] == 0) continue;
        add_coupling(bridge, state, slot / voices_per_string, -state.couplings[slot]);
        state.couplings[slot] = 0;
        changed = true;
    }
    return changed;
}

void sum_matrix(const BridgeModel& bridge, BridgeState& state) {
    std::fill(state.matrix.begin(), state.matrix.end(), 0.0);
    std::fill(state.couplings.begin(), state.couplings.end(), 0.0);
    for (std::size_t j = 0; j < bridge.count; ++j) state.matrix[j * bridge.stride + j] = 2 / bridge.y_held[j];
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        state.couplings[slot_of(voice)] = coupling_of(voice);
        add_coupling(bridge, state, voice.string, coupling_of(voice));
    }
}

bool update_matrix(const BridgeModel& bridge, BridgeState& state) {
    bool changed = remove_gone(bridge, state);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        double& coupling = state.couplings[slot_of(voice)];
        const double now = coupling_of(voice);
        if (coupling == now) continue;
        add_coupling(bridge, state, voice.string, now - coupling);
        coupling = now;
        changed = true;
    }
    return changed;
}

void prepare_system(const BridgeModel& bridge, BridgeState& state, std::uint64_t frame) {
    if (state.stale || (!state.summed && frame % summing_frames == 0)) {
        sum_matrix(bridge, state);
        state.stale = false;
        state.summed = true;
        factorise(bridge, state, bridge.count);
    } else if (update_matrix(bridge, state)) {
        state.summed = false;
        factorise(bridge, state, bridge.count);
    }
}

double under_voice(const BridgeModel& bridge, const VoiceOnBridge& voice, const double* modal) {
    return voice.weight * product(bridge.count, shape_under(bridge, voice.string), modal);
}

/// solution <- modal forces of all voices while the body moves freely.
void add_free_pulls(const BridgeModel& bridge, BridgeState& state) {
    for (const std::uint32_t string : state.sounding) state.string_pull[string] = 0;
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        if (voice.weight == 0) continue;
        const double zeta_m = voice.weight * state.under_mean[voice.string];
        state.string_pull[voice.string] +=
            voice.weight * (voice.frame.force_N - voice.frame.stiffness_N_per_m * zeta_m);
    }
    std::fill(state.solution.begin(), state.solution.end(), 0.0);
    kernels::add_rows(state.sounding.data(), state.sounding.size(), state.string_pull.data(), bridge.stride,
                      bridge.stride, bridge.shape.data(), state.solution.data());
}

/// Exciters, one after the other: each knows what it does to the bridge and so to itself, and the forces of
/// those before it.
void strike_all(const InstrumentModel& model, InstrumentState& state) {
    BridgeState& bridge = state.bridge;
    for (std::size_t i = 0; i < bridge.voice_count; ++i) {
        VoiceOnBridge& voice = bridge.voices[i];
        if (!voice.frame.active.excited) continue;
        Voice& struck = state.strings[voice.string].voices[voice.voice];
        std::fill(bridge.solution.begin(), bridge.solution.end(), 0.0);
        add_pull(model.bridge, voice, voice.frame.by_exciter, bridge.solution.data());
        solve(model.bridge, bridge, model.bridge.count, bridge.solution.data());
        const double zeta_m = under_voice(model.bridge, voice, bridge.mean.data());
        const double per_N = under_voice(model.bridge, voice, bridge.solution.data());
        voice.frame.exciter_N = strike_on_bridge(voice_model(string_of(model, state, voice.string), struck),
                                                 struck.touches, voice.frame, zeta_m, per_N);
        if (voice.weight == 0) continue;
        for (std::size_t j = 0; j < model.bridge.count; ++j)
            bridge.mean[j] += bridge.solution[j] * voice.frame.exciter_N;
    }
}

}  // namespace

/// The system over the body's modes: delta = mean - free mean.
void solve_by_modes(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME {
    const BridgeModel& bridge = model.bridge;
    BridgeState& state = instrument.bridge;
    state.factorised[0] = 0;
    prepare_system(bridge, state, instrument.frame);
    add_free_pulls(bridge, state);
    solve(bridge, state, bridge.count, state.solution.data());
    for (std::size_t j = 0; j < bridge.count; ++j) state.mean[j] += state.solution[j];
    strike_all(model, instrument);
    kernels::indexed_row_products(state.sounding.data(), state.sounding.size(), bridge.stride, bridge.stride,
                                  bridge.shape.data(), state.mean.data(), state.under_mean.data());
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        VoiceOnBridge& voice = state.voices[i];
        const BridgeEndFrame& frame = voice.frame;
        voice.zeta_m = voice.weight == 0 ? 0.0 : voice.weight * state.under_mean[voice.string];
        state.pull[i] =
            frame.force_N + frame.by_exciter * frame.exciter_N - frame.stiffness_N_per_m * voice.zeta_m;
    }
}

}  // namespace jawari
