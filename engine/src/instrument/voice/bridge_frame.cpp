#include "instrument/voice/bridge_frame.h"

#include <algorithm>
#include <cmath>

#include "instrument/voice/bridge_kernels.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/bridge_solve.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// A body whose energy is below this is put to rest [J]: below a mode of 1 kg at 1e-15 m/s.
constexpr double still_J = 1e-30;
/// Contacts change a body's speed by this share at least and at most of what the force that they add would
/// do.
constexpr double least_share = -1, largest_share = 3;

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

bool has_struck(const VoiceOnBridge& voice) {
    return voice.left_N != 0 && voice.weight != 0;
}

/// force_N <- of all voices.
void add_pulls(const BridgeModel& bridge, BridgeState& state) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < state.sounding.size(); ++i) {
        double pull_N = 0;
        for (; next < state.voice_count && state.voices[next].string == state.sounding[i]; ++next) {
            VoiceOnBridge& voice = state.voices[next];
            if (!std::isfinite(voice.zeta_m + state.pull[next])) voice.zeta_m = state.pull[next] = 0;
            pull_N += voice.weight * state.pull[next];
        }
        state.string_pull[state.sounding[i]] = pull_N;
    }
    kernels::add_rows(state.sounding.data(), state.sounding.size(), state.string_pull.data(), bridge.stride,
                      bridge.stride, bridge.shape.data(), state.force_N.data());
}

/// owed_J <- work of the pulls that contacts have added, kick <- the speed that they would have given.
void settle_contacts(const BridgeModel& bridge, BridgeState& state) {
    const auto last = state.voices.begin() + static_cast<std::ptrdiff_t>(state.voice_count);
    if (std::none_of(state.voices.begin(), last, has_struck)) return;
    AlignedVector<double>& kick = state.solution;
    std::fill(kick.begin(), kick.end(), 0.0);
    for (std::size_t i = 0; i < state.voice_count; ++i) {
        const VoiceOnBridge& voice = state.voices[i];
        if (has_struck(voice)) add_pull(bridge, voice, voice.left_N / 2, kick.data());
    }
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
    kernels::mean_of_body(bridge, state.y.data(), state.v.data(), state.mean.data());
    kernels::indexed_row_products(state.sounding.data(), state.sounding.size(), bridge.stride, bridge.stride,
                                  bridge.shape.data(), state.mean.data(), state.under_mean.data());
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
    add_pulls(bridge, state);
}

void end_bridge_frame(const BridgeModel& bridge, BridgeState& state) JAWARI_REALTIME {
    kernels::move_body(bridge, state.force_N.data(), state.y.data(), state.v.data(), state.path.data());
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
