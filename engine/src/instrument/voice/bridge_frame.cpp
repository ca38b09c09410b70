#include "instrument/voice/bridge_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "instrument/model/played_string.h"
#include "instrument/touch/bridge_end.h"
#include "instrument/voice/bridge_model.h"

namespace jawari {
namespace {

/// The matrix of the system is summed anew at least this often, so that rounding of its updates does not add
/// up.
constexpr std::uint64_t summing_frames = 32;
/// A body whose energy is below this is put to rest [J]: below a mode of 1 kg at 1e-15 m/s.
constexpr double still_J = 1e-30;
/// Contacts change a body's speed by this share at least and at most of what the force that they add would
/// do.
constexpr double least_share = -1, largest_share = 3;

const double* shape_under(const BridgeModel& bridge, std::size_t s) {
    return bridge.shape.data() + s * bridge.stride;
}

double product(std::size_t n, const double* x, const double* y) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += x[j] * y[j];
    return sum;
}

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

/// Cholesky's factor L of the matrix, row by row; the diagonal holds 1/L_ii. The matrix is positive definite:
/// 2/y_held > 0, and no voice's stiffness is negative.
void factorise(const BridgeModel& bridge, BridgeState& state, std::size_t order) {
    for (std::size_t i = 0; i < order; ++i) {
        const double* from = state.matrix.data() + i * bridge.stride;
        double* row = state.factor.data() + i * bridge.stride;
        for (std::size_t j = 0; j < i; ++j) {
            const double* above = state.factor.data() + j * bridge.stride;
            row[j] = (from[j] - product(j, row, above)) * above[j];
        }
        row[i] = 1 / std::sqrt(from[i] - product(i, row, row));
    }
}

/// x <- the solution for the right side x.
void solve(const BridgeModel& bridge, const BridgeState& state, std::size_t order, double* x) {
    for (std::size_t i = 0; i < order; ++i) {
        const double* row = state.factor.data() + i * bridge.stride;
        x[i] = (x[i] - product(i, row, x)) * row[i];
    }
    for (std::size_t i = order; i-- > 0;) {
        const double* row = state.factor.data() + i * bridge.stride;
        x[i] *= row[i];
        for (std::size_t j = 0; j < i; ++j) x[j] -= row[j] * x[i];
    }
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

/// Adds the voice's pull to modal forces.
void add_pull(const BridgeModel& bridge, const VoiceOnBridge& voice, double force_N, double* modal) {
    const double* shape = shape_under(bridge, voice.string);
    const double scaled = voice.weight * force_N;
    for (std::size_t j = 0; j < bridge.count; ++j) modal[j] += scaled * shape[j];
}

double under_voice(const BridgeModel& bridge, const VoiceOnBridge& voice, const double* modal) {
    return voice.weight * product(bridge.count, shape_under(bridge, voice.string), modal);
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

/// The system over the body's modes: delta = mean - free mean.
void solve_by_modes(const InstrumentModel& model, InstrumentState& instrument) {
    const BridgeModel& bridge = model.bridge;
    BridgeState& state = instrument.bridge;
    state.factorised[0] = 0;
    prepare_system(bridge, state, instrument.frame);
    std::fill(state.solution.begin(), state.solution.end(), 0.0);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        if (voice.weight == 0) continue;
        const double zeta_m = voice.weight * state.under_mean[voice.string];
        add_pull(bridge, voice, voice.frame.force_N - voice.frame.stiffness_N_per_m * zeta_m,
                 state.solution.data());
    }
    solve(bridge, state, bridge.count, state.solution.data());
    for (std::size_t j = 0; j < bridge.count; ++j) state.mean[j] += state.solution[j];
    strike_all(model, instrument);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        VoiceOnBridge& voice = state.voices[i];
        const BridgeEndFrame& frame = voice.frame;
        voice.zeta_m = voice.weight == 0 ? 0.0 : under_voice(bridge, voice, state.mean.data());
        state.pull[i] =
            frame.force_N + frame.by_exciter * frame.exciter_N - frame.stiffness_N_per_m * voice.zeta_m;
    }
}

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

void solve_by_voices(const InstrumentModel& model, InstrumentState& instrument) {
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

/// The same of each string alone.
void share_out(const BridgeModel& bridge, BridgeState& state, double share) {
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        const double* shape = shape_under(bridge, voice.string);
        double* v = state.v_of.data() + voice.string * bridge.stride;
        const double added = share * voice.weight * voice.left_N / 2;
        for (std::size_t j = 0; j < bridge.count; ++j) v[j] += added * shape[j] * bridge.v_held[j];
    }
}

/// What contacts have changed of the pull at the frame's end would have moved the body in the frame, which is
/// over: it gets the energy of that as a change of its speed along `kick`.
void pay_for_contacts(const BridgeModel& bridge, BridgeState& state, double owed_J, const double* kick) {
    double quadratic = 0, linear = 0;
    for (std::size_t j = 0; j < bridge.count; ++j) {
        quadratic += bridge.mass_kg[j] * kick[j] * kick[j] / 2;
        linear += bridge.mass_kg[j] * state.v[j] * kick[j];
    }
    double share = 0;
    if (quadratic > 0) {
        const double root = linear * linear + 4 * quadratic * owed_J;
        const double middle = -linear / (2 * quadratic);
        const double half = root > 0 ? std::sqrt(root) / (2 * quadratic) : 0.0;
        share = std::clamp(middle < 1 ? middle + half : middle - half, least_share, largest_share);
        if (!std::isfinite(share)) share = 0;
    }
    for (std::size_t j = 0; j < bridge.count; ++j) state.v[j] += share * kick[j];
    if (state.separates) share_out(bridge, state, share);
    state.debt_J = owed_J - share * (quadratic * share + linear);
}

/// owed_J <- work of the pulls that contacts have added, kick <- the speed that they would have given.
void settle_contacts(const BridgeModel& bridge, BridgeState& state) {
    bool struck = false;
    AlignedVector<double>& kick = state.solution;
    std::fill(kick.begin(), kick.end(), 0.0);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        if (voice.left_N == 0 || voice.weight == 0) continue;
        add_pull(bridge, voice, voice.left_N / 2, kick.data());
        struck = true;
    }
    if (!struck) return;
    double owed_J = state.debt_J;
    for (std::size_t j = 0; j < bridge.count; ++j) {
        // The path of the frame is twice the way from its start to its mean.
        owed_J += kick[j] * state.path[j];
        kick[j] *= bridge.v_held[j];
    }
    pay_for_contacts(bridge, state, owed_J, kick.data());
}

}  // namespace

void begin_bridge_frame(const BridgeModel& bridge, BridgeState& state) JAWARI_REALTIME {
    std::fill(state.under_start.begin(), state.under_start.end(), 0.0);
    std::fill(state.under_mean.begin(), state.under_mean.end(), 0.0);
    double *start = state.under_start.data(), *mean = state.under_mean.data();
    for (std::size_t j = 0; j < bridge.count; ++j) {
        const double y = state.y[j];
        const double y_mean = y + ((bridge.yy[j] - 1) * y + bridge.yv[j] * state.v[j]) / 2;
        const double* under = bridge.under.data() + j * bridge.string_stride;
        state.mean[j] = y_mean;
        for (std::size_t s = 0; s < bridge.string_stride; ++s) start[s] += under[s] * y;
        for (std::size_t s = 0; s < bridge.string_stride; ++s) mean[s] += under[s] * y_mean;
    }
}

void solve_bridge_frame(const InstrumentModel& model, InstrumentState& instrument) JAWARI_REALTIME {
    const BridgeModel& bridge = model.bridge;
    BridgeState& state = instrument.bridge;
    std::fill(state.force_N.begin(), state.force_N.end(), 0.0);
    if (state.voice_count == 0) return;
    if (state.voice_count <= bridge.count) {
        solve_by_voices(model, instrument);
    } else {
        solve_by_modes(model, instrument);
    }
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        VoiceOnBridge& voice = state.voices[i];
        if (!std::isfinite(voice.zeta_m + state.pull[i])) voice.zeta_m = state.pull[i] = 0;
        if (voice.weight != 0) add_pull(bridge, voice, state.pull[i], state.force_N.data());
    }
}

void end_bridge_frame(const BridgeModel& bridge, BridgeState& state) JAWARI_REALTIME {
    for (std::size_t j = 0; j < bridge.count; ++j) {
        const double y = state.y[j], v = state.v[j];
        const double y_end = bridge.yy[j] * y + bridge.yv[j] * v + bridge.y_held[j] * state.force_N[j];
        state.v[j] = bridge.vy[j] * y + bridge.vv[j] * v + bridge.v_held[j] * state.force_N[j];
        state.path[j] = y_end - y;
        state.y[j] = y_end;
    }
    settle_contacts(bridge, state);
    const double energy_J = body_energy(bridge, state);
    state.ringing = energy_J > 0 || state.voice_count > 0;
    if (!std::isfinite(energy_J)) {
        silence_bridge(state);
        state.nonfinite_resets += 1;
    } else if (state.voice_count == 0 && energy_J < still_J) {
        silence_bridge(state);
    }
}

void advance_body_of_string(const BridgeModel& bridge, BridgeState& state, std::size_t s) JAWARI_REALTIME {
    double* y = state.y_of.data() + s * bridge.stride;
    double* v = state.v_of.data() + s * bridge.stride;
    double force_N = 0;
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        if (voice.string == s) force_N += voice.weight * state.pull[i];
    }
    const double* shape = shape_under(bridge, s);
    for (std::size_t j = 0; j < bridge.count; ++j) {
        const double y_end =
            bridge.yy[j] * y[j] + bridge.yv[j] * v[j] + bridge.y_held[j] * shape[j] * force_N;
        v[j] = bridge.vy[j] * y[j] + bridge.vv[j] * v[j] + bridge.v_held[j] * shape[j] * force_N;
        y[j] = y_end;
    }
}

double coupling_energy(double weight, double bridge_m, double force_N,
                       double stiffness_N_per_m) JAWARI_REALTIME {
    const double zeta_m = weight * bridge_m;
    return zeta_m * (stiffness_N_per_m * zeta_m / 2 - force_N);
}

double bridge_under(const BridgeModel& bridge, const BridgeState& state, std::size_t s) JAWARI_REALTIME {
    return product(bridge.count, shape_under(bridge, s), state.y.data());
}

}  // namespace jawari
